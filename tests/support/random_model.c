#include "random_model.h"
#include <float.h>

static curve_t random_table(random_t* random, double low, double high, bool strict)
{
    enum { MAX_KNOTS = 20 };
    double x[MAX_KNOTS];
    double y[MAX_KNOTS];
    const size_t num_knots = 2 + random_below(random, MAX_KNOTS - 1);
    x[0] = low - random_uniform(random, -0.1, 0.1) * (high - low);
    y[0] = random_uniform(random, -2.0, 2.0);
    for (size_t i = 1; i < num_knots; ++i) {
        const bool flat = !strict && random_below(random, 4) == 0;
        x[i] = x[i - 1] + random_uniform(random, 0.1, 2.0) * (high - low) / (double)num_knots;
        y[i] = y[i - 1] + (flat ? 0.0 : random_uniform(random, 0.01, 1.0));
    }
    return curve_table(x, y, num_knots);
}

static curve_t random_curve(random_t* random, double low, double high, bool strict)
{
    const double width = high - low;
    const double slope = random_uniform(random, 0.5, 8.0) / width;
    curve_t curve;
    switch (random_below(random, 3)) {
    case 0:
        curve = curve_linear(slope, random_uniform(random, -1.0, 1.0));
        break;
    case 1:
        curve = curve_tanh(slope, -slope * random_uniform(random, low, high));
        break;
    default:
        curve = random_table(random, low, high, strict);
        break;
    }
    curve_scale(&curve, random_uniform(random, 0.2, 3.0));
    curve_add(&curve, random_uniform(random, -1.0, 1.0));
    return curve;
}

static void random_plays(random_t* random, model_t* model)
{
    model_set_num_plays(model, 1 + random_below(random, 40));
    const double least = model_least_radius(model);
    const double span = fmax(model_largest_moving_radius(model) - least, 0.0) + 0.1;
    double radius = least;
    for (size_t j = 0; j < model->num_plays; ++j) {
        radius += random_below(random, 4) == 0
                      ? 0.0
                      : random_uniform(random, 0.0, 2.4) * span / (double)model->num_plays;
        model->radius[j] = radius;
        model->weight[j] = random_below(random, 5) == 0 ? 0.0 : random_uniform(random, 0.0, 2.0);
    }
}

model_t random_model(random_t* random)
{
    model_t model = model_new("random");
    model.input_min = random_uniform(random, -50.0, 50.0);
    model.input_max = model.input_min + random_uniform(random, 0.1, 100.0);
    curve_free(&model.ascending);
    curve_free(&model.descending);
    curve_free(&model.nonhysteretic);
    model.ascending = random_curve(random, model.input_min, model.input_max, true);
    model.descending = random_curve(random, model.input_min, model.input_max, true);
    model.nonhysteretic = random_curve(random, model.input_min, model.input_max, false);
    random_plays(random, &model);
    return model;
}

model_t random_classical_model(random_t* random)
{
    model_t model = model_new("classical");
    model.input_min = random_uniform(random, -5.0, 0.0);
    model.input_max = random_uniform(random, 1.0, 5.0);
    model.nonhysteretic.slope = random_uniform(random, 0.0, 1.0);
    random_plays(random, &model);
    return model;
}

void random_input(random_t* random, const model_t* model, double* input, size_t num_samples)
{
    double present = random_uniform(random, model->input_min, model->input_max);
    double step = 0.0;
    for (size_t i = 0; i < num_samples; ++i) {
        if (random_below(random, 6) == 0) {
            const double goal = random_uniform(random, model->input_min, model->input_max);
            step =
                random_below(random, 4) == 0 ? 0.0 : (goal - present) / (double)(1 + random_below(random, 8));
        }
        present = fmin(fmax(present + step, model->input_min), model->input_max);
        input[i] = present;
    }
}

static double magnitude(const curve_t* curve, const model_t* model)
{
    double largest = fabs(curve->offset) + fabs(curve->gain) * (fabs(curve->shift) + 1.0);
    for (size_t i = 0; i < curve->num_knots; ++i) {
        largest = fmax(largest, fabs(curve->y[i]));
    }
    // The argument slope * v + shift is rounded too.
    const double argument = curve_steepness(curve) * fmax(fabs(model->input_min), fabs(model->input_max));
    return fmax(largest, fmax(fabs(curve_value(curve, model->input_min)),
                              fabs(curve_value(curve, model->input_max)))) +
           argument;
}

double state_rounding(const model_t* model)
{
    const double envelope = fmax(magnitude(&model->ascending, model), magnitude(&model->descending, model));
    return 4.0 * DBL_EPSILON * (envelope + model->radius[model->num_plays - 1]);
}

double output_rounding(const model_t* model)
{
    double sum = 4.0 * DBL_EPSILON * magnitude(&model->nonhysteretic, model);
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j] * state_rounding(model);
    }
    return sum * (1.0 + (double)model->num_plays / 4.0);
}

double curve_steepness(const curve_t* curve)
{
    double steepest = curve->type == CURVE_TABLE ? 0.0 : fabs(curve->gain * curve->slope);
    for (size_t i = 0; i + 1 < curve->num_knots; ++i) {
        steepest = fmax(steepest, (curve->y[i + 1] - curve->y[i]) / (curve->x[i + 1] - curve->x[i]));
    }
    return steepest;
}
