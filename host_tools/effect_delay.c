/// delay: of the input, or of the output (mechanism "measurement"), at its first value before the record: as
/// the hysteresis is rate independent the two are the same but between the samples, where a step's half gives
/// another output than half of the step's outputs. time >= 0 [s]. Fitted over 0 ... a tenth of the record.
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const effect_parameter_t parameters[] = {{"time", "s", AT_LEAST_0}};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)parameter;
    *result = limits_linear(0.0, 0.1 * run->duration, 0.0, 3.0 * run->sample_time, 10.0 * run->sample_time,
                            0.01 * run->duration);
}

static void apply(const effect_run_t* run, const double* parameter, const double* column, double* series)
{
    (void)column;
    const size_t size = run->num_samples * sizeof(double);
    double* given = memcpy(xmalloc(size), series, size);
    size_t cell = 0;
    for (size_t i = 0; i < run->num_samples; ++i) {
        const double time = run->time[i] - parameter[0];
        if (time <= run->time[0]) {
            series[i] = given[0];
            continue;
        }
        while (cell + 2 < run->num_samples && run->time[cell + 1] <= time) {
            cell += 1;
        }
        const double part = (time - run->time[cell]) / (run->time[cell + 1] - run->time[cell]);
        series[i] = given[cell] + part * (given[cell + 1] - given[cell]);
    }
    free(given);
}

/// What both mechanisms share.
#define DELAY(its_stage)                                                                                     \
    .name = "delay",                                                                                         \
    .what =                                                                                                  \
        "pure transport delay between command and response (a bus, a controller's cycle, a line's length)",  \
    .stage = (its_stage), .transferable = true, .num_parameters = COUNT_OF(parameters),                      \
    .parameter = parameters, .limits = limits, .has_threshold = true, .apply = apply,                        \
    .no_inverse = "the response can only come later than the command; ask for the output earlier instead"

const effect_t effect_delay = {DELAY(EFFECT_DRIVE), .law = "v'(t) = v(t - time), linear between the samples"};

const effect_t effect_delay_measurement = {DELAY(EFFECT_SENSOR),
                                           .law = "y'(t) = y(t - time), linear between the samples",
                                           .mechanism = "measurement"};
