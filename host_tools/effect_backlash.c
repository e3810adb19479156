/// backlash: b = y + start width/2 at the record's start; a contact that gives passes on at once what is
/// quicker than its compliance.
/// width >= 0 [output units], fitted up to half the output's span. start in [-1, 1] [1]: where in its gap, 1
/// as a descent leaves it, -1 as an ascent; compliance >= 0 [s], fitted to four samples. Those are 0 when
/// left out.
/// Inverse: half the gap ahead in the direction of motion; where the wanted output holds, nothing moves;
/// across a contact that gives, sample by sample.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include "lag_step.h"
#include <math.h>

enum { WIDTH, START, COMPLIANCE };

static const effect_parameter_t parameters[] = {
    [WIDTH] = {"width", "output", AT_LEAST_0},
    [START] = {"start", "1", .least = -1.0, .most = 1.0, .optional = true},
    [COMPLIANCE] = {"compliance", "s", AT_LEAST_0, .optional = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double span = limits_output_span(run);
    const double step = run->sample_time;
    *result = parameter == WIDTH   ? limits_linear(0.0, 0.5 * span, 0.0, 0.03 * span, 0.1 * span, 0.01 * span)
              : parameter == START ? limits_linear(-1.0, 1.0, 0.0, 0.2, 0.8, -0.8)
                                   : limits_linear(0.0, 4.0 * step, 0.0, 0.2 * step, 0.8 * step, 0.1 * step);
}

/// Into z where the contact is when the output goes to y; what drives the sensor then.
static double driven(const double* parameter, lag_step_t contact, double from, double y, double* z,
                     double before)
{
    const double half = 0.5 * parameter[WIDTH];
    *z = lag_next(contact, *z, from, y);
    return fmax(*z - half, fmin(*z + half, before));
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    lag_kept_t kept = {0};
    double from = run->num_samples > 0 ? series[0] : 0.0;
    double z = from;
    double b = from + 0.5 * parameter[START] * parameter[WIDTH];
    for (size_t i = 0; i < run->num_samples; ++i) {
        const double y = series[i];
        if (i > 0) {
            const double step = run->time[i] - run->time[i - 1];
            const lag_step_t contact = lag_step_kept(&kept, step, parameter[COMPLIANCE], 0.0);
            b = driven(parameter, contact, from, y, &z, b);
        }
        series[i] = b + y - z;
        from = y;
    }
}

/// The output that moves the sensor to `wanted`: where the contact holds, its give alone does; else the gap
/// is taken up.
static double reaching(const double* parameter, lag_step_t contact, double from, double z, double b,
                       double wanted)
{
    const double half = 0.5 * parameter[WIDTH];
    const double rest = lag_next(contact, z, from, 0.0);
    const double holding = (wanted - b + rest) / (1.0 - contact.ramp);
    const double ahead = rest + contact.ramp * holding - b;
    return ahead > half ? wanted + half : ahead < -half ? wanted - half : holding;
}

static void invert_giving(const effect_run_t* run, const double* parameter, double* series)
{
    lag_kept_t kept = {0};
    double from = run->num_samples > 0 ? series[0] - 0.5 * parameter[START] * parameter[WIDTH] : 0.0;
    double z = from;
    double b = run->num_samples > 0 ? series[0] : 0.0;
    for (size_t i = 0; i < run->num_samples; ++i) {
        if (i > 0) {
            const double step = run->time[i] - run->time[i - 1];
            const lag_step_t contact = lag_step_kept(&kept, step, parameter[COMPLIANCE], 0.0);
            const double y = reaching(parameter, contact, from, z, b, series[i]);
            b = driven(parameter, contact, from, y, &z, b);
            from = y;
        }
        series[i] = from;
    }
}

/// In samples: a contact that gives less is at its end within rounding.
static const double least_give = 1e-9;

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    if (parameter[COMPLIANCE] > least_give * run->sample_time) {
        invert_giving(run, parameter, series);
        return;
    }
    const double half = 0.5 * parameter[WIDTH];
    double before = run->num_samples > 0 ? series[0] : 0.0;
    for (size_t i = 0; i < run->num_samples; ++i) {
        const double wanted = series[i];
        if (i == 0) {
            series[i] = wanted - parameter[START] * half;
        } else if (wanted > before) {
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
    .what =
        "lost motion between the material and the sensor (gear, loose joint): one more play, on the output",
    .law = "b = max(z - width/2, min(z + width/2, b)), y' = b + y - z, compliance dz/dt = y - z\n"
           "start: where in its gap, 1 as a descent leaves it, -1 as an ascent",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .has_threshold = true,
    .apply = apply,
    .invert = invert,
};
