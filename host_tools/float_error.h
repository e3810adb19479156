/// What storing and computing a model in float can put on its output.
#ifndef HYST_HOST_FLOAT_ERROR_H
#define HYST_HOST_FLOAT_ERROR_H

#include "hyst/hyst_f32.h"
#include "prepare.h"

/// A bound on |output of lib/ - output of the prepared model with its curves replaced by their chords|, for
/// every history of float inputs from negative saturation over the stored range. `stored` passed
/// hyst_f32_init; radius and weight are the stored ones its table of plays was made of.
double float_error(const prepared_t* prepared, const hyst_f32_model_t* stored, const float* radius,
                   const float* weight);

/// The part of it that the table of plays and the segments' sums make, for envelopes of at most `magnitude`.
double float_error_of_sums(const hyst_f32_model_t* stored, double magnitude);

#endif
