#include "diagnose_scope.h"

#include <math.h>

/// As identify has it (identify_samples.c): within this part of the range of an end counts as there.
static const double end_tolerance = 0.01;
/// As identify has it: more than this part of a record is not given away.
static const double most_left_out = 0.3;

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
