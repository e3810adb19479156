#include "classical_model.h"
#include "diagnose.h"
#include "effect_catalogue.h"
#include "random.h"
#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <unity.h>

enum { SAMPLES = 200000, PLAYS = 8 };

static double time_of[SAMPLES];
static double input[SAMPLES];
static double output[SAMPLES];
static model_t model;
static record_t record;
static effect_run_t run;
static diagnosis_t diagnosis;
static char path[] = "made.csv";
static const double noise = 0.01;

void setUp(void)
{
    model = classical_model_of_falling_weights(PLAYS);
    record =
        (record_t){.path = path, .num_samples = SAMPLES, .time = time_of, .input = input, .output = output};
    diagnosis = (diagnosis_t){0};
}

void tearDown(void)
{
    diagnosis_free(&diagnosis);
    effect_run_free(&run);
    model_free(&model);
}

/// Ramps between random levels, each of at least `shortest` samples of 0.01 s.
static void make_input(size_t shortest)
{
    random_t random = random_new(8);
    double from = 0;
    double to = 10;
    size_t begin = 0;
    size_t length = shortest;
    for (size_t t = 0; t < SAMPLES; t++) {
        if (t == begin + length) {
            begin = t;
            from = to;
            to = random_uniform(&random, 0, 10);
            length = shortest + (size_t)random_below(&random, 2 * (uint32_t)shortest);
        }
        time_of[t] = 0.01 * (double)t;
        input[t] = from + (to - from) * (double)(t - begin) / (double)length;
    }
    run = effect_run_new(&model, &record, true);
}

static void make_output(const effect_use_t* truth)
{
    random_t random = random_new(21);
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, truth, 1, output);
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] += noise * random_normal(&random);
    }
    const diagnose_options_t options = {.calibration_rmse = noise, .calibration_noise = noise};
    TEST_ASSERT_EQUAL(OUTCOME_OK, diagnose(&model, &record, &options, &diagnosis));
}

/// slope[SAMPLES] := the output's derivative by a parameter.
static void find_slope(const effect_use_t* truth, size_t parameter, double* slope)
{
    const effect_limits_t limits = effect_use_limits(&run, truth, parameter);
    const double change =
        1e-4 * (limits.logarithmic ? truth->parameter[parameter] : limits.high - limits.low);
    static double at[SAMPLES];
    effect_use_t beside = *truth;
    beside.parameter[parameter] += change;
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, truth, 1, at);
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &beside, 1, slope);
    for (size_t t = 0; t < SAMPLES; t++) {
        slope[t] = (slope[t] - at[t]) / change;
    }
}

/// Standard deviation of the least-squares estimate of the truth's first parameter from all samples, fitted
/// with its others: the noise times the root of the first of the inverse of the slopes' products.
static double parameter_scatter(const effect_use_t* truth)
{
    enum { MOST = 3 };
    static double slope[MOST][SAMPLES];
    const lapack_int n = (lapack_int)truth->effect->num_parameters;
    double product[MOST * MOST];
    TEST_ASSERT_TRUE(n <= MOST);
    for (lapack_int p = 0; p < n; p++) {
        find_slope(truth, (size_t)p, slope[p]);
        for (lapack_int q = 0; q <= p; q++) {
            product[p * n + q] = cblas_ddot(SAMPLES, slope[p], 1, slope[q], 1);
        }
    }
    TEST_ASSERT_EQUAL(0, LAPACKE_dpotrf(LAPACK_ROW_MAJOR, 'L', n, product, n));
    TEST_ASSERT_EQUAL(0, LAPACKE_dpotri(LAPACK_ROW_MAJOR, 'L', n, product, n));
    return noise * sqrt(product[0]);
}

static void check_verdict(const effect_use_t* truth)
{
    TEST_ASSERT_EQUAL(SAMPLES, diagnosis.num_samples);
    TEST_ASSERT_TRUE(diagnosis.num_judged < 12000);
    TEST_ASSERT_FALSE(diagnosis.is_unknown);
    TEST_ASSERT_TRUE(diagnosis.confident);
    const hypothesis_t* verdict = diagnosis.cause[0].hypothesis;
    TEST_ASSERT_EQUAL(1, verdict->num_uses);
    TEST_ASSERT_EQUAL_PTR(truth->effect, verdict->use[0].effect);
    // Four standard deviations, and what the plays' fine tables and the search's stop leave (1e-4 of it).
    TEST_ASSERT_DOUBLE_WITHIN(4 * parameter_scatter(truth) + 1e-4 * fabs(truth->parameter[0]),
                              truth->parameter[0], verdict->use[0].parameter[0]);
}

/// The turning points are 600 samples apart, the cells between two stretches at most (200000 - 12 * 666) / 11
/// / 92 = 190 long: the plays' memory is carried over exactly, and 166 samples of 0.01 s ahead of each
/// stretch leave exp(-8.3) of the lag's. So what the verdict leaves is the noise, whose estimate from 6166
/// samples scatters by 1 / sqrt(2 * 6166) = 0.9 %.
static void test_a_lag_is_judged_as_by_all_samples(void)
{
    const effect_use_t truth = {.effect = &effect_output_lag, .parameter = {0.2}};
    make_input(600);
    make_output(&truth);
    check_verdict(&truth);
    TEST_ASSERT_DOUBLE_WITHIN(4 * 0.009 * noise, noise, diagnosis.cause[0].rmse_after);
    // The shrink on all samples, which the stretches stand for: the truth leaves the noise alone.
    double sum = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        sum += pow(output[t] - diagnosis.before[t], 2);
    }
    const double realised = 1 - noise / sqrt(sum / SAMPLES);
    const double half_width = 0.5 * (diagnosis.cause[0].shrink_high - diagnosis.cause[0].shrink_low);
    // A 90 % interval is 1.64 standard deviations to either side: four of them.
    TEST_ASSERT_DOUBLE_WITHIN(4 / 1.64 * half_width, realised, diagnosis.cause[0].shrink);
}

/// Turning points 20 samples apart: the cells hide most of the travel that wear counts, so its rate comes out
/// right only by the fit to all samples.
static void test_wear_counts_the_whole_travel(void)
{
    make_input(20);
    const effect_use_t truth = {.effect = &effect_wear_amplitude,
                                .parameter = {0.4 * run.input_span / run.travel}};
    make_output(&truth);
    check_verdict(&truth);
}

/// The range is the whole record's: an output that moves at one sample only, in none of the stretches.
static void test_the_gap_is_relative_to_the_whole_output(void)
{
    make_input(600);
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] = t == 5000 ? 3.5 : 3;
    }
    const diagnose_options_t options = {.calibration_rmse = noise, .calibration_noise = noise};
    TEST_ASSERT_EQUAL(OUTCOME_OK, diagnose(&model, &record, &options, &diagnosis));
    TEST_ASSERT_TRUE(isfinite(diagnosis.relative));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * diagnosis.relative, diagnosis.rmse / 0.5, diagnosis.relative);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_lag_is_judged_as_by_all_samples);
    RUN_TEST(test_wear_counts_the_whole_travel);
    RUN_TEST(test_the_gap_is_relative_to_the_whole_output);
    return UNITY_END();
}
