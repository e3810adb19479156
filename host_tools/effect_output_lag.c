/// output_lag: both lags at rest at their first value before the record. tau >= 0 [s], fitted over a fiftieth
/// of a sample ... half the record; hold in [-1, 1] [1], fitted from 0 on: how y goes between the samples, 0
/// straight (and where it is left out; exact then), 1 at once where the next sample has it, as a filter in a
/// program takes it; second 0 ... 1 [1], fitted up to a half: the faster of two lags in parts of the slower,
/// of a sensor in a sheath or a pocket; 0 where it is left out: none.
/// Inverse: the leads y' = y'' + second tau dy''/dt and y = y' + tau dy'/dt.
#include "effect_catalogue.h"
#include "effect_lag.h"
#include "effect_limits.h"

enum { TAU, SECOND, HOLD };

static const effect_parameter_t parameters[] = {
    [TAU] = {"tau", "s", AT_LEAST_0},
    [HOLD] = {"hold", "1", .least = -1.0, .most = 1.0, .optional = true},
    [SECOND] = {"second", "1", .least = 0.0, .most = 1.0, .optional = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    *result = parameter == TAU    ? limits_time_constant(run)
              : parameter == HOLD ? hold_limits()
                                  : limits_linear(0.0, 0.5, 0.0, 0.05, 0.3, 0.12);
}

typedef struct {
    double slow[LAG_NUMBERS], fast[LAG_NUMBERS];
} lags_t;

static lags_t lags_of(const double* parameter)
{
    return (lags_t){.slow = {[LAG_TAU] = parameter[TAU], [LAG_HOLD] = parameter[HOLD]},
                    .fast = {[LAG_TAU] = parameter[SECOND] * parameter[TAU]}};
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    const lags_t lags = lags_of(parameter);
    series_lag(run, lags.slow, series);
    if (parameter[SECOND] > 0.0) {
        series_lag(run, lags.fast, series);
    }
}

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    const lags_t lags = lags_of(parameter);
    if (parameter[SECOND] > 0.0) {
        series_lag_invert(run, lags.fast, series);
    }
    series_lag_invert(run, lags.slow, series);
}

const effect_t effect_output_lag = {
    .name = "output_lag",
    .what = "lag behind the hysteresis (a sensor, a filter)",
    .law =
        "tau dy'/dt = y - y', second tau dy''/dt = y' - y''\n"
        "hold: between the samples y stays (-1), goes straight (0) or is at once where the next has it (1)",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .has_threshold = true,
    .covers = 0.1, // with a second lag a little like a delay
    .apply = apply,
    .invert = invert,
};
