/// slew_limit: rate > 0 [input/s], fitted between a fiftieth of the record's mean rate and twice its largest,
/// where it does nothing; asymmetry in (-1, 1) [1], fitted up to 0.5, 0 when left out: a supply that sources
/// another current than it sinks. A record whose falls are all slow does not tell the falling rate, and the
/// next one may fall fast: taken as near to the rising rate then.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

enum { RATE, ASYMMETRY };

static const effect_parameter_t parameters[] = {
    [RATE] = {"rate", "input/s", .least = DBL_MIN, .most = DBL_MAX},
    [ASYMMETRY] = {"asymmetry", "1", .least = -0.99, .most = 0.99, .optional = true, .scatter = 0.2},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double high = run->input_rate > 0.0 ? 2.0 * run->input_rate : 1.0;
    const double mean = run->travel > 0.0 ? run->travel / run->duration : 0.5 * high;
    *result = parameter == RATE
                  ? limits_logarithmic(0.02 * fmin(mean, high), high, high, 0.35 * high, mean, 0.1 * high)
                  : limits_linear(-0.5, 0.5, 0.0, 0.0, 0.1, -0.1);
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double reach = parameter[RATE] * (run->time[i] - run->time[i - 1]);
        const double rise = reach * (1.0 + parameter[ASYMMETRY]);
        const double fall = reach * (1.0 - parameter[ASYMMETRY]);
        series[i] = series[i - 1] + fmin(fmax(series[i] - series[i - 1], -fall), rise);
    }
}

const effect_t effect_slew_limit = {
    .name = "slew_limit",
    .what = "the drive cannot follow faster than a rate (a supply's current into a piezo's capacitance, a "
            "servo valve)",
    .law = "-rate (1 - asymmetry) <= dv'/dt <= rate (1 + asymmetry); v' goes to v as fast as that",
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
