/// The rival of section 4.6: radii and weights fitted to the output for one input.
#ifndef HYST_TESTS_PAPER_STUDY_RIVAL_H
#define HYST_TESTS_PAPER_STUDY_RIVAL_H

#include "paper_study_cases.h"

/// The best least-squares fit of num_plays plays >= 0 and a constant to the model's output for the input, out
/// of 20 random starts. The error bound is what transport.h says of the result.
model_t study_rival(const model_t* model, const study_input_t* input, size_t num_plays, uint64_t seed,
                    double* error_bound);

#endif
