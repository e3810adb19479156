/// output_nonlinearity: two_point is right at both ends of the range, as a sensor is that was calibrated
/// there. Beyond |z| = 1 the map goes on
/// straight. All [1]; shift and linear say where the sensor was trimmed. The map increases: 1 + linear + 2
/// quadratic z + 3 cubic z^2 > 0 on [-1, 1], which of two_point's |bow| below 1/2 and |skew| below 1 always
/// do.
/// Inverse: by halving.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

enum { QUADRATIC, CUBIC, SHIFT, LINEAR };

static const effect_parameter_t parameters[] = {
    [QUADRATIC] = {"quadratic", "1", .least = -10.0, .most = 10.0},
    [CUBIC] = {"cubic", "1", .least = -10.0, .most = 10.0},
    [SHIFT] = {"shift", "1", .least = -10.0, .most = 10.0, .optional = true},
    [LINEAR] = {"linear", "1", .least = -0.9, .most = 10.0, .optional = true},
};

enum { BOW, SKEW };

static const effect_parameter_t two_point_parameters[] = {
    [BOW] = {"bow", "1", .least = -0.49, .most = 0.49},
    [SKEW] = {"skew", "1", .least = -0.99, .most = 0.99},
};

static void two_point_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)run;
    *result = parameter == BOW ? limits_linear(-0.45, 0.45, 0.0, 0.0, 0.1, -0.1)
                               : limits_linear(-0.95, 0.95, 0.0, 0.0, 0.2, -0.2);
}

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)run;
    // 1 - 0.3 - 2 * 0.22 - 3 * 0.08 > 0: increasing anywhere in the box.
    switch (parameter) {
    case QUADRATIC:
        *result = limits_linear(-0.22, 0.22, 0.0, 0.0, 0.05, -0.05);
        break;
    case CUBIC:
        *result = limits_linear(-0.08, 0.3, 0.0, 0.0, -0.05, 0.05);
        break;
    case SHIFT:
        *result = limits_linear(-0.5, 0.5, 0.0, 0.0, 0.0, 0.0);
        break;
    default:
        *result = limits_linear(-0.3, 0.5, 0.0, 0.0, 0.0, 0.0);
        break;
    }
}

static double slope_at(const double* parameter, double z)
{
    return 1.0 + parameter[LINEAR] + z * (2.0 * parameter[QUADRATIC] + 3.0 * parameter[CUBIC] * z);
}

static const char* fault(const double* parameter)
{
    double least = fmin(slope_at(parameter, -1.0), slope_at(parameter, 1.0));
    if (parameter[CUBIC] > 0.0) {
        const double lowest = -parameter[QUADRATIC] / (3.0 * parameter[CUBIC]);
        least = fmin(least, slope_at(parameter, fmin(fmax(lowest, -1.0), 1.0)));
    }
    return least > 0.0 ? NULL
                       : "output_nonlinearity: the map does not increase over the model's output range";
}

static double map(const double* parameter, double z)
{
    const double end = fmin(fmax(z, -1.0), 1.0);
    const double at_end = parameter[SHIFT] + (1.0 + parameter[LINEAR]) * end +
                          end * end * (parameter[QUADRATIC] + parameter[CUBIC] * end);
    return at_end + slope_at(parameter, end) * (z - end);
}

/// The z with map(z) = image.
static double unmap(const double* parameter, double image)
{
    const double low = map(parameter, -1.0);
    const double high = map(parameter, 1.0);
    if (image <= low) {
        return -1.0 + (image - low) / slope_at(parameter, -1.0);
    }
    if (image >= high) {
        return 1.0 + (image - high) / slope_at(parameter, 1.0);
    }
    double from = -1.0;
    double to = 1.0;
    // 2^-60 of the interval is below the last bit of an image of the order of 1.
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (from + to);
        if (map(parameter, middle) < image) {
            from = middle;
        } else {
            to = middle;
        }
    }
    return 0.5 * (from + to);
}

typedef double map_t(const double* parameter, double z);

static void run_map(const effect_run_t* run, const double* parameter, map_t* function, double* series)
{
    const double middle = 0.5 * (run->output_min + run->output_max);
    const double half = 0.5 * (run->output_max - run->output_min);
    for (size_t i = 0; half > 0.0 && i < run->num_samples; ++i) {
        const double z = (series[i] - middle) / half;
        series[i] += half * (function(parameter, z) - z);
    }
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    run_map(run, parameter, map, series);
}

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    run_map(run, parameter, unmap, series);
}

static void run_two_point(const effect_run_t* run, const double* parameter, map_t* function, double* series)
{
    const double cubic = parameter[SKEW] * (0.5 - fabs(parameter[BOW]));
    const double polynomial[] = {
        [QUADRATIC] = -parameter[BOW], [CUBIC] = -cubic, [SHIFT] = parameter[BOW], [LINEAR] = cubic};
    run_map(run, polynomial, function, series);
}

static void apply_two_point(const effect_run_t* run, const double* parameter, const double* column,
                            double* series)
{
    (void)column;
    run_two_point(run, parameter, map, series);
}

static void invert_two_point(const effect_run_t* run, const double* parameter, const double* column,
                             double* series)
{
    (void)column;
    run_two_point(run, parameter, unmap, series);
}

static const char what[] =
    "a smooth static map on the output (a sensor's characteristic, a lever's geometry)";

const effect_t effect_output_nonlinearity_two_point = {
    .name = "output_nonlinearity",
    .mechanism = "two_point",
    .what = what,
    .law = "y' = y + half_span (1 - z^2) (bow + skew (1/2 - |bow|) z), z = (y - y_m) / half_span; "
           "straight on beyond |z| = 1",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(two_point_parameters),
    .parameter = two_point_parameters,
    .limits = two_point_limits,
    .apply = apply_two_point,
    .invert = invert_two_point,
};

const effect_t effect_output_nonlinearity_polynomial = {
    .name = "output_nonlinearity",
    .mechanism = "polynomial",
    .what = what,
    .law = "y' = y + half_span (shift + linear z + quadratic z^2 + cubic z^3), z = (y - y_m) / half_span; "
           "straight on beyond |z| = 1",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .fault = fault,
    .limits = limits,
    .apply = apply,
    .invert = invert,
    .covers = 0.5, // gain_offset is a part of it
};
