/// output_saturation: low < high [output units], fitted within the span between the model's saturations and a
/// little beyond, where it does nothing. knee >= 0 [output], fitted to a tenth of the output's span, 0 when
/// left out: how soft the corners are,
///     min(high, y) = y - knee log(1 + exp((y - high) / knee)), and max(low, y) likewise.
/// Inverse: what lies beyond cannot be reached.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

enum { LOW, HIGH, KNEE };

static const effect_parameter_t parameters[] = {
    [LOW] = {"low", "output", ANY_NUMBER},
    [HIGH] = {"high", "output", ANY_NUMBER},
    [KNEE] = {"knee", "output", AT_LEAST_0, .optional = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double span = run->output_max > run->output_min ? run->output_max - run->output_min : 1.0;
    const double bottom = run->output_min - span;
    const double top = run->output_max + span;
    const double width = limits_output_span(run);
    *result =
        parameter == KNEE  ? limits_linear(0.0, 0.1 * width, 0.0, 0.005 * width, 0.02 * width, 0.001 * width)
        : parameter == LOW ? limits_linear(bottom, run->output_max, bottom, run->output_min + 0.1 * span,
                                           bottom, run->output_min + 0.3 * span)
                           : limits_linear(run->output_min, top, top, run->output_max - 0.1 * span, top,
                                           run->output_max - 0.3 * span);
}

static const char* fault(const double* parameter)
{
    return parameter[LOW] < parameter[HIGH] ? NULL : "output_saturation: \"low\" is not below \"high\"";
}

/// Knees beyond a corner from which the soft one is the hard one to a double's last digit.
static const double far = 40.0;

/// min(high, y) with a soft corner.
static double below(double high, double knee, double y)
{
    const double beyond = y - high;
    return knee > 0.0 && fabs(beyond) < far * knee ? y - knee * log1p(exp(beyond / knee)) : fmin(high, y);
}

/// The y of which that is `wanted`; far beyond the corner where there is none.
static double behind(double high, double knee, double wanted)
{
    const double room = knee > 0.0 ? -expm1((wanted - high) / knee) : 1.0;
    return room > 0.0 ? wanted - knee * log(room) : high + far * knee;
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    for (size_t i = 0; i < run->num_samples; ++i) {
        const double y = below(parameter[HIGH], parameter[KNEE], series[i]);
        series[i] = -below(-parameter[LOW], parameter[KNEE], -y);
    }
}

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    if (!(parameter[KNEE] > 0.0)) {
        apply(run, parameter, column, series);
        return;
    }
    for (size_t i = 0; i < run->num_samples; ++i) {
        const double y = -behind(-parameter[LOW], parameter[KNEE], -series[i]);
        series[i] = behind(parameter[HIGH], parameter[KNEE], y);
    }
}

const effect_t effect_output_saturation = {
    .name = "output_saturation",
    .what = "the output clips (an amplifier's rail, a converter's range, an end stop)",
    .law = "y' = max(low, min(high, y)), with min(high, y) = y - knee log(1 + exp((y - high) / knee)), max "
           "likewise",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .fault = fault,
    .limits = limits,
    .apply = apply,
    .invert = invert,
    .clips = true,
};
