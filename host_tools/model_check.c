#include "effect.h"
#include "model.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

static const model_fault_t no_fault = {.key = NULL, .subkey = NULL, .index = -1};

static model_fault_t fault(const char* key, const char* subkey, long index, const char* format, ...)
    __attribute__((format(printf, 4, 5)));

static model_fault_t fault(const char* key, const char* subkey, long index, const char* format, ...)
{
    model_fault_t result = {.key = key, .subkey = subkey, .index = index};
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(result.text, sizeof result.text, format, arguments);
    va_end(arguments);
    return result;
}

static model_fault_t check_range(const model_t* model)
{
    if (!isfinite(model->input_min)) {
        return fault("input", "min", -1, "the least input is not finite");
    }
    if (!isfinite(model->input_max)) {
        return fault("input", "max", -1, "the largest input is not finite");
    }
    if (!(model->input_min < model->input_max)) {
        return fault("input", "max", -1, "the largest input %.9g is not above the least input %.9g",
                     model->input_max, model->input_min);
    }
    if (!isfinite(model->input_max - model->input_min)) {
        return fault("input", "max", -1, "the input's range is too large to compute with");
    }
    return no_fault;
}

static model_fault_t check_table(const curve_t* curve, const char* key, bool strict)
{
    if (curve->num_knots < 2) {
        return fault(key, "x", -1, "a table of %zu knots, expected at least 2", curve->num_knots);
    }
    for (size_t i = 0; i < curve->num_knots; ++i) {
        const double x = curve->x[i];
        const double y = curve->y[i];
        if (!isfinite(x)) {
            return fault(key, "x", (long)i, "the knot's input is not finite");
        }
        if (!isfinite(y)) {
            return fault(key, "y", (long)i, "the knot's value is not finite");
        }
        if (i == 0) {
            continue;
        }
        if (!(x > curve->x[i - 1])) {
            return fault(key, "x", (long)i, "x is %.9g after %.9g, expected strictly increasing inputs", x,
                         curve->x[i - 1]);
        }
        if (strict ? !(y > curve->y[i - 1]) : !(y >= curve->y[i - 1])) {
            return fault(key, "y", (long)i, "y is %.9g after %.9g, expected %s values", y, curve->y[i - 1],
                         strict ? "strictly increasing" : "non-decreasing");
        }
        if (!isfinite((y - curve->y[i - 1]) / (x - curve->x[i - 1]))) {
            return fault(key, "y", (long)i, "the slope from the knot before is not finite");
        }
    }
    return no_fault;
}

static model_fault_t check_formula(const curve_t* curve, const char* key, bool strict)
{
    const struct {
        const char* name;
        double value;
    } parameters[] = {
        {"slope", curve->slope}, {"shift", curve->shift}, {"gain", curve->gain}, {"offset", curve->offset}};
    for (size_t i = 0; i < sizeof parameters / sizeof parameters[0]; ++i) {
        if (!isfinite(parameters[i].value)) {
            return fault(key, parameters[i].name, -1, "the curve's %s is not finite", parameters[i].name);
        }
    }
    const double rise = curve->gain * curve->slope;
    if (!isfinite(rise) || (strict ? !(rise > 0.0) : !(rise >= 0.0))) {
        return fault(key, "slope", -1, "gain * slope is %.9g, expected %s, so that the curve %s", rise,
                     strict ? "above 0" : "at least 0", strict ? "increases" : "does not decrease");
    }
    return no_fault;
}

static model_fault_t check_curve(const model_t* model, const curve_t* curve, const char* key, bool strict)
{
    const model_fault_t own =
        curve->type == CURVE_TABLE ? check_table(curve, key, strict) : check_formula(curve, key, strict);
    if (own.key != NULL) {
        return own;
    }
    const double low = curve_value(curve, model->input_min);
    const double high = curve_value(curve, model->input_max);
    if (!isfinite(low) || !isfinite(high) || !isfinite(high - low)) {
        return fault(key, NULL, -1, "the curve is not finite over the input's range");
    }
    if (strict && !(high > low)) {
        return fault(key, NULL, -1,
                     "the envelope stays at %.9g from input %.9g to %.9g, expected it to increase", low,
                     model->input_min, model->input_max);
    }
    return no_fault;
}

