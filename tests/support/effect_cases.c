#include "effect_cases.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double coarse_step = 0.004;

// coth(pi damping / 2 / sqrt(1 - damping^2)) for the resonance of damping 0.1; 1.3 for a moving model whose
// loop feeds 0.15 of its relative steepness (below 1.5) back: 1 / (1 - 0.15 * 1.5). 1 + amount for creep,
// 1 + 0.2 ((1 + 16 / 0.2)^0.4 - 1) for creep by a power law.
// The stiffness reads the loop's middle from cells of 1/256 of an input unit: across a play's corner, where
// the slope changes by at most 0.12, a cell is 0.4 * 0.12 / 1024 off, and none of the curves bends as much;
// half a sample is 0.002 s of motion, here up to 8e-3.
// Twenty nodes: the other plant's spline is a sum of truncated powers, whose elimination loses some six
// digits. Heat: where the speed changes within a sample the mean square of its two parts is at most a quarter
// of the speed's square above the square of their mean, 7.3 at a speed below 5.4; nine such samples (eight
// plays and the turn) for each of at most four turns within tau, each with a weight of sample / tau, are
// below 0.8 of a unit, which moves the output by at most (offset + gain half) < 0.02 of that: 1.5 times half
// a sample's motion. Friction loses the sample's own travel at a turn, which is less.
static const effect_case_t cases[] = {
    {"gain_offset", NULL, {1.2, 0.1}, 0.0},
    {"delay", NULL, {0.083}, 1.0},
    {"delay", "measurement", {0.083}, 1.0},
    {"input_lag", NULL, {0.15, 0.3}, 1.3},
    {"slew_limit", NULL, {1.5, 0.2, 0.008}, 1.0},
    {"rate_dependence", "play_lag", {0.06, 0.7, 30.0, 0.2}, 1.0},
    {"rate_dependence", "widening", {0.03}, 1.0},
    {"rate_dependence", "diffusion", {0.15, 0.3}, 1.0},
    {"rate_dependence", "excess", {0.15, 0.3}, 1.0},
    {"creep", "additional", {0.4, 0.05, 2.0}, 1.4},
    {"creep", "delayed", {0.4, 0.05, 2.0}, 1.0},
    {"creep", "power_law", {0.2, 0.2, 0.4}, 2.0},
    {"noncongruency", "product", {0.3}, 0.0},
    {"noncongruency", "moving", {0.15}, 1.3},
    {"noncongruency", "increment", {0.2}, 1.2},
    {"noncongruency", "remanence_field", {0.15, 0.4}, 1.3},
    {"noncongruency", "remanence_stiffness", {0.4, 0.1, -0.2}, 0.01},
    {"wear", "amplitude", {0.05}, 0.0},
    {"wear", "increment", {0.05}, 1.0},
    {"wear", "response", {0.05, -0.4, 0.15, 0.4, 0.7, 2.2}, 1.0},
    {"unknown", "self_heating_losses", {1.5, 0.004, 0.01}, 3.0},
    {"unknown", "self_heating_friction", {1.5, 0.02, 0.05}, 3.0},
    {"initial_state", NULL, {0.4, 0.5, 0.6, 0.7, 0.6, 0.5}, 1.0},
    {"initial_state", "turning_points", {0.9, -0.5, 0.6, -0.1}, 1.0},
    {"output_lag", NULL, {0.12, 0.3}, 1.0},
    {"resonance", NULL, {1.5, 0.1, 0.12}, 6.4},
    {"backlash", NULL, {0.2, 0.6, 0.012}, 2.0},
    {"output_saturation", NULL, {-0.9, 0.8, 0.05}, 0.0},
    {"output_nonlinearity", "polynomial", {0.15, -0.06, -0.1, 0.05}, 0.0},
    {"output_nonlinearity", "two_point", {0.2, -0.4}, 0.0},
    {"drift", "linear", {0.03}, 0.0},
    {"drift", "spline", {0.1, 0.15, 0.1, -0.1, -0.2, -0.1}, 0.0},
    {"drift", "fine_spline", {0.1, 0.15, 0.1, -0.1, -0.2, -0.1, 0.05, 0.1, 0.05, 0.1}, 0.0},
    {"drift",
     "finest_spline",
     {0.1,  0.15, 0.1,  -0.1, -0.2, -0.1,  0.05, 0.1,   0.05, 0.1,
      0.12, 0.2,  0.15, 0.1,  0.05, -0.05, -0.1, -0.05, 0.1,  0.15},
     1e-6},
    {"drift",
     "dense_spline",
     {0.05, 0.1,  0.14, 0.15,  0.13,  0.1,  0.04,  -0.05, -0.12, -0.2, -0.18, -0.1, -0.02, 0.04,
      0.06, 0.05, 0.07, 0.1,   0.12,  0.1,  0.11,  0.13,  0.17,  0.2,  0.18,  0.15, 0.14,  0.12,
      0.08, 0.05, 0.01, -0.05, -0.09, -0.1, -0.08, -0.05, 0.02,  0.1,  0.13,  0.15},
     1e-6},
    {"periodic_disturbance", NULL, {0.55, 0.05, -0.03, 0.01, 0.02, -0.015, 0.01}, 0.0},
    {"periodic_disturbance", "run_up", {0.55, 0.05, -0.03, 0.01, 0.02, -0.015, 0.01, -0.2, 0.5, 1.6}, 0.0},
    {"quantization", NULL, {0.07, 0.02}, 0.0},
    {"exogenous", NULL, {0.03, 0.02, 0.01, 0.05}, 0.0},
    {"exogenous", "coercive_field", {0.04, 0.05, 0.3}, 1.3},
};

