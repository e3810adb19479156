/// creep: of `additional` and `power_law` the late motion comes on top, of `delayed` a part of each change
/// comes late.
/// LP_k: six first-order lags, time constants evenly in the logarithm from tau_fast to tau_slow, at rest
/// before the record; a step is then followed by a motion nearly linear in log(time). The power law is a
/// mixture of lags too, of tau with the weight order / Gamma(1 - order) (tau/onset)^order e^(-onset/tau) d ln
/// tau, here 16 of them, two a decade from 0.3 onset on, which up to 10^4 onsets is within 0.4 % of it for
/// orders up to 0.35 and within 1.4 % at 0.5. Exact for a course that is linear between the samples. amount 0
/// ... 10 [1] (delayed: below 1), 0 < tau_fast <= tau_slow [s], onset > 0 [s], 0 < order < 1 [1].
/// Inverse: exact, sample by sample.
/// Sources: K. Kuhnen, P. Krejci, IEEE Trans. Autom. Control 54 (2009) 537: creep operators with eigenvalues
/// in geometric sequence; R. L. Bagley, P. J. Torvik, J. Rheol. 27 (1983) 201: fractional orders.
#include "effect_catalogue.h"
#include "effect_lag.h"
#include "effect_limits.h"
#include <math.h>

enum { AMOUNT, TAU_FAST, TAU_SLOW, LAGS = 6 };
enum { ONSET = 1, ORDER, POWER_LAGS = 16 };

static const effect_parameter_t additional_parameters[] = {
    [AMOUNT] = {"amount", "1", .least = 0.0, .most = 10.0},
    [TAU_FAST] = {"tau_fast", "s", .least = DBL_MIN, .most = DBL_MAX},
    [TAU_SLOW] = {"tau_slow", "s", .least = DBL_MIN, .most = DBL_MAX},
};

static const effect_parameter_t delayed_parameters[] = {
    [AMOUNT] = {"amount", "1", .least = 0.0, .most = 0.99},
    [TAU_FAST] = {"tau_fast", "s", .least = DBL_MIN, .most = DBL_MAX},
    [TAU_SLOW] = {"tau_slow", "s", .least = DBL_MIN, .most = DBL_MAX},
};

static const effect_parameter_t power_parameters[] = {
    [AMOUNT] = {"amount", "1", .least = 0.0, .most = 10.0},
    [ONSET] = {"onset", "s", .least = DBL_MIN, .most = DBL_MAX},
    [ORDER] = {"order", "1", .least = 0.01, .most = 0.99},
};

static void power_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double sample = run->sample_time;
    const double slow = fmax(0.1 * run->duration, 2.0 * sample);
    switch (parameter) {
    case AMOUNT:
        *result = limits_linear(0.0, 0.9, 0.0, 0.05, 0.2, 0.02);
        break;
    case ONSET:
        *result = limits_logarithmic(sample, slow, 10.0 * sample, 10.0 * sample, 0.01 * run->duration,
                                     3.0 * sample);
        break;
    default:
        *result = limits_linear(0.05, 0.5, 0.2, 0.2, 0.3, 0.15);
        break;
    }
}

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double sample = run->sample_time;
    const double duration = run->duration;
    switch (parameter) {
    case AMOUNT:
        *result = limits_linear(0.0, 0.9, 0.0, 0.1, 0.3, 0.03);
        break;
    case TAU_FAST:
        *result = limits_logarithmic(0.5 * sample, fmax(0.3 * duration, sample), 3.0 * sample,
                                     0.01 * duration, 3.0 * sample, 0.05 * duration);
        break;
    default:
        *result = limits_logarithmic(sample, fmax(3.0 * duration, 2.0 * sample), 0.3 * duration,
                                     0.3 * duration, duration, 0.1 * duration);
        break;
    }
}

/// Within a decade the spread of lags cannot be told from one.
static bool is_one_lag(const effect_run_t* run, const double* parameter)
{
    (void)run;
    return parameter[TAU_SLOW] < 10.0 * parameter[TAU_FAST] &&
           parameter[TAU_FAST] < 10.0 * parameter[TAU_SLOW];
}

static const char* fault(const double* parameter)
{
    return parameter[TAU_FAST] <= parameter[TAU_SLOW] ? NULL : "creep: \"tau_fast\" is above \"tau_slow\"";
}

/// The lags are the same set either way round.
static void normalise(double* parameter)
{
    const double fast = fmin(parameter[TAU_FAST], parameter[TAU_SLOW]);
    parameter[TAU_SLOW] = fmax(parameter[TAU_FAST], parameter[TAU_SLOW]);
    parameter[TAU_FAST] = fast;
}

/// A run through the lags, values counted from the series' first.
typedef struct {
    size_t num_lags;
    double tau[POWER_LAGS];
    double share[POWER_LAGS];
    double state[POWER_LAGS];
    lag_step_t lag[POWER_LAGS];
    double step;   ///< that `lag` is for
    double direct; ///< the part that comes at once
    double input;  ///< the last sample's
} creep_t;

static creep_t creep_even(const double* parameter, double direct)
{
    creep_t creep = {.num_lags = LAGS, .direct = direct};
    const double ratio = parameter[TAU_SLOW] / parameter[TAU_FAST];
    for (size_t k = 0; k < LAGS; ++k) {
        creep.tau[k] = parameter[TAU_FAST] * pow(ratio, (double)k / (LAGS - 1));
        creep.share[k] = parameter[AMOUNT] / LAGS;
    }
    return creep;
}

