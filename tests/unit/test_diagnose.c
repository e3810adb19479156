#include "classical_model.h"
#include "diagnose.h"
#include "diagnose_shrink.h"
#include "effect_catalogue.h"
#include "random.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 3000, PLAYS = 8, FINE = 20 };

static double time_of[SAMPLES];
static double input[SAMPLES];
static double output[SAMPLES];
static double column_value[SAMPLES];
static model_t model;
static diagnosis_t diagnosis;
static const double noise = 0.01;

/// Classical PI over 0 ... 10; the plant below runs it with code of its own, on a grid FINE times as dense.
void setUp(void)
{
    model = classical_model_of_falling_weights(PLAYS);
    diagnosis = (diagnosis_t){0};
}

void tearDown(void)
{
    diagnosis_free(&diagnosis);
    model_free(&model);
}

/// Ramps between random levels at random speeds, falls at most as fast as `fastest_fall`, now and then a
/// hold: 0.01 s a sample.
static void make_input_falling(uint64_t seed, double fastest_fall)
{
    random_t random = random_new(seed);
    double v = 0;
    double target = 10;
    double speed = 20;
    size_t hold = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        time_of[t] = 0.01 * (double)t;
        input[t] = v;
        column_value[t] = 20 + 3 * sin(2.3e-3 * (double)t);
        if (hold > 0) {
            hold--;
            continue;
        }
        const double step = (target > v ? speed : fmin(speed, fastest_fall)) * 0.01;
        v = fabs(target - v) <= step ? target : v + (target > v ? step : -step);
        if (fabs(target - v) <= 0) {
            target = random_uniform(&random, 0, 10);
            speed = exp(random_uniform(&random, log(5), log(80)));
            hold = random_below(&random, 4) == 0 ? 60 : 0;
        }
    }
}

static void make_input(uint64_t seed)
{
    make_input_falling(seed, HUGE_VAL);
}

/// The plant's plays between two samples, FINE steps; lag: dz/dt = (y - z) / tau by small Euler steps;
/// heating: the response shrinks by exp(-heating q), 2 s dq/dt = (dy/dt)^2 - q.
static void run_plant_heated(double lag, double gain_per_degree, double heating)
{
    random_t random = random_new(77);
    double w[PLAYS];
    double z = 0;
    double heat = 0;
    double before = 0;
    for (size_t j = 0; j < PLAYS; j++) {
        w[j] = model.radius[j]; // a descent to 0
    }
    for (size_t t = 0; t < SAMPLES; t++) {
        double y = 0;
        for (int k = 1; k <= FINE; k++) {
            const double part = (double)k / FINE;
            const double v = t > 0 ? input[t - 1] + part * (input[t] - input[t - 1]) : input[0];
            y = 1 + 0.5 * v;
            for (size_t j = 0; j < PLAYS; j++) {
                w[j] = fmin(fmax(w[j], v - model.radius[j]), v + model.radius[j]);
                y += model.weight[j] * w[j];
            }
            const double rate = t > 0 ? (y - before) / (0.01 / FINE) : 0;
            before = y;
            heat += 0.01 / FINE / 2 * (rate * rate - heat);
            y *= exp(-heating * heat);
            z = t == 0 ? y : z + (lag > 0 ? 0.01 / FINE / lag * (y - z) : y - z);
        }
        output[t] = z * (1 + gain_per_degree * (column_value[t] - 20)) + noise * random_normal(&random);
    }
}

static void run_plant(double lag, double gain_per_degree)
{
    run_plant_heated(lag, gain_per_degree, 0);
}

static void run_diagnosis_beside(column_t* columns, size_t num_columns, size_t num_threads)
{
    const record_t record = {.path = "made.csv",
                             .num_samples = SAMPLES,
                             .time = time_of,
                             .input = input,
                             .output = output,
                             .num_auxiliary = num_columns,
                             .auxiliary = columns};
    const diagnose_options_t options = {
        .calibration_rmse = noise, .calibration_noise = noise, .num_threads = num_threads};
    TEST_ASSERT_EQUAL(OUTCOME_OK, diagnose(&model, &record, &options, &diagnosis));
}

