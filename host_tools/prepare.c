#include "prepare.h"
#include <float.h>
#include <math.h>

static bool is_equal(double a, double b)
{
    return !(a < b) && !(a > b);
}

static double intercept(const curve_t* linear)
{
    return linear->gain * linear->shift + linear->offset;
}

static double total_weight(const model_t* model)
{
    double sum = 0.0;
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j];
    }
    return sum;
}

static model_t copy_plays_and_range(const model_t* model)
{
    model_t copy = model_new("");
    copy.input_min = model->input_min;
    copy.input_max = model->input_max;
    model_set_num_plays(&copy, model->num_plays);
    for (size_t j = 0; j < model->num_plays; ++j) {
        copy.radius[j] = model->radius[j];
        copy.weight[j] = model->weight[j];
    }
    return copy;
}

/// Half the gap between linear envelopes of equal slope: no radius is less, but for rounding.
static double half_gap(const model_t* model)
{
    return 0.5 * (intercept(&model->ascending) - intercept(&model->descending));
}

static bool is_classical(const model_t* model)
{
    const curve_t* ascending = &model->ascending;
    const curve_t* descending = &model->descending;
    return ascending->type == CURVE_LINEAR && descending->type == CURVE_LINEAR &&
           model->nonhysteretic.type == CURVE_LINEAR &&
           is_equal(ascending->gain * ascending->slope, descending->gain * descending->slope) &&
           model->radius[0] >= half_gap(model);
}

static prepared_t prepare_classical(const model_t* model)
{
    prepared_t prepared = {.model = copy_plays_and_range(model), .classical = true};
    const double slope = model->ascending.gain * model->ascending.slope;
    const double middle = 0.5 * (intercept(&model->ascending) + intercept(&model->descending));
    for (size_t j = 0; j < model->num_plays; ++j) {
        prepared.model.radius[j] = (model->radius[j] - half_gap(model)) / slope;
        prepared.model.weight[j] = model->weight[j] * slope;
    }
    const curve_t* nonhysteretic = &model->nonhysteretic;
    prepared.model.nonhysteretic = curve_linear(nonhysteretic->gain * nonhysteretic->slope, 0.0);
    prepared.constant = intercept(nonhysteretic) + total_weight(model) * middle;
    return prepared;
}

prepared_t prepare(const model_t* model)
{
    if (is_classical(model)) {
        return prepare_classical(model);
    }
    prepared_t prepared = {.model = copy_plays_and_range(model)};
    const double middle = model->input_min + 0.5 * (model->input_max - model->input_min);
    const double level = 0.5 * (curve_value(&model->descending, model->input_min) +
                                curve_value(&model->ascending, model->input_max));
    const double centre = curve_value(&model->nonhysteretic, middle);
    prepared.model.ascending = curve_copy(&model->ascending);
    prepared.model.descending = curve_copy(&model->descending);
    prepared.model.nonhysteretic = curve_copy(&model->nonhysteretic);
    curve_add(&prepared.model.ascending, -level);
    curve_add(&prepared.model.descending, -level);
    curve_add(&prepared.model.nonhysteretic, -centre);
    prepared.constant = centre + total_weight(model) * level;
    return prepared;
}

void prepared_free(prepared_t* prepared)
{
    model_free(&prepared->model);
    *prepared = (prepared_t){0};
}