static creep_t creep_power(const double* parameter)
{
    creep_t creep = {.num_lags = POWER_LAGS, .direct = 1.0};
    const double order = parameter[ORDER];
    const double scale = parameter[AMOUNT] * order / tgamma(1.0 - order) * 0.5 * log(10.0);
    for (size_t k = 0; k < POWER_LAGS; ++k) {
        const double ratio = pow(10.0, 0.5 * (double)k - 0.5);
        creep.tau[k] = parameter[ONSET] * ratio;
        creep.share[k] = scale * pow(ratio, order) * exp(-1.0 / ratio);
    }
    return creep;
}

/// The lags for a step: set up once for an even clock.
static void set_step(creep_t* creep, double step)
{
    if (lag_is_same_step(step, creep->step)) {
        return;
    }
    creep->step = step;
    for (size_t k = 0; k < creep->num_lags; ++k) {
        creep->lag[k] = lag_step(step, creep->tau[k]);
    }
}

/// The input that gives an output: still + gain * input with what the lags bring along in `still`.
static double input_for(const creep_t* creep, double output)
{
    double still = 0.0;
    double gain = creep->direct;
    for (size_t k = 0; k < creep->num_lags; ++k) {
        still += creep->share[k] * lag_next(creep->lag[k], creep->state[k], creep->input, 0.0);
        gain += creep->share[k] * creep->lag[k].ramp;
    }
    return (output - still) / gain;
}

/// One step either way: the output for `given` as input or, inverse, the input for `given` as output.
static double creep_step(creep_t* creep, double step, double given, bool inverse)
{
    set_step(creep, step);
    const double input = inverse ? input_for(creep, given) : given;
    double output = creep->direct * input;
    for (size_t k = 0; k < creep->num_lags; ++k) {
        creep->state[k] = lag_next(creep->lag[k], creep->state[k], creep->input, input);
        output += creep->share[k] * creep->state[k];
    }
    creep->input = input;
    return inverse ? input : output;
}

static void run_creep(const effect_run_t* run, creep_t creep, bool inverse, double* series)
{
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double step = run->time[i] - run->time[i - 1];
        series[i] = series[0] + creep_step(&creep, step, series[i] - series[0], inverse);
    }
}

static void apply_additional(const effect_run_t* run, const double* parameter, const double* column,
                             double* series)
{
    (void)column;
    run_creep(run, creep_even(parameter, 1.0), false, series);
}

static void invert_additional(const effect_run_t* run, const double* parameter, const double* column,
                              double* series)
{
    (void)column;
    run_creep(run, creep_even(parameter, 1.0), true, series);
}

static void apply_delayed(const effect_run_t* run, const double* parameter, const double* column,
                          double* series)
{
    (void)column;
    run_creep(run, creep_even(parameter, 1.0 - parameter[AMOUNT]), false, series);
}

static void invert_delayed(const effect_run_t* run, const double* parameter, const double* column,
                           double* series)
{
    (void)column;
    run_creep(run, creep_even(parameter, 1.0 - parameter[AMOUNT]), true, series);
}

static void apply_power(const effect_run_t* run, const double* parameter, const double* column,
                        double* series)
{
    (void)column;
    run_creep(run, creep_power(parameter), false, series);
}

static void invert_power(const effect_run_t* run, const double* parameter, const double* column,
                         double* series)
{
    (void)column;
    run_creep(run, creep_power(parameter), true, series);
}

static const char what[] =
    "slow motion that goes on after a change, over decades of time (domains in piezo ceramics, polymers)";

const effect_t effect_creep_additional = {
    .name = "creep",
    .mechanism = "additional",
    .what = what,
    .law = "y' = y + amount mean_k LP_k(y - y(0))",
    .stage = EFFECT_BODY,
    .transferable = true,
    .num_parameters = COUNT_OF(additional_parameters),
    .parameter = additional_parameters,
    .fault = fault,
    .normalise = normalise,
    .limits = limits,
    .is_another = is_one_lag,
    .apply = apply_additional,
    .invert = invert_additional,
};

const effect_t effect_creep_delayed = {
    .name = "creep",
    .mechanism = "delayed",
    .what = what,
    .law = "y' = (1 - amount) y + amount mean_k LP_k(y)",
    .stage = EFFECT_BODY,
    .transferable = true,
    .num_parameters = COUNT_OF(delayed_parameters),
    .parameter = delayed_parameters,
    .fault = fault,
    .normalise = normalise,
    .limits = limits,
    .is_another = is_one_lag,
    .apply = apply_delayed,
    .invert = invert_delayed,
};

const effect_t effect_creep_power_law = {
    .name = "creep",
    .mechanism = "power_law",
    .what = what,
    .law = "a step of y is followed, a time T later, by amount ((1 + T / onset)^order - 1) of it on top",
    .stage = EFFECT_BODY,
    .transferable = true,
    .num_parameters = COUNT_OF(power_parameters),
    .parameter = power_parameters,
    .limits = power_limits,
    .apply = apply_power,
    .invert = invert_power,
};
