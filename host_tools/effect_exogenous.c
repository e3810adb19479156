/// exogenous: the column counts from the value named "reference" or, without it, from the record's first. In
/// a coercive_field it takes 1 / (1 - coercive q) as much input to turn the hysteretic part round; how much
/// of a plant's slope is hysteretic (the spring of a Bouc-Wen element) its bench does not tell, so a `share`
/// of the rest may see that, too.
/// gain [1 per column unit], offset [output per column unit], width [envelope units per column unit], bend [1
/// per column unit]: a material's law to second order, fitted up to |bend c| = 0.6; coercive [1 per column
/// unit]; share 0 ... 1 [1]. Those left out are 0.
/// Inverse: where 1 + gain q <= 0 nothing can be reached.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

enum { GAIN, OFFSET, WIDTH, BEND };
enum { COERCIVE, COERCIVE_BEND, COERCIVE_SHARE };

static const effect_parameter_t parameters[] = {
    [GAIN] = {"gain", "1/column", ANY_NUMBER, .optional = true},
    [OFFSET] = {"offset", "output/column", ANY_NUMBER, .optional = true},
    [WIDTH] = {"width", "envelope/column", ANY_NUMBER, .optional = true},
    [BEND] = {"bend", "1/column", ANY_NUMBER, .optional = true},
};

static const effect_parameter_t coercive_parameters[] = {
    [COERCIVE] = {"coercive", "1/column", ANY_NUMBER},
    [COERCIVE_BEND] = {"bend", "1/column", ANY_NUMBER, .optional = true},
    [COERCIVE_SHARE] = {"share", "1", .least = 0.0, .most = 1.0, .optional = true, .of_model = true},
};

/// For a column that goes as far as 1 from its reference; effect_use_limits divides by how far it goes.
static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    if (parameter == BEND) {
        *result = limits_linear(-0.6, 0.6, 0.0, 0.1, -0.1, 0.0);
        return;
    }
    const double size = parameter == GAIN     ? 1.0
                        : parameter == OFFSET ? limits_output_span(run)
                                              : fmax(run->largest_radius, DBL_MIN);
    *result = limits_linear(-2.0 * size, 2.0 * size, 0.0, 0.05 * size, -0.05 * size, 0.0);
}

static void coercive_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)run;
    *result = parameter == COERCIVE_BEND    ? limits_linear(-0.6, 0.6, 0.0, 0.1, -0.1, 0.0)
              : parameter == COERCIVE_SHARE ? limits_linear(0.0, 1.0, 0.0, 0.1, 0.1, 0.8)
                                            : limits_linear(-0.9, 0.9, 0.0, 0.03, -0.03, 0.1);
}

static double law(double bend, double column)
{
    return column * (1.0 + bend * column);
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    for (size_t i = 0; column != NULL && i < run->num_samples; ++i) {
        const double q = law(parameter[BEND], column[i]);
        series[i] = series[i] * (1.0 + parameter[GAIN] * q) + parameter[OFFSET] * q;
    }
}

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    for (size_t i = 0; column != NULL && i < run->num_samples; ++i) {
        const double q = law(parameter[BEND], column[i]);
        const double gain = 1.0 + parameter[GAIN] * q;
        if (gain > 0.0) {
            series[i] = (series[i] - parameter[OFFSET] * q) / gain;
        }
    }
}

/// Adds factor * q to the series that the hysteresis follows, which begins at 0.
static void follow(const effect_run_t* run, double factor, double bend, const double* column, double** series)
{
    if (column == NULL || !(fabs(factor) > 0.0)) {
        return;
    }
    if (*series == NULL) {
        *series = xcalloc(run->num_samples, sizeof **series);
    }
    for (size_t i = 0; i < run->num_samples; ++i) {
        (*series)[i] += factor * law(bend, column[i]);
    }
}

static void configure(const effect_run_t* run, const double* parameter, const double* column,
                      hysteresis_t* hysteresis)
{
    follow(run, parameter[WIDTH], parameter[BEND], column, &hysteresis->width);
}

static void configure_coercive(const effect_run_t* run, const double* parameter, const double* column,
                               hysteresis_t* hysteresis)
{
    follow(run, parameter[COERCIVE], parameter[COERCIVE_BEND], column, &hysteresis->coercive);
    follow(run, parameter[COERCIVE] * parameter[COERCIVE_SHARE], parameter[COERCIVE_BEND], column,
           &hysteresis->coercive_direct);
}

static const char what[] =
    "gain, offset, width or coercive field follow a measured column c (temperature, load, supply pressure)";

const effect_t effect_exogenous = {
    .name = "exogenous",
    .what = what,
    .law = "y' = y (1 + gain q) + offset q, r_j' = max(r_j + width q, 0), q = c (1 + bend c)",
    .stage = EFFECT_BODY,
    .transferable = true,
    .needs_column = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .apply = apply,
    .configure = configure,
    .invert = invert,
    .clips = true,
};

const effect_t effect_exogenous_coercive_field = {
    .name = "exogenous",
    .mechanism = "coercive_field",
    .what = what,
    .law = "the hysteretic part sees v_m + (v - v_m) (1 - coercive q), q = c (1 + bend c)\n"
           "share: the nonhysteretic part sees v - share (v - v_m) coercive q",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .needs_column = true,
    .num_parameters = COUNT_OF(coercive_parameters),
    .parameter = coercive_parameters,
    .limits = coercive_limits,
    .configure = configure_coercive,
};
