#include "paper_study_cases.h"
#include "reference.h"
#include <math.h>
#include <stdlib.h>

const char* study_case_name(study_case_t which)
{
    static const char* const names[NUM_CASES] = {[CASE_UNIFORM] = "uniform",
                                                 [CASE_ONE_PEAK] = "one peak",
                                                 [CASE_TWO_PEAKS] = "two peaks",
                                                 [CASE_RANDOM] = "random",
                                                 [CASE_VO2] = "VO2-like"};
    return names[which];
}

/// 5 / sqrt(2 pi) exp(-(j - middle)^2 / denominator), as in Eqs. (23) and (24).
static double peak(int j, double middle, double denominator)
{
    return 5.0 / sqrt(2.0 * acos(-1.0)) * exp(-(j - middle) * (j - middle) / denominator);
}

static double case_weight(study_case_t which, int j, random_t* random)
{
    switch (which) {
    case CASE_ONE_PEAK:
        return peak(j, 15.0, 15.0);
    case CASE_TWO_PEAKS:
        return j <= 16 ? peak(j, 8.0, 8.0) : peak(j, 23.0, 8.0);
    case CASE_RANDOM:
        return random_uniform(random, 0.0, 1.0);
    case CASE_VO2:
        // A broad peak and a tail: Fig. 15 is a plot, its numbers are not printed.
        return peak(j, 7.0, 40.0) + 0.15 * peak(j, 20.0, 60.0);
    case CASE_UNIFORM:
    case NUM_CASES:
        break;
    }
    return 1.0;
}

model_t study_model(study_case_t which, uint64_t seed)
{
    random_t random = random_new(seed);
    model_t model = model_new(study_case_name(which));
    if (which == CASE_VO2) {
        model.input_min = 30.0;
        model.input_max = 90.0;
        model.ascending = curve_tanh(0.16, -10.26);
        model.descending = curve_tanh(0.201, -11.58);
        model.nonhysteretic = curve_tanh(0.03, -1.61);
        curve_add(&model.nonhysteretic, -3.26);
    } else {
        model.input_min = -4.0;
        model.input_max = 4.0;
        model.ascending = curve_tanh(1.0, -0.2);
        model.descending = curve_tanh(1.0, 0.2);
        model.nonhysteretic = curve_linear(0.0, 0.0);
    }
    model_set_num_plays(&model, STUDY_PLAYS);
    for (int j = 1; j <= STUDY_PLAYS; ++j) {
        model.radius[j - 1] = j / (which == CASE_VO2 ? 30.0 : 31.0);
        model.weight[j - 1] = case_weight(which, j, &random);
    }
    return model;
}

void study_input_free(study_input_t* input)
{
    free(input->input);
    *input = (study_input_t){0};
}

/// From the last sample, if any, to this fraction of the range.
static void go_to(study_input_t* input, const model_t* model, double fraction)
{
    const double span = model->input_max - model->input_min;
    const double to = model->input_min + fraction * span;
    const double from = input->num_samples > 0 ? input->input[input->num_samples - 1] : to;
    const size_t steps = (size_t)ceil(fabs(to - from) / span * 50.0) + (input->num_samples > 0 ? 0 : 1);
    input->input = xrealloc(input->input, (input->num_samples + steps + 1) * sizeof(double));
    for (size_t i = 1; i <= steps; ++i) {
        input->input[input->num_samples] = from + (to - from) * (double)i / (double)steps;
        input->num_samples += 1;
    }
}

study_input_t study_random_input(random_t* random, const model_t* model)
{
    study_input_t input = {0};
    go_to(&input, model, 0.0);
    for (int i = 0; i < 30; ++i) {
        go_to(&input, model, random_uniform(random, 0.0, 1.0));
    }
    return input;
}

study_input_t study_training_input(const model_t* model)
{
    study_input_t input = {0};
    go_to(&input, model, 0.0);
    for (int i = 0; i < 10; ++i) {
        const double amplitude = 0.5 - 0.05 * i;
        go_to(&input, model, 0.5 + amplitude);
        go_to(&input, model, 0.5 - amplitude);
    }
    return input;
}

study_input_t study_third_order_input(const model_t* model)
{
    static const double fractions[] = {0.0, 0.9, 0.25, 0.7, 0.4};
    study_input_t input = {0};
    for (size_t i = 0; i < sizeof fractions / sizeof *fractions; ++i) {
        go_to(&input, model, fractions[i]);
    }
    return input;
}

study_error_t study_error(const model_t* model, const model_t* small, const study_input_t* input)
{
    double* whole = xcalloc(input->num_samples, sizeof(double));
    double* compressed = xcalloc(input->num_samples, sizeof(double));
    reference_run(model, START_NEGATIVE_SATURATION, input->input, input->num_samples, whole);
    reference_run(small, START_NEGATIVE_SATURATION, input->input, input->num_samples, compressed);
    study_error_t result = {0};
    for (size_t t = 0; t < input->num_samples; ++t) {
        const double error = whole[t] - compressed[t];
        result.mean += error / (double)input->num_samples;
        result.rmse += error * error / (double)input->num_samples;
        result.largest = fmax(result.largest, fabs(error));
    }
    result.rmse = sqrt(result.rmse);
    free(whole);
    free(compressed);
    return result;
}

study_errors_t study_random_errors(const model_t* model, const model_t* small, uint64_t seed, int num_inputs)
{
    random_t random = random_new(seed);
    study_errors_t errors = {0};
    double sum = 0.0;
    double squares = 0.0;
    double samples = 0.0;
    for (int i = 0; i < num_inputs; ++i) {
        study_input_t input = study_random_input(&random, model);
        const study_error_t error = study_error(model, small, &input);
        const double count = (double)input.num_samples;
        errors.mean += error.rmse / num_inputs;
        errors.worst = fmax(errors.worst, error.rmse);
        sum += count * error.mean;
        squares += count * error.rmse * error.rmse;
        samples += count;
        study_input_free(&input);
    }
    errors.refitted = sqrt(fmax(squares / samples - sum * sum / samples / samples, 0.0));
    return errors;
}
