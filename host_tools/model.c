#include "model.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

model_t model_new(const char* name)
{
    return (model_t){
        .name = xstrdup(name),
        .input_unit = xstrdup(""),
        .output_unit = xstrdup(""),
        .input_max = 1.0,
        .ascending = curve_linear(1.0, 0.0),
        .descending = curve_linear(1.0, 0.0),
        .nonhysteretic = curve_linear(0.0, 0.0),
    };
}

static double* copy_values(const double* values, size_t count)
{
    if (values == NULL) {
        return NULL;
    }
    double* copy = xcalloc(count, sizeof(double));
    for (size_t i = 0; i < count; ++i) {
        copy[i] = values[i];
    }
    return copy;
}

model_t model_copy(const model_t* model)
{
    model_t copy = *model;
    copy.name = xstrdup(model->name);
    copy.input_unit = xstrdup(model->input_unit);
    copy.output_unit = xstrdup(model->output_unit);
    copy.ascending = curve_copy(&model->ascending);
    copy.descending = curve_copy(&model->descending);
    copy.nonhysteretic = curve_copy(&model->nonhysteretic);
    copy.radius = copy_values(model->radius, model->num_plays);
    copy.weight = copy_values(model->weight, model->num_plays);
    copy.initial = copy_values(model->initial, model->num_plays);
    copy.effects = json_deep_copy(model->effects);
    copy.identification = json_deep_copy(model->identification);
    return copy;
}

void model_free(model_t* model)
{
    free(model->name);
    free(model->input_unit);
    free(model->output_unit);
    curve_free(&model->ascending);
    curve_free(&model->descending);
    curve_free(&model->nonhysteretic);
    free(model->radius);
    free(model->weight);
    free(model->initial);
    json_decref(model->effects);
    json_decref(model->identification);
    *model = (model_t){0};
}

void model_set_num_plays(model_t* model, size_t num_plays)
{
    free(model->radius);
    free(model->weight);
    free(model->initial);
    model->num_plays = num_plays;
    model->radius = xcalloc(num_plays, sizeof(double));
    model->weight = xcalloc(num_plays, sizeof(double));
    model->initial = NULL;
}

double model_largest_moving_radius(const model_t* model)
{
    return 0.5 * (curve_value(&model->ascending, model->input_max) -
                  curve_value(&model->descending, model->input_min));
}

static double half_gap(const model_t* model, double v)
{
    return 0.5 * (curve_value(&model->ascending, v) - curve_value(&model->descending, v));
}

/// The largest half gap at a curve's knots within the range: exact when both envelopes are piecewise linear.
static double half_gap_at_knots(const model_t* model, const curve_t* curve, double largest)
{
    for (size_t i = 0; i < curve->num_knots; ++i) {
        if (curve->x[i] > model->input_min && curve->x[i] < model->input_max) {
            largest = fmax(largest, half_gap(model, curve->x[i]));
        }
    }
    return largest;
}

/// The largest half gap in [low, high], which holds one maximum, by golden section.
static double half_gap_peak(const model_t* model, double low, double high)
{
    const double golden = 0.6180339887498949;
    double largest = 0.0;
    // 0.618^80 < 2e-17: the last bit of the interval.
    for (int i = 0; i < 80; ++i) {
        const double left = high - golden * (high - low);
        const double right = low + golden * (high - low);
        const double at_left = half_gap(model, left);
        const double at_right = half_gap(model, right);
        largest = fmax(largest, fmax(at_left, at_right));
        if (at_left < at_right) {
            low = left;
        } else {
            high = right;
        }
    }
    return largest;
}

double model_least_radius(const model_t* model)
{
    const double ends = fmax(half_gap(model, model->input_min), half_gap(model, model->input_max));
    double largest = fmax(0.0, ends);
    largest = half_gap_at_knots(model, &model->ascending, largest);
    largest = half_gap_at_knots(model, &model->descending, largest);
    if (model->ascending.type != CURVE_TANH && model->descending.type != CURVE_TANH) {
        return largest;
    }
    enum { NUM_CELLS = 4096 };
    const double step = (model->input_max - model->input_min) / NUM_CELLS;
    double best = model->input_min;
    for (int i = 1; i < NUM_CELLS; ++i) {
        const double v = model->input_min + i * step;
        if (half_gap(model, v) > half_gap(model, best)) {
            best = v;
        }
    }
    const double low = fmax(model->input_min, best - step);
    const double high = fmin(model->input_max, best + step);
    return fmax(largest, half_gap_peak(model, low, high));
}

double model_tolerance(const model_t* model)
{
    return 1e-9 * fabs(curve_value(&model->ascending, model->input_max) -
                       curve_value(&model->descending, model->input_min));
}

bool model_initial_inputs(const model_t* model, double* low, double* high)
{
    // The states being 1-Lipschitz in the radius, the least radius has the narrowest strip.
    const double top = model->initial[0] + model->radius[0];
    const double bottom = model->initial[0] - model->radius[0];
    *low = curve_inverse(&model->descending, bottom, model->input_min, model->input_max);
    *high = fmax(*low, curve_inverse(&model->ascending, top, model->input_min, model->input_max));
    const double tolerance = model_tolerance(model);
    return curve_value(&model->descending, *low) >= bottom - tolerance &&
           curve_value(&model->ascending, *low) <= top + tolerance;
}