static model_fault_t check_plays(const model_t* model)
{
    if (model->num_plays == 0 || model->num_plays > MODEL_MAX_PLAYS) {
        return fault("radii", NULL, -1, "%zu plays, expected 1 to %d", model->num_plays, MODEL_MAX_PLAYS);
    }
    for (size_t i = 0; i < model->num_plays; ++i) {
        const double radius = model->radius[i];
        if (!isfinite(radius) || radius < 0.0) {
            return fault("radii", NULL, (long)i, "radius %.9g, expected a finite number of at least 0",
                         radius);
        }
        if (i > 0 && radius < model->radius[i - 1]) {
            return fault("radii", NULL, (long)i, "radius %.9g after %.9g, expected radii in increasing order",
                         radius, model->radius[i - 1]);
        }
        const double weight = model->weight[i];
        if (!isfinite(weight) || weight < 0.0) {
            return fault("weights", NULL, (long)i, "weight %.9g, expected a finite number of at least 0",
                         weight);
        }
    }
    return no_fault;
}

/// The plays' states stay within the envelopes' values and the radius; what they add up to must be a number.
static model_fault_t check_output(const model_t* model)
{
    const double reach = fmax(fabs(curve_value(&model->ascending, model->input_max)),
                              fabs(curve_value(&model->descending, model->input_min)));
    double sum = fmax(fabs(curve_value(&model->nonhysteretic, model->input_max)),
                      fabs(curve_value(&model->nonhysteretic, model->input_min)));
    for (size_t i = 0; i < model->num_plays; ++i) {
        sum += model->weight[i] * (reach + model->radius[i]);
        if (!isfinite(sum)) {
            return fault("weights", NULL, (long)i, "the output is not finite with this weight");
        }
    }
    return no_fault;
}

static model_fault_t check_order(const model_t* model)
{
    const double least = model_least_radius(model);
    if (model->radius[0] < least - model_tolerance(model)) {
        return fault("radii", NULL, 0,
                     "radius %.9g, expected at least %.9g: ascending - r must not exceed descending + r",
                     model->radius[0], least);
    }
    return no_fault;
}

static model_fault_t check_initial(const model_t* model)
{
    const double tolerance = model_tolerance(model);
    for (size_t i = 0; i < model->num_plays; ++i) {
        if (!isfinite(model->initial[i])) {
            return fault("initial", NULL, (long)i, "the state is not finite");
        }
        if (i > 0 && fabs(model->initial[i] - model->initial[i - 1]) >
                         model->radius[i] - model->radius[i - 1] + tolerance) {
            return fault(
                "initial", NULL, (long)i,
                "the state is further from the one before than their radii are: no input leaves it so");
        }
    }
    double low;
    double high;
    if (!model_initial_inputs(model, &low, &high)) {
        return fault("initial", NULL, 0, "the state %.9g is beyond what inputs within the range leave",
                     model->initial[0]);
    }
    return no_fault;
}

model_fault_t model_check(const model_t* model)
{
    model_fault_t found = check_range(model);
    if (found.key == NULL) {
        found = check_curve(model, &model->ascending, "ascending", true);
    }
    if (found.key == NULL) {
        found = check_curve(model, &model->descending, "descending", true);
    }
    if (found.key == NULL) {
        found = check_curve(model, &model->nonhysteretic, "nonhysteretic", false);
    }
    if (found.key == NULL) {
        found = check_plays(model);
    }
    if (found.key == NULL) {
        found = check_output(model);
    }
    if (found.key == NULL) {
        found = check_order(model);
    }
    if (found.key == NULL && model->initial != NULL) {
        found = check_initial(model);
    }
    if (found.key == NULL && model->effects != NULL) {
        found = effect_fault(model->effects);
    }
    return found;
}
