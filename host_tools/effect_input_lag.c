/// input_lag: at rest at its first value before the record. level(v') from -1 to 1 over the model's input
/// range: a piezo's capacitance grows with the voltage on it, a thermal mass loses more heat the hotter it
/// is. tau >= 0 [s], fitted over a fiftieth of a sample ... half the record; growth in (-1, 1) [1], fitted up
/// to 0.6; hold in [-1, 1] [1], fitted from 0 on (below it is a delay): how the input goes between the
/// samples, -1 it stays (a converter holds it), 0 straight, 1 it is at once where the next sample has it.
/// Those but tau are 0 when left out.
/// Inverse: the lead v = v' + tau (1 + growth level(v')) dv'/dt.
#include "effect_catalogue.h"
#include "effect_lag.h"
#include "effect_limits.h"

enum { TAU, GROWTH, HOLD };

static const effect_parameter_t parameters[] = {
    [TAU] = {"tau", "s", AT_LEAST_0},
    [GROWTH] = {"growth", "1", .least = -0.99, .most = 0.99, .optional = true},
    [HOLD] = {"hold", "1", .least = -1.0, .most = 1.0, .optional = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    *result = parameter == TAU    ? limits_time_constant(run)
              : parameter == HOLD ? hold_limits()
                                  : limits_linear(-0.6, 0.6, 0.0, 0.1, -0.1, 0.0);
}

static void set_lag(const effect_run_t* run, const double* parameter, double* lag)
{
    lag[LAG_TAU] = parameter[TAU];
    lag[LAG_HOLD] = parameter[HOLD];
    lag[LAG_GROWTH] = parameter[GROWTH];
    lag[LAG_MIDDLE] = run->input_min + 0.5 * run->input_span;
    lag[LAG_HALF] = 0.5 * run->input_span;
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    double lag[LAG_NUMBERS];
    set_lag(run, parameter, lag);
    series_lag(run, lag, series);
}

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    double lag[LAG_NUMBERS];
    set_lag(run, parameter, lag);
    series_lag_invert(run, lag, series);
}

const effect_t effect_input_lag = {
    .name = "input_lag",
    .what = "first-order lag ahead of the hysteresis (thermal mass, an amplifier's RC)",
    .law =
        "tau (1 + growth level(v')) dv'/dt = v - v'\n"
        "hold: between the samples v stays (-1), goes straight (0) or is at once where the next has it (1)",
    .stage = EFFECT_DRIVE,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .apply = apply,
    .invert = invert,
    .has_threshold = true,
    .covers = 0.25, // a time that grows, and what is between the samples, make it like a delay or another lag
};
