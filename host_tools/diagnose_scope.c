#include "diagnose_scope.h"

#include "sinusoid.h"
#include <math.h>

/// As identify has it (identify_samples.c): within this part of the range of an end counts as there.
static const double end_tolerance = 0.01;
/// As identify has it: more than this part of a record is not given away.
static const double most_left_out = 0.3;
/// Of the input's variance: two lines cannot both carry it.
static const double most_of_input = 0.5;

size_t scope_first_judged(const model_t* model, const record_t* record)
{
    const size_t n = record->num_samples;
    if (json_integer_value(json_object_get(model->identification, "first_fitted")) <= 0) {
        return 0;
    }
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (size_t t = 0; t < n; t++) {
        low = fmin(low, record->input[t]);
        high = fmax(high, record->input[t]);
    }
    const double near = end_tolerance * (high - low);
    bool was_low = false;
    bool was_high = false;
    size_t first = 0;
    while (first < n && !(was_low && was_high)) {
        was_low = was_low || record->input[first] <= low + near;
        was_high = was_high || record->input[first] >= high - near;
        first++;
    }
    return (double)first <= most_left_out * (double)n ? first : 0;
}

double scope_beyond(const model_t* model, const record_t* record)
{
    const double near = end_tolerance * (model->input_max - model->input_min);
    size_t beyond = 0;
    for (size_t t = 0; t < record->num_samples; t++) {
        beyond += record->input[t] < model->input_min - near || record->input[t] > model->input_max + near;
    }
    return (double)beyond / (double)record->num_samples;
}

double scope_input_frequency(const effect_run_t* run)
{
    const size_t n = run->num_samples;
    const double start = strongest_sinusoid(run->time, run->input, n).frequency;
    const double resolution = 1 / run->duration;
    double low = start - 0.5 * resolution;
    double high = start + 0.5 * resolution;
    // Within a line's width the share has one maximum. 20 thirds leave 3e-4 of the resolution.
    for (int i = 0; i < 20; i++) {
        const double left = low + (high - low) / 3;
        const double right = high - (high - low) / 3;
        if (sinusoid_share(run->time, run->input, n, left) <
            sinusoid_share(run->time, run->input, n, right)) {
            low = left;
        } else {
            high = right;
        }
    }
    const double found = 0.5 * (low + high);
    return sinusoid_share(run->time, run->input, n, found) > most_of_input ? found : 0;
}
