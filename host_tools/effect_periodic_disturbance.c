/// periodic_disturbance: run_up is a machine whose speed and force settle; its time counts from the record's
/// start, and it holds for this record alone.
/// amplitude_sin and amplitude_cos are those of h = 1, the others may be left out. t: the record's own time.
/// frequency > 0 [Hz], fitted between four periods in the record (fewer are a drift) and half the sample
/// rate; amplitudes [output units]; shift [periods], fitted up to 1; swell [1], fitted up to 1.5; settling >
/// 0 [s], fitted from a fiftieth to half of the record. Lines at the first ten multiples of a periodic
/// input's frequency are an answer to it.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

enum { FREQUENCY, AMPLITUDE_SIN, AMPLITUDE_COS, SHIFT = 7, SWELL, SETTLING, HARMONICS = 3 };
/// Of a periodic input: the lines of a loop's corners fall off as 1 / h^2, beyond the tenth less than 1e-4 of
/// the first's energy is left in any; and the error of the input's frequency counts h times.
enum { MOST_MULTIPLE = 10 };

static const double two_pi = 6.283185307179586;

#define LINES                                                                                                \
    [FREQUENCY] = {"frequency", "Hz", .least = DBL_MIN, .most = DBL_MAX},                                    \
    [AMPLITUDE_SIN] = {"amplitude_sin", "output", ANY_NUMBER},                                               \
    [AMPLITUDE_COS] = {"amplitude_cos", "output", ANY_NUMBER},                                               \
    {"amplitude_sin_2", "output", ANY_NUMBER, .optional = true},                                             \
    {"amplitude_cos_2", "output", ANY_NUMBER, .optional = true},                                             \
    {"amplitude_sin_3", "output", ANY_NUMBER, .optional = true},                                             \
    {                                                                                                        \
        "amplitude_cos_3", "output", ANY_NUMBER, .optional = true                                            \
    }

static const effect_parameter_t parameters[] = {LINES};

static const effect_parameter_t run_up_parameters[] = {
    LINES,
    [SHIFT] = {"shift", "1", ANY_NUMBER},
    [SWELL] = {"swell", "1", ANY_NUMBER},
    [SETTLING] = {"settling", "s", .least = DBL_MIN, .most = DBL_MAX},
};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    if (parameter != FREQUENCY) {
        const double span = limits_output_span(run);
        const double start = parameter <= AMPLITUDE_COS ? 0.02 * span : 0.0;
        *result = limits_linear(-span, span, 0.0, start, -start, 0.0);
        return;
    }
    const double low = 4.0 / run->duration;
    const double high = fmax(0.5 / run->sample_time, 2.0 * low);
    const double middle = sqrt(low * high);
    *result = limits_logarithmic(low, high, middle, middle, sqrt(low * middle), sqrt(middle * high));
}

static void run_up_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    if (parameter < SHIFT) {
        limits(run, parameter, result);
    } else if (parameter == SETTLING) {
        *result = limits_logarithmic(0.02 * run->duration, 0.5 * run->duration, 0.02 * run->duration,
                                     0.08 * run->duration, 0.15 * run->duration, 0.05 * run->duration);
    } else {
        const double most = parameter == SHIFT ? 1.0 : 1.5;
        *result = limits_linear(-most, most, 0.0, 0.0, 0.2 * most, -0.2 * most);
    }
}

/// What is left of the start after t.
static double unsettled(const double* parameter, double t)
{
    return exp(-t / parameter[SETTLING]);
}

static void add(const effect_run_t* run, const double* parameter, bool runs_up, double sign, double* series)
{
    for (size_t i = 0; i < run->num_samples; ++i) {
        // Whole periods off first, in the period's own unit: a late record keeps its phase.
        const double start = runs_up ? unsettled(parameter, run->time[i] - run->time[0]) : 0.0;
        const double swollen = sign * (runs_up ? 1.0 + parameter[SWELL] * start : 1.0);
        const double periods =
            parameter[FREQUENCY] * run->time[i] + (runs_up ? parameter[SHIFT] * start : 0.0);
        const double angle = two_pi * (periods - floor(periods));
        const double first[] = {sin(angle), cos(angle)};
        double line[] = {0.0, 1.0};
        for (int h = 0; h < HARMONICS; ++h) {
            const double* amplitude = &parameter[AMPLITUDE_SIN + 2 * h];
            const double turned = line[0] * first[1] + line[1] * first[0];
            line[1] = line[1] * first[1] - line[0] * first[0];
            line[0] = turned;
            series[i] += swollen * (amplitude[0] * line[0] + amplitude[1] * line[1]);
        }
    }
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    add(run, parameter, false, 1.0, series);
}

static void invert(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    add(run, parameter, false, -1.0, series);
}

static void apply_run_up(const effect_run_t* run, const double* parameter, const double* column,
                         double* series)
{
    (void)column;
    add(run, parameter, true, 1.0, series);
}

static void invert_run_up(const effect_run_t* run, const double* parameter, const double* column,
                          double* series)
{
    (void)column;
    add(run, parameter, true, -1.0, series);
}

/// Another record starts when the machine has settled, or at another time.
static void settle(double* parameter)
{
    parameter[SHIFT] = 0.0;
    parameter[SWELL] = 0.0;
}

/// Whether the record cannot tell the frequency from one of the first multiples of the input's: an answer to
/// a periodic input has lines there and nowhere else, in one phase for as long as the record lasts.
static bool is_multiple_of_input(const effect_run_t* run, double frequency)
{
    const double multiple = round(frequency / run->input_frequency);
    return multiple >= 1.0 && multiple <= MOST_MULTIPLE &&
           fabs(frequency - multiple * run->input_frequency) < 0.5 / run->duration;
}

static bool follows_input(const effect_run_t* run, const double* parameter)
{
    double energy = 0.0;
    double locked = 0.0;
    for (int h = 0; run->input_frequency > 0.0 && h < HARMONICS; ++h) {
        const double* amplitude = &parameter[AMPLITUDE_SIN + 2 * h];
        const double line = amplitude[0] * amplitude[0] + amplitude[1] * amplitude[1];
        energy += line;
        locked += is_multiple_of_input(run, (h + 1) * parameter[FREQUENCY]) ? line : 0.0;
    }
    return locked > 0.5 * energy;
}

static const char what[] = "additive oscillation unrelated to the input (mains hum, a pump, a fan)";

const effect_t effect_periodic_disturbance = {
    .name = "periodic_disturbance",
    .what = what,
    .law = "y' = y + sum_h amplitude_sin_h sin(2 pi h frequency t) + amplitude_cos_h cos(2 pi h frequency "
           "t), h = 1, 2, 3",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(parameters),
    .parameter = parameters,
    .limits = limits,
    .apply = apply,
    .invert = invert,
    .follows_input = follows_input,
    .covers = 0.5, // on periodic work its harmonics follow what the body itself does beside the model
};

const effect_t effect_periodic_disturbance_run_up = {
    .name = "periodic_disturbance",
    .mechanism = "run_up",
    .what = what,
    .law =
        "y' = y + (1 + swell x) sum_h amplitude_sin_h sin(2 pi h (frequency t + shift x)) + amplitude_cos_h "
        "cos(...),\n"
        "x = exp(-(t - t0) / settling)",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = COUNT_OF(run_up_parameters),
    .parameter = run_up_parameters,
    .limits = run_up_limits,
    .for_another_record = settle,
    .apply = apply_run_up,
    .invert = invert_run_up,
    .follows_input = follows_input,
    .covers = 0.75, // what runs evenly comes first
};