static void run_diagnosis_on(size_t num_threads)
{
    column_t column = {"temperature", column_value};
    run_diagnosis_beside(&column, 1, num_threads);
}

static void run_diagnosis(void)
{
    run_diagnosis_on(0);
}

static const effect_use_t* only_effect(void)
{
    TEST_ASSERT_FALSE(diagnosis.is_unknown);
    TEST_ASSERT_EQUAL(1, diagnosis.cause[0].hypothesis->num_uses);
    return &diagnosis.cause[0].hypothesis->use[0];
}

static void test_noise_alone_is_no_cause(void)
{
    make_input(1);
    run_plant(0, 0);
    run_diagnosis();
    TEST_ASSERT_TRUE(diagnosis.is_none);
    // Second differences of 3000 samples give the noise to some 3 %; the fine grid's plays are exact.
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * noise, noise, diagnosis.rmse);
}

static void test_output_lag_is_named_and_sized(void)
{
    make_input(2);
    run_plant(0.05, 0);
    run_diagnosis();
    const effect_use_t* use = only_effect();
    TEST_ASSERT_EQUAL_STRING("output_lag", use->effect->name);
    // Euler's steps of 0.5 ms shift the time constant by half a step, 0.5 %; noise adds less.
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * 0.05, 0.05, use->parameter[0]);
    TEST_ASSERT_TRUE(diagnosis.confident);
    TEST_ASSERT_TRUE(diagnosis.cause[0].shrink_low <= diagnosis.cause[0].shrink);
    TEST_ASSERT_TRUE(diagnosis.cause[0].shrink <= diagnosis.cause[0].shrink_high);
    // What is left is the noise.
    TEST_ASSERT_TRUE(diagnosis.cause[0].rmse_after < 1.2 * noise);
}

static void test_column_is_named(void)
{
    make_input(3);
    run_plant(0, 0.02);
    run_diagnosis();
    const effect_use_t* use = only_effect();
    TEST_ASSERT_EQUAL_STRING("exogenous", use->effect->name);
    TEST_ASSERT_EQUAL_STRING("temperature", use->column);
}

/// A logger's thirty others go their own ways; the last one counts as much as the first.
static void test_column_is_named_among_many(void)
{
    enum { OTHERS = 30 };
    static double other[OTHERS][SAMPLES];
    static char name[OTHERS][8];
    column_t columns[OTHERS + 1];
    for (size_t k = 0; k < OTHERS; k++) {
        for (size_t t = 0; t < SAMPLES; t++) {
            other[k][t] = sin((1e-3 + 2e-4 * (double)k) * (double)t + (double)k);
        }
        snprintf(name[k], sizeof name[k], "load%zu", k);
        columns[k] = (column_t){name[k], other[k]};
    }
    columns[OTHERS] = (column_t){"temperature", column_value};
    make_input(3);
    run_plant(0, 0.02);
    run_diagnosis_beside(columns, OTHERS + 1, 0);
    const effect_use_t* use = only_effect();
    TEST_ASSERT_EQUAL_STRING("exogenous", use->effect->name);
    TEST_ASSERT_EQUAL_STRING("temperature", use->column);
}

static void test_two_effects_are_both_named(void)
{
    make_input(4);
    run_plant(0.05, 0.02);
    run_diagnosis();
    TEST_ASSERT_FALSE(diagnosis.is_unknown);
    TEST_ASSERT_EQUAL(2, diagnosis.cause[0].hypothesis->num_uses);
    TEST_ASSERT_TRUE(diagnosis.cause[0].rmse_after < 1.3 * noise);
}

