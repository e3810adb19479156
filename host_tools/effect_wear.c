/// wear: the response fades (or, rate < 0, grows) with accumulated cycles: depolarisation, abrasion, fatigue.
///     amplitude:  S' = S_m + exp(-rate * spans) (S - S_m)
///     increment:  dS' = exp(-rate * spans) dS: what lies behind stays, only what follows is smaller
/// spans: the input's travel since the record's start over the width of the model's input range; S, S_m as
/// for noncongruency. rate [1 per span of travel], fitted to a factor of e^2 either way over the record.
#include "effect_catalogue.h"
#include "effect_limits.h"

static const effect_parameter_t parameters[] = {{"rate", "1/span", ANY_NUMBER}};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)parameter;
    const double one = run->travel > 0.0 ? run->input_span / run->travel : 1.0;
    *result = limits_linear(-2.0 * one, 2.0 * one, 0.0, 0.1 * one, -0.1 * one, 0.7 * one);
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
