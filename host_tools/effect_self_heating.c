/// self_heating: no effect of the catalogue: where it explains a record best, the answer is "unknown" with
/// that hint, and no model is written with it. A search that lacked it would put its slow course down to a
/// drift.
///     self_heating_losses:   dielectric and eddy-current losses
///     self_heating_friction: hysteresis losses: so much for each loop
/// Cool when the record starts, |gain q| held to 2. tau >= 0 [s], fitted from a fiftieth to a quarter of the
/// record: quicker cannot be told from a lag, slower from wear or a drift; gain [1/q], offset [output/q].
/// Source: losses as in G. Bertotti, IEEE Trans. Magn. 24 (1988) 621.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include "lag_step.h"
#include <math.h>

enum { TAU, GAIN, OFFSET };

static const effect_parameter_t losses_parameters[] = {
    [TAU] = {"tau", "s", AT_LEAST_0},
    [GAIN] = {"gain", "1/(output/s)^2", ANY_NUMBER},
    [OFFSET] = {"offset", "output/(output/s)^2", ANY_NUMBER},
};

static const effect_parameter_t friction_parameters[] = {
    [TAU] = {"tau", "s", AT_LEAST_0},
    [GAIN] = {"gain", "1/(output/s)", ANY_NUMBER},
    [OFFSET] = {"offset", "output/(output/s)", ANY_NUMBER},
};

/// What the output does in a second on the mean.
static double mean_rate(const effect_run_t* run)
{
    const double rate = limits_output_span(run) * run->travel / (run->input_span * run->duration);
    return rate > 0.0 ? rate : 1.0;
}

static void limits_for(const effect_run_t* run, size_t parameter, double heat, effect_limits_t* result)
{
    const double quick = fmax(20.0 * run->sample_time, 0.02 * run->duration);
    const double slow = fmax(0.25 * run->duration, 2.0 * quick);
    const double gain = 2.0 / heat;
    const double offset = limits_output_span(run) / heat;
    *result = parameter == TAU    ? limits_logarithmic(quick, slow, quick, 0.05 * run->duration,
                                                       0.15 * run->duration, 0.02 * run->duration)
              : parameter == GAIN ? limits_linear(-gain, gain, 0.0, 0.01 * gain, 0.01 * gain, -0.01 * gain)
                                  : limits_linear(-offset, offset, 0.0, 0.0, 0.0, 0.0);
}

static void losses_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double rate = mean_rate(run);
    limits_for(run, parameter, rate * rate, result);
}

static void friction_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    limits_for(run, parameter, mean_rate(run), result);
}

/// Beyond a factor of e^2 either way nothing is known, and a jump's rate would lead anywhere.
static const double most_shrink = 2.0;

static void warm(const effect_run_t* run, const double* parameter, bool squared, double* series)
{
    const double middle = 0.5 * (run->output_min + run->output_max);
    lag_kept_t kept = {0};
    double heat = 0.0;
    double before = run->num_samples > 0 ? series[0] : 0.0;
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double step = run->time[i] - run->time[i - 1];
        const double rate = fabs(series[i] - before) / step;
        const double power = squared ? rate * rate : rate;
        heat = lag_next(lag_step_kept(&kept, step, parameter[TAU], 0.0), heat, power, power);
        before = series[i];
        const double shrink = fmin(fmax(parameter[GAIN] * heat, -most_shrink), most_shrink);
        series[i] = middle + exp(-shrink) * (series[i] - middle) + parameter[OFFSET] * heat;
    }
}

static void apply_losses(const effect_run_t* run, const double* parameter, const double* column,
                         double* series)
{
    (void)column;
    warm(run, parameter, true, series);
}

static void apply_friction(const effect_run_t* run, const double* parameter, const double* column,
                           double* series)
{
    (void)column;
    warm(run, parameter, false, series);
}

static const char what[] =
    "structure that no effect above explains; one such cause is looked for, lest a drift stand in for it: "
    "the "
    "losses of motion warm the plant, which nobody measures, and its output shrinks and moves with that";

const effect_t effect_self_heating_losses = {
    .name = "unknown",
    .mechanism = "self_heating_losses",
    .what = what,
    .law = "y' = y_m + exp(-gain q) (y - y_m) + offset q, |gain q| held to 2, tau dq/dt = (dy/dt)^2 - q",
    .stage = EFFECT_BODY,
    .outside = "self-heating (it follows the output's rate squared)",
    .num_parameters = COUNT_OF(losses_parameters),
    .parameter = losses_parameters,
    .limits = losses_limits,
    .apply = apply_losses,
    .no_inverse = "it is no effect of the catalogue",
    .covers = 1.0, // what is in the catalogue comes first
};

const effect_t effect_self_heating_friction = {
    .name = "unknown",
    .mechanism = "self_heating_friction",
    .what = what,
    .law = "y' = y_m + exp(-gain q) (y - y_m) + offset q, |gain q| held to 2, tau dq/dt = |dy/dt| - q",
    .stage = EFFECT_BODY,
    .outside = "self-heating (it follows the output's travel)",
    .num_parameters = COUNT_OF(friction_parameters),
    .parameter = friction_parameters,
    .limits = friction_limits,
    .apply = apply_friction,
    .no_inverse = "it is no effect of the catalogue",
    .covers = 1.0, // what is in the catalogue comes first
};
