/// The plain double-precision model: a loop over the plays, the oracle for every other implementation.
#ifndef HYST_HOST_REFERENCE_H
#define HYST_HOST_REFERENCE_H

#include "model.h"

typedef struct {
    const model_t* model; ///< borrowed
    double* memory;       ///< [num_plays] w_j
    double input;
} reference_t;

/// The past that `start` names, before any sample: the input is input_min, input_max or the middle of the
/// range, for START_MODEL the middle of the inputs at which `initial` is at rest.
reference_t reference_start(const model_t* model, start_t start);
/// Starts from `start` and moves to first_input. START_MODEL without `initial` falls back to negative
/// saturation.
reference_t reference_new(const model_t* model, start_t start, double first_input);
void reference_free(reference_t* reference);
/// Eqs. (6) and (8). input finite; beyond the model's range the curves continue.
double reference_step(reference_t* reference, double input);
/// The output at the present memory.
double reference_output(const reference_t* reference);

typedef struct {
    double input;
    double reachable_min, reachable_max;
    bool clamped; ///< `wanted` lies outside them by more than 1e-14 of their magnitude, or is NaN
} reference_inverse_t;
/// The input in [input_min, input_max] that gives `wanted` from the present memory; looks, does not commit.
reference_inverse_t reference_inverse(const reference_t* reference, double wanted);

/// Runs a whole input through a fresh model: output[t] for input[t], t < num_samples. The first sample's
/// output is that of the start moved to input[0].
void reference_run(const model_t* model, start_t start, const double* input, size_t num_samples,
                   double* output);

#endif
