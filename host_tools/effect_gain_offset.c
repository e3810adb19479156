/// gain_offset: gain > 0 [1], offset [output units]. Fitted over 0.2 ... 5 and two output spans.
#include "effect_catalogue.h"
#include "effect_limits.h"

enum { GAIN, OFFSET };

static const effect_parameter_t parameters[] = {
    [GAIN] = {"gain", "1", .least = 1e-6, .most = 1e6},
    [OFFSET] = {"offset", "output", ANY_NUMBER, .optional = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double span = limits_output_span(run);
    *result = parameter == GAIN ? limits_logarithmic(0.2, 5.0, 1.0, 1.0, 0.8, 1.25)
                                : limits_linear(-2.0 * span, 2.0 * span, 0.0, 0.0, 0.1 * span, -0.1 * span);
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    for (size_t i = 0; i < run->num_samples; ++i) {
        series[i] = parameter[GAIN] * series[i] + parameter[OFFSET];
    }
}

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    for (size_t i = 0; i < run->num_samples; ++i) {
        series[i] = (series[i] - parameter[OFFSET]) / parameter[GAIN];
    }
}

const effect_t effect_gain_offset = {
    .name = "gain_offset",
    .what =
        "the plant's gain or offset is no longer what was calibrated (a replaced amplifier, an aged sensor)",
    .law = "y' = gain y + offset",
    .stage = EFFECT_BODY,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .apply = apply,
    .invert = invert,
};