size_t effect_case_count(void)
{
    return sizeof cases / sizeof cases[0];
}

const effect_case_t* effect_case_at(size_t index)
{
    return &cases[index];
}

effect_use_t effect_case_use(const effect_case_t* of)
{
    effect_use_t use = {0};
    for (size_t e = 0; e < effect_count(); ++e) {
        const effect_t* effect = effect_at(e);
        const bool same_mechanism = of->mechanism == NULL ? effect->mechanism == NULL
                                                          : effect->mechanism != NULL &&
                                                                strcmp(effect->mechanism, of->mechanism) == 0;
        if (strcmp(effect->name, of->name) == 0 && same_mechanism) {
            use.effect = effect;
        }
    }
    memcpy(use.parameter, of->parameter, sizeof of->parameter);
    if (use.effect != NULL && use.effect->needs_column) {
        (void)snprintf(use.column, sizeof use.column, "temperature");
    }
    return use;
}

model_t effect_case_model(void)
{
    model_t model = model_new("plant");
    model.input_min = -2.0;
    model.input_max = 2.0;
    model.ascending = curve_tanh(0.9, -0.1);
    model.descending = curve_tanh(0.9, 0.1);
    model.nonhysteretic = curve_linear(0.2, 0.1);
    model_set_num_plays(&model, 8);
    for (size_t j = 0; j < model.num_plays; ++j) {
        model.radius[j] = 0.05 + 0.09 * (double)j;
        model.weight[j] = 0.25 - 0.02 * (double)j;
    }
    return model;
}

/// Held between 5 and 7 s.
static double smooth_input(double t)
{
    const double s = t < 5.0 ? t : fmax(t - 2.0, 5.0);
    return 1.1 * sin(1.3 * s) + 0.7 * sin(3.1 * s + 0.4);
}

static double smooth_temperature(double t)
{
    return 20.0 + 4.0 * sin(0.7 * t);
}

record_t effect_case_record(const double* sub, size_t num_sub)
{
    const size_t per_cell = num_sub + 1;
    const size_t count = (CASE_SAMPLES - 1) * per_cell + 1;
    record_t record = {.path = xstrdup("case.csv"), .num_samples = count, .num_auxiliary = 1};
    record.time = xcalloc(count, sizeof(double));
    record.input = xcalloc(count, sizeof(double));
    record.auxiliary = xcalloc(1, sizeof *record.auxiliary);
    record.auxiliary[0] = (column_t){xstrdup("temperature"), xcalloc(count, sizeof(double))};
    for (size_t i = 0; i < count; ++i) {
        const size_t cell = i / per_cell;
        const double part = i % per_cell == 0 ? 0.0 : sub[i % per_cell - 1];
        const double from = coarse_step * (double)cell;
        const double to = coarse_step * (double)(cell + 1);
        record.time[i] = from + part * coarse_step;
        record.input[i] = (1.0 - part) * smooth_input(from) + part * smooth_input(to);
        record.auxiliary[0].value[i] =
            (1.0 - part) * smooth_temperature(from) + part * smooth_temperature(to);
    }
    return record;
}

double effect_case_speed(const model_t* model, const record_t* record)
{
    // tanh is steepest at 0.
    double slope = model->nonhysteretic.slope;
    for (size_t j = 0; j < model->num_plays; ++j) {
        slope += model->weight[j] * fmax(model->ascending.slope, model->descending.slope);
    }
    double rate = 0.0;
    for (size_t i = 1; i < record->num_samples; ++i) {
        rate = fmax(rate,
                    fabs(record->input[i] - record->input[i - 1]) / (record->time[i] - record->time[i - 1]));
    }
    return slope * rate;
}

double effect_case_bound(const effect_case_t* of, const model_t* model, const record_t* record)
{
    // A sum of 30 terms of the order of 1 is right to 1e-14; the spline's elimination may lose two digits
    // more.
    const double rounding = 1e-12;
    return rounding + of->gain * 0.5 * coarse_step * effect_case_speed(model, record);
}
