/// resonance: the mode is at rest at the first value before the record. Exact for the course between the
/// samples, stable for any step. frequency > 0 [Hz], damping 0 ... 0.999 [1]. At high frequency it does
/// nothing. direct 0 ... 0.5 [1]: what the higher modes carry, quick enough to follow at once (residual
/// flexibility, D. J. Ewins, Modal Testing, ch. 2). hold and late 0 ... 1 [1]: a mode of a few samples'
/// period rings by what y does between them. As a sample begins y has made `hold` of the step, of the rest
/// `late` is missing as it ends, and between it goes straight: 0, 0 all the way, 1 a converter that is there
/// at once, 0, 1 one that stays, 0.5, 1 a staircase of means. Those three are 0 when left out.
/// Inverse: of a mode m, y = m + 2 damping/w m' + m''/w^2, and with direct that through a mode of w /
/// sqrt(direct) and damping sqrt(direct).
#include "effect_catalogue.h"
#include "effect_lag.h"
#include "effect_limits.h"
#include <math.h>
#include <stdlib.h>

enum { FREQUENCY, DAMPING, DIRECT, HOLD, LATE };

static const double two_pi = 6.283185307179586;

static const effect_parameter_t parameters[] = {
    [FREQUENCY] = {"frequency", "Hz", .least = DBL_MIN, .most = DBL_MAX},
    [DAMPING] = {"damping", "1", .least = 0.0, .most = 0.999},
    [DIRECT] = {"direct", "1", .least = 0.0, .most = 0.5, .optional = true},
    [HOLD] = {"hold", "1", .least = 0.0, .most = 1.0, .optional = true},
    [LATE] = {"late", "1", .least = 0.0, .most = 1.0, .optional = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    if (parameter == DAMPING) {
        *result = limits_logarithmic(1e-3, 0.999, 0.7, 0.05, 0.2, 0.01);
        return;
    }
    if (parameter == DIRECT) {
        *result = limits_linear(0.0, 0.3, 0.0, 0.05, 0.1, 0.02);
        return;
    }
    if (parameter == HOLD || parameter == LATE) {
        *result = hold_limits();
        return;
    }
    const double high = 5.0 / run->sample_time;
    *result = limits_logarithmic(fmin(0.5 / run->duration, 0.5 * high), high, high, 0.05 / run->sample_time,
                                 0.015 / run->sample_time, 0.15 / run->sample_time);
}

/// What a step of the free mode does to (e, e'/w).
typedef struct {
    double step;         ///< [s]
    double cosine, sine; ///< e^(-damping w t) cos(w_d t), e^(-damping w t) sin(w_d t) / sqrt(1 - damping^2)
} rotation_t;

static rotation_t rotation(double w, double damping, double step)
{
    const double root = sqrt(1.0 - damping * damping);
    const double decay = exp(-damping * w * step);
    return (rotation_t){step, decay * cos(w * root * step), decay * sin(w * root * step) / root};
}

static void apply_series(const effect_run_t* run, const double* parameter, double* series)
{
    const double w = two_pi * parameter[FREQUENCY];
    const double damping = parameter[DAMPING];
    double before = run->num_samples > 0 ? series[0] : 0.0;
    double place = before;
    double speed = 0.0; // y'/w
    rotation_t turn = {0};
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double step = run->time[i] - run->time[i - 1];
        const double begin = before + parameter[HOLD] * (series[i] - before);
        const double end = series[i] + parameter[LATE] * (begin - series[i]);
        // Follows x = begin + slope w t with the lag 2 damping slope; the rest rings.
        const double slope = (end - begin) / (w * step);
        const double e = place - begin + 2.0 * damping * slope;
        const double f = speed - slope;
        turn = lag_is_same_step(step, turn.step) ? turn : rotation(w, damping, step);
        place = end - 2.0 * damping * slope + turn.cosine * e + turn.sine * (damping * e + f);
        speed = slope + turn.cosine * f - turn.sine * (e + damping * f);
        before = series[i];
        series[i] = place + parameter[DIRECT] * (before - place);
    }
}

static void lead_series(const effect_run_t* run, const double* parameter, double* series)
{
    const double w = two_pi * parameter[FREQUENCY];
    const size_t size = run->num_samples * sizeof(double);
    double* slope = xmalloc(size);
    double* curvature = xmalloc(size);
    series_derivatives(run, series, slope, curvature);
    for (size_t i = 0; i < run->num_samples; ++i) {
        series[i] += 2.0 * parameter[DAMPING] / w * slope[i] + curvature[i] / (w * w);
    }
    free(slope);
    free(curvature);
    if (parameter[DIRECT] > 0.0) {
        const double root = sqrt(parameter[DIRECT]);
        const double rest[] = {
            [FREQUENCY] = parameter[FREQUENCY] / root, [DAMPING] = parameter[DAMPING] * root, [LATE] = 0.0};
        apply_series(run, rest, series);
    }
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    apply_series(run, parameter, series);
}

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    series_invert(run, parameter, apply_series, lead_series, series);
}

/// Past this damping nothing rings: a step's overshoot is below a tenth, as a lag's. A mode above half the
/// samples' rate shows as its alias, the slower the nearer it is to the rate, where it is a lag or a part of
/// a delay. Just above the half the alias is as quick, and a fit may take it for the mode.
static bool does_not_ring(const effect_run_t* run, const double* parameter)
{
    return parameter[DAMPING] > 0.6 || parameter[FREQUENCY] * run->sample_time > 0.6;
}

const effect_t effect_resonance = {
    .name = "resonance",
    .what = "second-order, lightly damped mode behind the hysteresis (the stage on the actuator)",
    .law =
        "y' = (1 - direct) x + direct y, d^2x/dt^2 + 2 damping w dx/dt + w^2 x = w^2 y, w = 2 pi frequency\n"
        "hold, late: between the samples y goes straight (0, 0), is at once where the next has it (1, 0) or "
        "stays (0, 1)",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .is_another = does_not_ring,
    .apply = apply,
    .invert = invert,
};
