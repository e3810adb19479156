/// Bounds and starts that many effects share, and the ends of their tables.
#ifndef HYST_HOST_EFFECT_LIMITS_H
#define HYST_HOST_EFFECT_LIMITS_H

#include "effect.h"
#include <float.h>

/// A parameter's physical range.
#define ANY_NUMBER .least = -DBL_MAX, .most = DBL_MAX
#define AT_LEAST_0 .least = 0.0, .most = DBL_MAX

effect_limits_t limits_linear(double low, double high, double neutral, double start, double second,
                              double third);
effect_limits_t limits_logarithmic(double low, double high, double neutral, double start, double second,
                                   double third);
/// A time constant that this record can show: from a fiftieth of a sample, where it does nothing, to half the
/// record.
effect_limits_t limits_time_constant(const effect_run_t* run);
/// The output's span, 1 where the output is constant.
double limits_output_span(const effect_run_t* run);

#define COUNT_OF(array) (sizeof(array) / sizeof(array)[0])

#endif
