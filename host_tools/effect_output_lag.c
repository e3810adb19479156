/// output_lag: first-order lag behind the hysteresis (a sensor, a filter).
///     tau dy'/dt = y - y', at rest at its first value before the record
/// tau >= 0 [s], fitted over a fiftieth of a sample ... half the record; hold in [-1, 1] [1], fitted from 0
/// on: how y goes between the samples, 0 straight (and where it is left out; exact then), 1 at once where the
/// next sample has it, as a filter in a program takes it. Inverse: the lead y = y' + tau dy'/dt.
#include "effect_catalogue.h"
#include "effect_lag.h"
#include "effect_limits.h"

enum { TAU, HOLD };

static const effect_parameter_t parameters[] = {
    [TAU] = {"tau", "s", AT_LEAST_0},
    [HOLD] = {"hold", "1", .least = -1.0, .most = 1.0, .optional = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    *result = parameter == TAU ? limits_time_constant(run) : hold_limits();
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    const double lag[LAG_NUMBERS] = {[LAG_TAU] = parameter[TAU], [LAG_HOLD] = parameter[HOLD]};
    series_lag(run, lag, series);
}

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    const double lag[LAG_NUMBERS] = {[LAG_TAU] = parameter[TAU], [LAG_HOLD] = parameter[HOLD]};
    series_lag_invert(run, lag, series);
}

const effect_t effect_output_lag = {
    .name = "output_lag",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .has_threshold = true,
    .apply = apply,
    .invert = invert,
};
