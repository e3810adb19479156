/// slew_limit: the drive reaches what is commanded through a small resistance, which the bench has seen, too,
/// and no faster than a rate; what the limit alone makes of it is the effect. rate > 0 [input/s], fitted
/// between a fiftieth of the record's mean rate and twice its largest, where it does nothing; asymmetry in
/// (-1, 1) [1], fitted up to 0.5, 0 when left out: a supply that sources another current than it sinks. A
/// record whose falls are all slow does not tell the falling rate, and the next one may fall fast: taken as
/// near to the rising rate then. corner [s], fitted up to three samples, 0 when left out: the resistance's
/// time constant, over which the drive arrives when it has caught up.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

enum { RATE, ASYMMETRY, CORNER };

static const effect_parameter_t parameters[] = {
    [RATE] = {"rate", "input/s", .least = DBL_MIN, .most = DBL_MAX},
    [ASYMMETRY] = {"asymmetry", "1", .least = -0.99, .most = 0.99, .optional = true, .scatter = 0.2},
    [CORNER] = {"corner", "s", AT_LEAST_0, .optional = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double high = run->input_rate > 0.0 ? 2.0 * run->input_rate : 1.0;
    const double mean = run->travel > 0.0 ? run->travel / run->duration : 0.5 * high;
    if (parameter == CORNER) {
        const double sample = run->sample_time;
        *result = limits_linear(0.0, 3.0 * sample, 0.0, 0.5 * sample, 0.5 * sample, 0.1 * sample);
        return;
    }
    *result = parameter == RATE
                  ? limits_logarithmic(0.02 * fmin(mean, high), high, high, 0.35 * high, mean, 0.1 * high)
                  : limits_linear(-0.5, 0.5, 0.0, 0.0, 0.1, -0.1);
}

/// How far a lag of first order comes in `step` towards a target so far away, at `rate` on average at most:
/// of a command that moves from sample to sample, the speed within one is not known.
static double approach(double away, double corner, double rate, double step)
{
    const double follow = corner > 0.0 ? -expm1(-step / corner) : 1.0;
    return fmin(fmax(follow * away, -rate * step), rate * step);
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    const double corner = parameter[CORNER];
    double limited = run->num_samples > 0 ? series[0] : 0.0;
    double free_lag = limited;
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double step = run->time[i] - run->time[i - 1];
        const double away = series[i] - limited;
        const double rate =
            parameter[RATE] * (1.0 + (away > 0.0 ? parameter[ASYMMETRY] : -parameter[ASYMMETRY]));
        limited += approach(away, corner, rate, step);
        free_lag += approach(series[i] - free_lag, corner, HUGE_VAL, step);
        series[i] += limited - free_lag;
    }
}

const effect_t effect_slew_limit = {
    .name = "slew_limit",
    .what = "the drive cannot follow faster than a rate (a supply's current into a piezo's capacitance, a "
            "servo valve)",
    .law = "-rate (1 - asymmetry) <= dx/dt <= rate (1 + asymmetry), x goes to v with time constant corner,\n"
           "v' = x + v - LP(v): the lag itself is the bench's, too",
    .stage = EFFECT_DRIVE,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .has_threshold = true,
    .apply = apply,
    .covers = 0.25, // on periodic work a limit on either way is a lag
    .no_inverse = "no command makes the drive faster than its rate; ask for a slower output",
};
