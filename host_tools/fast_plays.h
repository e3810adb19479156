/// The rate-independent plays' run at a cost per sample that does not grow with the plays, for searches that
/// run a model thousands of times: the memory as a stack of segments (THEORY section 3), the curves as fine
/// tables.
#ifndef HYST_HOST_FAST_PLAYS_H
#define HYST_HOST_FAST_PLAYS_H

#include "model.h"

typedef struct fast_plays fast_plays_t;

/// For a model (borrowed) and a start: everything that does not depend on the input. The curves are tabulated
/// in cells of 1/4096 of the model's range, half a range beyond it on either side; further out they are
/// evaluated.
fast_plays_t* fast_plays_new(const model_t* model, start_t start);
void fast_plays_free(fast_plays_t* plays);
/// sum[num_samples]: the plays' weighted sum for the input. start and first sample as reference_run has them.
void fast_plays_run(const fast_plays_t* plays, const double* input, size_t num_samples, double* sum);
/// The non-hysteretic part, from its table.
double fast_plays_nonhysteretic(const fast_plays_t* plays, double v);

#endif
