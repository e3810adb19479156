/// slew_limit: the drive cannot follow faster than a rate (a supply's current into a piezo's capacitance, a
/// servo valve).
///     |dv'/dt| <= rate; v' goes to v as fast as that
/// rate > 0 [input/s], fitted between a fiftieth of the record's mean rate and twice its largest, where it
/// does nothing.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

static const effect_parameter_t parameters[] = {{"rate", "input/s", .least = DBL_MIN, .most = DBL_MAX}};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)parameter;
    const double high = run->input_rate > 0.0 ? 2.0 * run->input_rate : 1.0;
    const double mean = run->travel > 0.0 ? run->travel / run->duration : 0.5 * high;
    *result = limits_logarithmic(0.02 * fmin(mean, high), high, high, 0.35 * high, mean, 0.1 * high);
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double reach = parameter[0] * (run->time[i] - run->time[i - 1]);
        series[i] = series[i - 1] + fmin(fmax(series[i] - series[i - 1], -reach), reach);
    }
}

const effect_t effect_slew_limit = {
    .name = "slew_limit",
    .stage = EFFECT_DRIVE,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .apply = apply,
    .no_inverse = "no command makes the drive faster than its rate; ask for a slower output",
};