/// Pairs are searched here, too: the same bits on one thread and on three.
static void test_threads_change_nothing(void)
{
    make_input(4);
    run_plant(0.05, 0.02);
    run_diagnosis_on(1);
    diagnosis_t alone = diagnosis;
    diagnosis = (diagnosis_t){0};
    run_diagnosis_on(3);
    TEST_ASSERT_EQUAL(alone.num_causes, diagnosis.num_causes);
    for (size_t k = 0; k < alone.num_causes; k++) {
        const cause_t* a = &alone.cause[k];
        const cause_t* b = &diagnosis.cause[k];
        TEST_ASSERT_TRUE(hypothesis_same_names(a->hypothesis, b->hypothesis));
        TEST_ASSERT_EQUAL_MEMORY(&a->probability, &b->probability, sizeof a->probability);
        TEST_ASSERT_EQUAL_MEMORY(a->hypothesis->block_error, b->hypothesis->block_error,
                                 sizeof a->hypothesis->block_error);
        TEST_ASSERT_EQUAL_MEMORY(a->hypothesis->use[0].parameter, b->hypothesis->use[0].parameter,
                                 sizeof a->hypothesis->use[0].parameter);
    }
    diagnosis_free(&alone);
}

/// The step stands in the values: exact but for rounding; the gap is still that of the model without a
/// converter.
static void test_coarse_steps_are_named_beside_a_lag(void)
{
    make_input(4);
    run_plant(0.2, 0);
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] = 0.1 * round(output[t] / 0.1);
    }
    run_diagnosis();
    TEST_ASSERT_FALSE(diagnosis.is_unknown);
    const hypothesis_t* verdict = diagnosis.cause[0].hypothesis;
    TEST_ASSERT_EQUAL(2, verdict->num_uses);
    TEST_ASSERT_EQUAL_PTR(&effect_output_lag, verdict->use[0].effect);
    TEST_ASSERT_EQUAL_PTR(&effect_quantization, verdict->use[1].effect);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.1, verdict->use[1].parameter[0]);
    double sum = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        sum += (output[t] - diagnosis.before[t]) * (output[t] - diagnosis.before[t]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, diagnosis.rmse, sqrt(sum / SAMPLES));
}

/// Knocks on the sensor belong to no entry of the catalogue.
static void test_stranger_is_unknown(void)
{
    make_input(5);
    run_plant(0, 0);
    for (size_t t = 1200; t < 1500; t++) {
        output[t] += 2 * sin(0.001 * (double)((t - 1200) * (t - 1200)));
    }
    run_diagnosis();
    TEST_ASSERT_TRUE(diagnosis.is_unknown);
    TEST_ASSERT_EQUAL(AXIS_TIME, diagnosis.region[0].axis);
    TEST_ASSERT_DOUBLE_WITHIN(0.5, 12, diagnosis.region[0].from);
    TEST_ASSERT_DOUBLE_WITHIN(0.5, 15, diagnosis.region[0].to);
    // What lies along time is looked at in loops that repeat, over the model's range.
    TEST_ASSERT_NOT_NULL(strstr(diagnosis.advice, "the same loop repeated"));
    TEST_ASSERT_EQUAL(4000, diagnosis.next.num_samples);
    for (size_t t = 0; t < diagnosis.next.num_samples; t++) {
        TEST_ASSERT_TRUE(diagnosis.next.input[t] >= model.input_min - 1e-12);
        TEST_ASSERT_TRUE(diagnosis.next.input[t] <= model.input_max + 1e-12);
    }
}

/// Heat that nobody measures is no effect of the catalogue, and no drift either: the verdict says what it
/// looks like and what to measure, and hands nothing out.
static void test_self_heating_is_unknown(void)
{
    make_input(8);
    run_plant_heated(0, 0, 2e-5);
    run_diagnosis();
    TEST_ASSERT_TRUE(diagnosis.is_unknown);
    TEST_ASSERT_TRUE(diagnosis.confident);
    TEST_ASSERT_EQUAL_PTR(&effect_self_heating_losses, diagnosis.cause[0].hypothesis->use[0].effect);
    TEST_ASSERT_NOT_NULL(strstr(diagnosis.advice, "record the temperature"));
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    TEST_ASSERT_EQUAL(0, diagnosis_handed_out(&diagnosis, uses));
}

