#include "diagnose_scope.h"
#include "random.h"
#include <math.h>
#include <unity.h>

enum { SAMPLES = 2000 };

static double time_of[SAMPLES];
static double input[SAMPLES];
static model_t model;
static const double pi = 3.14159265358979324;
static const record_t record = {.num_samples = SAMPLES, .time = time_of, .input = input};

/// 200 samples a second, give or take a third of a step.
void setUp(void)
{
    random_t random = random_new(3);
    model = model_new("scope");
    model.input_min = 0;
    model.input_max = 10;
    for (size_t t = 0; t < SAMPLES; t++) {
        time_of[t] = 100 + 0.005 * ((double)t + random_uniform(&random, 0, 0.3));
    }
}

void tearDown(void)
{
    model_free(&model);
}

static void calibration_started_unknown(json_int_t first_fitted)
{
    json_decref(model.identification);
    model.identification = json_pack("{s:I}", "first_fitted", first_fitted);
}

/// Rises from the middle, is at the top after 100 samples and at the bottom after 300.
static void make_triangle(size_t quarter)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        const double phase = (double)((t + quarter) % (4 * quarter)) / (double)quarter;
        input[t] = 5 + 3 * (phase < 2 ? phase - 1 : 3 - phase);
    }
}

static void test_a_start_is_left_out_where_the_calibrations_was(void)
{
    make_triangle(100);
    TEST_ASSERT_EQUAL(0, scope_of(&model, NULL, &record).first_judged);
    calibration_started_unknown(0);
    TEST_ASSERT_EQUAL(0, scope_of(&model, NULL, &record).first_judged);
    calibration_started_unknown(50);
    // Near the bottom is within a hundredth of the range, which is 2 of its 200 samples.
    TEST_ASSERT_UINT_WITHIN(2, 299, scope_of(&model, NULL, &record).first_judged);
}

static void test_most_of_a_record_is_never_left_out(void)
{
    calibration_started_unknown(50);
    make_triangle(190);
    TEST_ASSERT_UINT_WITHIN(4, 569, scope_of(&model, NULL, &record).first_judged);
    // Three quarters of 210 are beyond 30 % of the record: the lowest within it is where it ends.
    make_triangle(210);
    TEST_ASSERT_UINT_WITHIN(4, 597, scope_of(&model, NULL, &record).first_judged);
    for (size_t t = 0; t < SAMPLES; t++) {
        input[t] = t < 1000 ? 5 : 8;
    }
    TEST_ASSERT_EQUAL(1, scope_of(&model, NULL, &record).first_judged);
}

static void test_what_lies_beyond_the_range_is_counted(void)
{
    make_triangle(100);
    TEST_ASSERT_EQUAL_DOUBLE(0, scope_of(&model, NULL, &record).beyond);
    model.input_min = 4;
    model.input_max = 6;
    // 2 - 0.02 of the way's 3 on either side of the middle lie beyond, to a sample each way at each crossing.
    TEST_ASSERT_DOUBLE_WITHIN(4.0 / 400, 1.98 / 3, scope_of(&model, NULL, &record).beyond);
}

/// A bench record of loops of one size, and one of all sizes.
static void test_loops_that_were_never_made_are_counted(void)
{
    double bench_input[SAMPLES];
    const record_t bench = {.num_samples = SAMPLES, .time = time_of, .input = bench_input};
    for (size_t t = 0; t < SAMPLES; t++) {
        bench_input[t] = 5 - 5 * cos(2 * pi * (double)t / 400);
    }
    make_triangle(100); // between 2 and 8: neither reversal is within an eighth of the range of 0 or of 10
    TEST_ASSERT_EQUAL_DOUBLE(0, scope_of(&model, NULL, &record).unvisited);
    TEST_ASSERT_EQUAL_DOUBLE(1, scope_of(&model, &bench, &record).unvisited);
    TEST_ASSERT_EQUAL_DOUBLE(0, scope_of(&model, &bench, &bench).unvisited);
    for (size_t t = 0; t < SAMPLES; t++) {
        bench_input[t] = 5 - 5 * (1 - (double)t / SAMPLES) * cos(2 * pi * (double)t / 100);
    }
    scope_t scope = scope_of(&model, &bench, &record);
    // Twenty loops shrink by a fortieth of the range at each end. Only the record's first way is new, from
    // the middle to the top, 100 samples and some more until the way back is no noise.
    TEST_ASSERT_DOUBLE_WITHIN(12.0 / SAMPLES, 100.0 / SAMPLES, scope.unvisited);
    TEST_ASSERT_TRUE(scope_is_known(&scope));
}

static double frequency_found(void)
{
    effect_run_t run = effect_run_new(&model, &record, true);
    const double found = scope_input_frequency(&run);
    effect_run_free(&run);
    return found;
}

static void test_a_periodic_input_is_seen(void)
{
    // A square's first line has 8 / pi^2 of its variance.
    for (size_t t = 0; t < SAMPLES; t++) {
        const double elapsed = time_of[t] - 100;
        input[t] = 5 + (sin(2 * pi * 1.7345 * elapsed) > 0 ? 2 : -2) + 0.05 * elapsed;
    }
    // The next line is 34 widths of 1 / (10 s) away, where its skirt is below a hundredth of its height.
    TEST_ASSERT_DOUBLE_WITHIN(0.1 / 10, 1.7345, frequency_found());
}

static void test_a_fading_oscillation_is_periodic(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        const double elapsed = time_of[t] - 100;
        input[t] = 5 + 4 * exp(-0.1 * elapsed) * sin(2 * pi * 2.2 * elapsed);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.1 / 10, 2.2, frequency_found());
}

static void test_other_inputs_are_not(void)
{
    random_t random = random_new(9);
    double target = 5;
    for (size_t t = 0; t < SAMPLES; t++) {
        if (t % 60 == 0) {
            target = random_uniform(&random, 0, 10);
        }
        input[t] = target;
    }
    TEST_ASSERT_EQUAL_DOUBLE(0, frequency_found());
    // Three equal tones: a third of the variance each.
    for (size_t t = 0; t < SAMPLES; t++) {
        const double elapsed = time_of[t] - 100;
        input[t] =
            5 + sin(2 * pi * 1.3 * elapsed) + sin(2 * pi * 2.9 * elapsed) + sin(2 * pi * 4.7 * elapsed);
    }
    TEST_ASSERT_EQUAL_DOUBLE(0, frequency_found());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_start_is_left_out_where_the_calibrations_was);
    RUN_TEST(test_most_of_a_record_is_never_left_out);
    RUN_TEST(test_what_lies_beyond_the_range_is_counted);
    RUN_TEST(test_loops_that_were_never_made_are_counted);
    RUN_TEST(test_a_periodic_input_is_seen);
    RUN_TEST(test_a_fading_oscillation_is_periodic);
    RUN_TEST(test_other_inputs_are_not);
    return UNITY_END();
}
