/// wear: of `increment` what lies behind stays, only what follows is smaller; `response` counts in s each
/// move (its speed / speed)^speed_power times, and scales all of it, about a point of rest; what runs in
/// settles, and fast or long strokes may wear more than their length. pivot [1], fitted to at most a quarter
/// of the output's range beyond its saturations: fading about a point further away is a drift. rate [1 per
/// span of travel], fitted to a factor of e^2 either way over the record. settling >= 0 [1 per span], fitted
/// to three lives a record; speed_power [1], fitted from 0 to 1.2, with speed [input/s] the record's own
/// mean: at the mean it counts as travel does; output_share 0 ... 1 [1] of the strokes counted is the
/// material's own (in spans of the output), the rest the input's: inside its play a material does not move.
/// Those are 0 when left out: damage is the input's spans. Source of damage by powers of a stroke: J.
/// Lemaitre, R. Desmorat, Engineering Damage Mechanics (2005), ch. 6.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

enum { RATE, PIVOT, SETTLING, SPEED_POWER, OUTPUT_SHARE, SPEED };

static const effect_parameter_t parameters[] = {{"rate", "1/span", ANY_NUMBER}};

static const effect_parameter_t response_parameters[] = {
    [RATE] = {"rate", "1/span", ANY_NUMBER},
    [PIVOT] = {"pivot", "1", ANY_NUMBER, .optional = true},
    [SETTLING] = {"settling", "1/span", AT_LEAST_0, .optional = true},
    [SPEED_POWER] = {"speed_power", "1", .least = 0.0, .most = 4.0, .optional = true},
    [OUTPUT_SHARE] = {"output_share", "1", .least = 0.0, .most = 1.0, .optional = true},
    [SPEED] = {"speed", "input/s", AT_LEAST_0, .optional = true, .is_unit = true},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)parameter;
    const double one = run->travel > 0.0 ? run->input_span / run->travel : 1.0;
    *result = limits_linear(-2.0 * one, 2.0 * one, 0.0, 0.1 * one, -0.1 * one, 0.7 * one);
}

static double mean_speed(const effect_run_t* run)
{
    return run->travel > 0.0 ? run->travel / run->duration : 1.0;
}

static void response_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double one = run->travel > 0.0 ? run->input_span / run->travel : 1.0;
    const double speed = mean_speed(run);
    switch (parameter) {
    case PIVOT:
        *result = limits_linear(-1.5, 1.5, 0.0, -0.5, 0.5, -1.0);
        break;
    case SETTLING:
        *result = limits_linear(0.0, 3.0 * one, 0.0, 0.1 * one, 1.5 * one, 0.1 * one);
        break;
    case SPEED_POWER:
        *result = limits_linear(0.0, 1.2, 0.0, 0.1, 0.1, 0.8);
        break;
    case OUTPUT_SHARE:
        *result = limits_linear(0.0, 1.0, 0.0, 0.9, 0.9, 0.1);
        break;
    case SPEED:
        *result = limits_linear(0.0, 2.0 * speed, speed, speed, speed, speed);
        break;
    default:
        limits(run, parameter, result);
    }
}

/// Spans that the move to a sample counts as, where the output moves by so many of its own.
static double spans_of(const effect_run_t* run, const double* parameter, size_t i, double output_spans)
{
    const double input_spans = fabs(run->input[i] - run->input[i - 1]) / run->input_span;
    const double move = input_spans + parameter[OUTPUT_SHARE] * (output_spans - input_spans);
    const bool counts_speed = parameter[SPEED_POWER] > 0.0 && parameter[SPEED] > 0.0 && move > 0.0;
    const double speed = move * run->input_span / (run->time[i] - run->time[i - 1]);
    return counts_speed ? pow(speed / parameter[SPEED], parameter[SPEED_POWER]) * move : move;
}

/// (1 - exp(-settling * spans)) / settling
static double damage_of(double settling, double spans)
{
    const double settled = settling * spans;
    return settled > 0.0 ? spans * (-expm1(-settled) / settled) : spans;
}

static void apply_response(const effect_run_t* run, const double* parameter, const double* column,
                           double* series)
{
    (void)column;
    const double middle = 0.5 * (run->output_min + run->output_max);
    const double range = run->output_max - run->output_min;
    const double pivot = middle + parameter[PIVOT] * 0.5 * range;
    const double output_span = range > 0.0 ? range : 1.0;
    double spans = 0.0;
    double last = run->num_samples > 0 ? series[0] : 0.0;
    for (size_t i = 0; i < run->num_samples; ++i) {
        spans += i > 0 ? spans_of(run, parameter, i, fabs(series[i] - last) / output_span) : 0.0;
        last = series[i];
        const double damage = damage_of(parameter[SETTLING], spans);
        series[i] = pivot + exp(-parameter[RATE] * damage) * (series[i] - pivot);
    }
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

static const char what[] =
    "the response fades (or, rate < 0, grows) with accumulated cycles: depolarisation, abrasion, fatigue";

const effect_t effect_wear_amplitude = {
    .name = "wear",
    .mechanism = "amplitude",
    .what = what,
    .law = "S' = S_m + exp(-rate spans) (S - S_m)",
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
    .what = what,
    .law = "dS' = exp(-rate spans) dS",
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
    .what = what,
    .law = "y' = y_p + exp(-rate damage) (y - y_p), y_p = y_m + pivot half_span, "
           "damage = (1 - exp(-settling s)) / settling\n"
           "output_share: so much of each stroke in s is the output's own, in widths of its range",
    .stage = EFFECT_BODY,
    .transferable = true,
    .num_parameters = COUNT_OF(response_parameters),
    .parameter = response_parameters,
    .limits = response_limits,
    .apply = apply_response,
    .no_inverse = "the fading counts the travel of the very command that is sought",
    .covers = 0.25, // fading that settles at once is a gain
};