/// A search may end with creep's two time constants in either order; a model file takes only one.
static void test_fitted_parameters_are_in_their_order(void)
{
    make_input(7);
    run_plant(0, 0);
    const record_t record = {
        .path = "made.csv", .num_samples = SAMPLES, .time = time_of, .input = input, .output = output};
    effect_run_t run = effect_run_new(&model, &record, true);
    const nuisance_t nothing = {0};
    gap_t gap = gap_new(&model, &run, START_NEGATIVE_SATURATION, output, NULL, &nothing, 1);
    const effect_use_t swapped = {.effect = &effect_creep_additional, .parameter = {0.1, 2, 0.1}};
    hypothesis_t creep = hypothesis_of(&swapped, 1);
    hypothesis_fit(&creep, &gap, -1, 2);
    TEST_ASSERT_TRUE(creep.use[0].parameter[1] <= creep.use[0].parameter[2]);
    TEST_ASSERT_NULL(creep.use[0].effect->fault(creep.use[0].parameter));
    gap_free(&gap);
    effect_run_free(&run);
}

/// The asymmetry found for a drive that rises at most by 30 a second and falls by at most 70, from a start
/// near it.
static double fit_asymmetry(void)
{
    const effect_use_t limited = {.effect = &effect_slew_limit, .parameter = {50, -0.4}};
    const record_t record = {
        .path = "made.csv", .num_samples = SAMPLES, .time = time_of, .input = input, .output = output};
    effect_run_t run = effect_run_new(&model, &record, true);
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &limited, 1, output);
    random_t random = random_new(78);
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] += noise * random_normal(&random);
    }
    const nuisance_t nothing = {0};
    gap_t gap = gap_new(&model, &run, START_NEGATIVE_SATURATION, output, NULL, &nothing, noise * noise);
    const effect_use_t start = {.effect = &effect_slew_limit, .parameter = {45, -0.3}};
    hypothesis_t hypothesis = hypothesis_of(&start, 1);
    hypothesis_fit(&hypothesis, &gap, -1, 200);
    gap_free(&gap);
    effect_run_free(&run);
    return hypothesis.use[0].parameter[1];
}

/// Where no fall is fast the record says nothing of the falling rate: then it is near the rising one, as
/// plants have it; where falls are fast their rate is found.
static void test_rate_that_no_fall_shows_is_near_the_rising_one(void)
{
    make_input_falling(9, 5);
    // From beyond what plants scatter by to within it: nothing else pulls.
    TEST_ASSERT_DOUBLE_WITHIN(0.2, 0, fit_asymmetry());
    make_input(9);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -0.4, fit_asymmetry());
}

static void test_records_without_excitation_are_refused(void)
{
    make_input(6);
    run_plant(0, 0);
    record_t record = {
        .path = "made.csv", .num_samples = 100, .time = time_of, .input = input, .output = output};
    const diagnose_options_t options = {0};
    TEST_ASSERT_EQUAL(OUTCOME_BAD_INPUT, diagnose(&model, &record, &options, &diagnosis));
    record.num_samples = SAMPLES;
    for (size_t t = 0; t < SAMPLES; t++) {
        input[t] = 5;
    }
    TEST_ASSERT_EQUAL(OUTCOME_BAD_INPUT, diagnose(&model, &record, &options, &diagnosis));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_noise_alone_is_no_cause);
    RUN_TEST(test_output_lag_is_named_and_sized);
    RUN_TEST(test_column_is_named);
    RUN_TEST(test_column_is_named_among_many);
    RUN_TEST(test_two_effects_are_both_named);
    RUN_TEST(test_threads_change_nothing);
    RUN_TEST(test_coarse_steps_are_named_beside_a_lag);
    RUN_TEST(test_stranger_is_unknown);
    RUN_TEST(test_self_heating_is_unknown);
    RUN_TEST(test_fitted_parameters_are_in_their_order);
    RUN_TEST(test_rate_that_no_fall_shows_is_near_the_rising_one);
    RUN_TEST(test_records_without_excitation_are_refused);
    return UNITY_END();
}
