/// The ways to compress that the study sets side by side.
#ifndef HYST_TESTS_PAPER_STUDY_METHODS_H
#define HYST_TESTS_PAPER_STUDY_METHODS_H

#include "compress.h"
#include "paper_study_cases.h"

enum { NUM_METHODS = 10, METHOD_RIVAL = NUM_METHODS - 1 };

typedef struct {
    model_t model;
    compression_t compression; ///< of the rival: error_bound alone
} compressed_t;

/// "entropy-sum", "entropy-sum, unscaled", ..., "fit to one input"
const char* method_name(int method);
compressed_t method_run(int method, const model_t* model, size_t num_plays);
void compressed_free(compressed_t* compressed);

#endif
