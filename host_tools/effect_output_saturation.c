/// output_saturation: the output clips (an amplifier's rail, a converter's range, an end stop).
///     y' = max(low, min(high, y))
/// low < high [output units], fitted within the span between the model's saturations and a little beyond,
/// where it does nothing. Inverse: what lies beyond cannot be reached.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

enum { LOW, HIGH };

static const effect_parameter_t parameters[] = {
    [LOW] = {"low", "output", ANY_NUMBER},
    [HIGH] = {"high", "output", ANY_NUMBER},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double span = run->output_max > run->output_min ? run->output_max - run->output_min : 1.0;
    const double bottom = run->output_min - span;
    const double top = run->output_max + span;
    *result = parameter == LOW ? limits_linear(bottom, run->output_max, bottom, run->output_min + 0.1 * span,
                                               bottom, run->output_min + 0.3 * span)
                               : limits_linear(run->output_min, top, top, run->output_max - 0.1 * span, top,
                                               run->output_max - 0.3 * span);
}

static const char* fault(const double* parameter)
{
    return parameter[LOW] < parameter[HIGH] ? NULL : "output_saturation: \"low\" is not below \"high\"";
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    for (size_t i = 0; i < run->num_samples; ++i) {
        series[i] = fmax(parameter[LOW], fmin(parameter[HIGH], series[i]));
    }
}

const effect_t effect_output_saturation = {
    .name = "output_saturation",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .fault = fault,
    .limits = limits,
    .apply = apply,
    .invert = apply,
    .clips = true,
};
