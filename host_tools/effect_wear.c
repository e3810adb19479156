/// wear: the response fades (or, rate < 0, grows) with accumulated cycles: depolarisation, abrasion, fatigue.
///     amplitude:  S' = S_m + exp(-rate * spans) (S - S_m)
///     increment:  dS' = exp(-rate * spans) dS: what lies behind stays, only what follows is smaller
///     response:   y' = y_p + exp(-rate * spans) (y - y_p), y_p = y_m + pivot * half
/// response scales all of it, about a point of rest.
/// spans: the input's travel since the record's start over the width of the model's input range; S, S_m as
/// for noncongruency; y_m, half: middle and half of the model's output between its two saturations. pivot
/// [1], fitted to at most a quarter of their distance beyond them: fading about a point further away is a
/// drift. rate [1 per span of travel], fitted to a factor of e^2 either way over the record.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

enum { RATE, PIVOT };

static const effect_parameter_t parameters[] = {{"rate", "1/span", ANY_NUMBER}};

static const effect_parameter_t response_parameters[] = {
    [RATE] = {"rate", "1/span", ANY_NUMBER},
    [PIVOT] = {"pivot", "1", ANY_NUMBER, .optional = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)parameter;
    const double one = run->travel > 0.0 ? run->input_span / run->travel : 1.0;
    *result = limits_linear(-2.0 * one, 2.0 * one, 0.0, 0.1 * one, -0.1 * one, 0.7 * one);
}

static void response_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    if (parameter == RATE) {
        limits(run, parameter, result);
    } else {
        *result = limits_linear(-1.5, 1.5, 0.0, -0.5, 0.5, -1.0);
    }
}

/// Scales the series about the pivot by exp(sign * rate * spans).
static void scale_response(const effect_run_t* run, const double* parameter, double sign, double* series)
{
    const double middle = 0.5 * (run->output_min + run->output_max);
    const double pivot = middle + parameter[PIVOT] * 0.5 * (run->output_max - run->output_min);
    double spans = 0.0;
    for (size_t i = 0; i < run->num_samples; ++i) {
        spans += i > 0 ? fabs(run->input[i] - run->input[i - 1]) / run->input_span : 0.0;
        series[i] = pivot + exp(sign * parameter[RATE] * spans) * (series[i] - pivot);
    }
}

static void apply_response(const effect_run_t* run, const double* parameter, const double* column,
                           double* series)
{
    (void)column;
    scale_response(run, parameter, -1.0, series);
}

static void invert_response(const effect_run_t* run, const double* parameter, const double* column,
                            double* series)
{
    (void)column;
    scale_response(run, parameter, 1.0, series);
}

static void configure_amplitude(const effect_run_t* run, const double* parameter, const double* column,
                                hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->fade += parameter[0];
}

static void configure_increment(const effect_run_t* run, const double* parameter, const double* column,
                                hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->wear += parameter[0];
}

const effect_t effect_wear_amplitude = {
    .name = "wear",
    .mechanism = "amplitude",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .configure = configure_amplitude,
};

const effect_t effect_wear_increment = {
    .name = "wear",
    .mechanism = "increment",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .configure = configure_increment,
};

const effect_t effect_wear_response = {
    .name = "wear",
    .mechanism = "response",
    .stage = EFFECT_BODY,
    .transferable = true,
    .num_parameters = COUNT_OF(response_parameters),
    .parameter = response_parameters,
    .limits = response_limits,
    .apply = apply_response,
    .invert = invert_response,
};
