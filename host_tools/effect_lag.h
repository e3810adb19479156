/// Lags and leads of whole series.
#ifndef HYST_HOST_EFFECT_LAG_H
#define HYST_HOST_EFFECT_LAG_H

#include "effect.h"
#include "lag_step.h"

/// The slope and curvature of the parabola through each sample and its neighbours, the series at rest before
/// its first value and straight beyond its last: slope[num_samples], curvature[num_samples].
void series_derivatives(const effect_run_t* run, const double* series, double* slope, double* curvature);

/// series := what `apply` turns into it, from a `lead` that is right up to discretisation, by repeated
/// correction of what it misses as long as that gets less. Both work in place.
typedef void series_map_t(const effect_run_t* run, const double* parameter, double* series);
void series_invert(const effect_run_t* run, const double* parameter, series_map_t* apply, series_map_t* lead,
                   double* series);

/// A first-order lag of a whole series y: tau (1 + growth level(y')) dy'/dt = y - y', at rest at its first
/// value before the record, level(y') = (y' - middle) / half within -1 ... 1; hold as in lag_step_held. With
/// growth 0 exact, else with the time constant half way through each step.
enum { LAG_TAU, LAG_HOLD, LAG_GROWTH, LAG_MIDDLE, LAG_HALF, LAG_NUMBERS };
void series_lag(const effect_run_t* run, const double* lag, double* series);
void series_lag_invert(const effect_run_t* run, const double* lag, double* series);

/// Limits of a hold, for fitting: below 0 it is a delay.
effect_limits_t hold_limits(void);

#endif
