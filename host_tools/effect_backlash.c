/// backlash: lost motion between the material and the sensor (gear, loose joint): one more play, on the
/// output.
///     y' = max(y - width/2, min(y + width/2, y')), in the middle of its gap at the record's start
/// width >= 0 [output units], fitted up to half the output's span. Inverse: half the gap ahead in the
/// direction of motion; where the wanted output holds, nothing moves.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

static const effect_parameter_t parameters[] = {{"width", "output", AT_LEAST_0}};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)parameter;
    const double span = limits_output_span(run);
    *result = limits_linear(0.0, 0.5 * span, 0.0, 0.03 * span, 0.1 * span, 0.01 * span);
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    const double half = 0.5 * parameter[0];
    for (size_t i = 1; i < run->num_samples; ++i) {
        series[i] = fmax(series[i] - half, fmin(series[i] + half, series[i - 1]));
    }
}

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    const double half = 0.5 * parameter[0];
    double before = run->num_samples > 0 ? series[0] : 0.0;
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double wanted = series[i];
        if (wanted > before) {
            series[i] = wanted + half;
        } else if (wanted < before) {
            series[i] = wanted - half;
        } else {
            series[i] = series[i - 1];
        }
        before = wanted;
    }
}

const effect_t effect_backlash = {
    .name = "backlash",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .apply = apply,
    .invert = invert,
};
