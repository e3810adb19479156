#include "diagnose_scope.h"

#include "sinusoid.h"
#include <math.h>
#include <stdio.h>

/// As identify has it (identify_samples.c): within this part of the range of an end counts as there.
static const double end_tolerance = 0.01;
/// As identify has it: no more of a record is given away.
static const double most_left_out = 0.3;
/// Of the input's variance: two lines cannot both carry it.
static const double most_of_input = 0.5;

/// From this part of a record on, what lies beyond the model's range decides which effect fits best.
static const double much_beyond = 0.05;
/// A record that is mostly in loops the calibration never made says more of the weights, which larger loops
/// leave open, than of effects. A bench record of loops of several sizes leaves 0.1 to 0.3 of mixed work.
static const double much_unvisited = 0.5;
/// Of the range: less than this way back is no reversal but noise.
static const double least_turn = 0.03;

enum { CELLS = 8 };

size_t scope_first_fitted(const model_t* model)
{
    const json_int_t first = json_integer_value(json_object_get(model->identification, "first_fitted"));
    return first > 0 ? (size_t)first : 0;
}

static size_t first_judged(const model_t* model, const record_t* record)
{
    if (scope_first_fitted(model) == 0) {
        return 0;
    }
    const size_t most = (size_t)(most_left_out * (double)record->num_samples);
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (size_t t = 0; t < most; t++) {
        low = fmin(low, record->input[t]);
        high = fmax(high, record->input[t]);
    }
    const double near = end_tolerance * (high - low);
    bool was_low = false;
    bool was_high = false;
    size_t first = 0;
    while (first < most && !(was_low && was_high)) {
        was_low = was_low || record->input[first] <= low + near;
        was_high = was_high || record->input[first] >= high - near;
        first++;
    }
    return first;
}

static double beyond_range(const model_t* model, const record_t* record)
{
    const double near = end_tolerance * (model->input_max - model->input_min);
    size_t beyond = 0;
    for (size_t t = 0; t < record->num_samples; t++) {
        beyond += record->input[t] < model->input_min - near || record->input[t] > model->input_max + near;
    }
    return (double)beyond / (double)record->num_samples;
}

/// Where the input came from and where it is: the present monotone stretch, in cells of the model's range.
typedef struct {
    const model_t* model;
    double reversal, extreme; ///< [input] where the stretch began, and how far it came
    bool rising;
} stretch_t;

static size_t cell_of(const model_t* model, double value)
{
    const double place = CELLS * (value - model->input_min) / (model->input_max - model->input_min);
    return (size_t)fmin(fmax(place, 0), CELLS - 1);
}

/// Index into visited places, [2][CELLS][CELLS].
static size_t stretch_step(stretch_t* s, double value)
{
    const double ahead = s->rising ? value - s->extreme : s->extreme - value;
    if (ahead > 0) {
        s->extreme = value;
    } else if (-ahead > least_turn * (s->model->input_max - s->model->input_min)) {
        s->reversal = s->extreme;
        s->extreme = value;
        s->rising = !s->rising;
    }
    return ((s->rising ? CELLS : 0) + cell_of(s->model, s->reversal)) * CELLS + cell_of(s->model, value);
}

static double unvisited(const model_t* model, const record_t* calibration, const record_t* record)
{
    bool visited[2 * CELLS * CELLS] = {false};
    stretch_t there = {model, calibration->input[0], calibration->input[0], true};
    for (size_t t = 0; t < calibration->num_samples; t++) {
        visited[stretch_step(&there, calibration->input[t])] = true;
    }
    size_t count = 0;
    stretch_t here = {model, record->input[0], record->input[0], true};
    for (size_t t = 0; t < record->num_samples; t++) {
        count += !visited[stretch_step(&here, record->input[t])];
    }
    return (double)count / (double)record->num_samples;
}

scope_t scope_of(const model_t* model, const record_t* calibration, const record_t* record)
{
    return (scope_t){.first_judged = first_judged(model, record),
                     .beyond = beyond_range(model, record),
                     .unvisited = calibration != NULL ? unvisited(model, calibration, record) : 0};
}

bool scope_is_within(const scope_t* scope)
{
    return !(scope->beyond > much_beyond);
}

bool scope_is_known(const scope_t* scope)
{
    return scope_is_within(scope) && !(scope->unvisited > much_unvisited);
}

void scope_advise(const scope_t* scope, const model_t* model, char* text, size_t size)
{
    if (scope->beyond > much_beyond) {
        (void)snprintf(
            text, size,
            "first identify the model over the range in use: at %.0f %% of the samples the input is "
            "beyond its %.6g ... %.6g, and what the model says there was never measured",
            100 * scope->beyond, model->input_min, model->input_max);
    } else if (scope->unvisited > much_unvisited) {
        (void)snprintf(
            text, size,
            "first identify the model from loops of several sizes: %.0f %% of the samples are in loops "
            "that the calibration never made, and what the model says there was never measured",
            100 * scope->unvisited);
    }
}

double scope_input_frequency(const effect_run_t* run)
{
    const size_t n = run->num_samples;
    const double found = strongest_sinusoid(run->time, run->sample_time, run->input, n).frequency;
    return sinusoid_share(run->time, run->input, n, found) > most_of_input ? found : 0;
}
