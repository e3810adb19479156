/// quantization: step >= 0 [output units], 0: none; offset [output units]: one of the levels.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

enum { STEP, OFFSET };

static const effect_parameter_t parameters[] = {
    [STEP] = {"step", "output", AT_LEAST_0},
    [OFFSET] = {"offset", "output", ANY_NUMBER, .optional = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double span = limits_output_span(run);
    *result = parameter == STEP
                  ? limits_linear(0.0, 0.3 * span, 0.0, 0.03 * span, 0.1 * span, 0.01 * span)
                  : limits_linear(-0.15 * span, 0.15 * span, 0.0, 0.0, 0.01 * span, -0.01 * span);
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    const double step = parameter[STEP];
    const double offset = parameter[OFFSET];
    for (size_t i = 0; step > 0.0 && i < run->num_samples; ++i) {
        const double steps = (series[i] - offset) / step;
        // A step below the value's last bit rounds nothing.
        series[i] = isfinite(steps) ? offset + step * round(steps) : series[i];
    }
}

const effect_t effect_quantization = {
    .name = "quantization",
    .what = "coarse steps of the converter",
    .law = "y' = offset + step round((y - offset) / step)",
    .rounds = true,
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .apply = apply,
    .no_inverse = "between the converter's steps no output can be asked for",
};
