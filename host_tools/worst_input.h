/// The input that drives two models as far apart as their error bound says.
#ifndef HYST_HOST_WORST_INPUT_H
#define HYST_HOST_WORST_INPUT_H

#include "replace_plays.h"

/// Reversals from negative saturation, [*num_samples >= 2], owned; the first is input_min. They leave the
/// states, as a function of the radius, with slope -1 where one sign of G (transport.h) is wanted and +1
/// elsewhere: the potential that attains the bound. Its corners are the reversals, the widest first: falling
/// below radius r from slope +1 to -1 takes a rise to ascending(v) = lambda(r) + r, the other way a fall to
/// descending(v) = lambda(r) - r. With r >= model_least_radius they are nested inputs within the range,
/// whatever the envelopes.
double* worst_input(const model_t* model, const replacement_t* replacement, size_t* num_samples);

/// The largest |y - y^| over an input from negative saturation.
double largest_difference(const model_t* model, const model_t* other, const double* input,
                          size_t num_samples);

#endif
