#include "everett_fit.h"
#include "random.h"
#include "reference.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <unity.h>

enum { SAMPLES = 3000 };

static model_t model;
static double input[SAMPLES];
static double output[SAMPLES];
static double model_output[SAMPLES];
static double* precision;

void setUp(void)
{
    model = model_new("plant");
    model.input_min = -2;
    model.input_max = 6;
    precision = xcalloc((size_t)EVERETT_FREE * EVERETT_FREE, sizeof *precision);
    random_t random = random_new(5);
    double v = -2;
    double target = 6;
    for (size_t t = 0; t < SAMPLES; t++) {
        input[t] = v;
        v += fmin(fmax(target - v, -0.1), 0.1);
        if (fabs(target - v) <= 0) {
            target = random_uniform(&random, -2, 6);
        }
    }
}

void tearDown(void)
{
    free(precision);
    model_free(&model);
}

/// A play of this radius on the input as a part of the range, by its rule.
static double play(double v, double radius, double state)
{
    const double part = (v + 2) / 8;
    return fmin(fmax(state, part - radius), part + radius);
}

static const record_t record = {.num_samples = SAMPLES, .input = input, .output = output};

static double held_out(double (*body)(size_t t))
{
    double left;
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] = body(t);
    }
    (void)everett_fit(&model, &record, 10, precision, &left);
    return left;
}

static double line(size_t t)
{
    return 0.4 + 0.3 * (input[t] + 2) / 8;
}

/// E(alpha, beta) = max(0, alpha - beta - 2 r).
static double one_play(size_t t)
{
    static double state;
    state = play(input[t], 2.0 / EVERETT_CELLS, t == 0 ? 2.0 / EVERETT_CELLS : state);
    return state;
}

static double rms(void)
{
    double sum = 0;
    double mean = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        mean += output[t] / SAMPLES;
    }
    for (size_t t = 0; t < SAMPLES; t++) {
        sum += (output[t] - mean) * (output[t] - mean) / SAMPLES;
    }
    return sqrt(sum);
}

/// E = 0.3 (alpha - beta) is in the splines exactly; what the pull towards 0 leaves is less than a hundredth.
static void test_a_line_is_predicted(void)
{
    TEST_ASSERT_TRUE(held_out(line) < 0.01 * rms());
}

/// Schoenberg's spline of such a bend, whose coefficients are the function's values at their places, is off
/// by at most half of the places' mean distance, for the product of two cubic ones at most sqrt(2 / 3) cells.
static void test_a_play_is_predicted(void)
{
    TEST_ASSERT_TRUE(held_out(one_play) < 0.5 * sqrt(2.0 / 3) / EVERETT_CELLS);
}

/// What stands at samples that are carried is no matter; their inputs are.
static void test_what_is_carried_is_not_fitted(void)
{
    static bool carried[SAMPLES];
    record_t filled = record;
    filled.carried = carried;
    (void)held_out(line);
    const double size = rms();
    for (size_t t = 0; t < SAMPLES; t++) {
        carried[t] = t % 31 == 7;
        output[t] = carried[t] ? 0 : output[t];
    }
    double left;
    (void)everett_fit(&model, &filled, 10, precision, &left);
    // As in test_a_line_is_predicted.
    TEST_ASSERT_TRUE(left < 0.01 * size);
}

/// A stepped model, and a plant with half of its steps: they are in the share exactly, wherever the output's
/// zero is.
static void check_steps_are_taken_away(double offset)
{
    model.nonhysteretic = curve_linear(0.3, offset);
    model_set_num_plays(&model, 1);
    model.radius[0] = 1.3;
    model.weight[0] = 2;
    reference_run(&model, START_NEGATIVE_SATURATION, input, SAMPLES, model_output);
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] = 0.5 * model_output[t] + line(t);
    }
    double left;
    const everett_t everett = everett_fit(&model, &record, 10, precision, &left);
    TEST_ASSERT_TRUE(left < 0.01 * rms());
    const double share = everett.value[EVERETT_SHARE] / everett.range.output_span;
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -0.5, share);
    // Up and down the range: 0.3 (6 - -2) nonhysteretic, and of the play the width less both radii.
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 + 4 * DBL_EPSILON * offset, 0.3 * 8 + 2 * (8 - 2 * 1.3),
                              everett.range.output_span);
}

static void test_a_model_s_own_steps_are_taken_away(void)
{
    check_steps_are_taken_away(0);
    check_steps_are_taken_away(1e6);
}

/// After a loop closed, the coefficients are those of a run that never made it: wiping-out.
static void test_closed_loops_are_forgotten(void)
{
    double with[EVERETT_FREE];
    double without[EVERETT_FREE];
    everett_past_t past = everett_start(&model);
    const double looped[] = {4, 1, 3, 2, 2.5, 5};
    for (size_t k = 0; k < sizeof looped / sizeof looped[0]; k++) {
        everett_step(&past, looped[k], 3, with);
    }
    everett_past_t straight = everett_start(&model);
    everett_step(&straight, 5, 3, without);
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(without, with, EVERETT_FREE);
    // And more nested reversals than are remembered neither overrun nor leave anything but numbers.
    for (size_t k = 0; k < 3 * EVERETT_MOST_EXTREMES; k++) {
        const double swing = 3.0 * pow(0.98, (double)k);
        everett_step(&past, k % 2 == 0 ? 2 - swing : 2 + swing, 3, with);
    }
    for (size_t k = 0; k < EVERETT_FREE; k++) {
        TEST_ASSERT_TRUE(isfinite(with[k]));
    }
}

/// Run at once, with turns ahead of it, it is the sum of values and coefficients.
static void test_a_run_is_the_sum_of_its_steps(void)
{
    static const double turn[] = {3, -1, 2};
    everett_t everett = everett_none(&model);
    random_t random = random_new(8);
    for (size_t k = 0; k < EVERETT_FREE; k++) {
        everett.value[k] = random_uniform(&random, -1, 1);
    }
    for (size_t t = 0; t < SAMPLES; t++) {
        model_output[t] = random_uniform(&random, -1, 1);
        output[t] = 0;
    }
    everett_add(&everett, turn, 3, input, model_output, SAMPLES, output);
    everett_past_t past = everett_start(&model);
    double row[EVERETT_FREE];
    for (size_t k = 0; k < 3; k++) {
        everett_step(&past, turn[k], 0, row);
    }
    for (size_t t = 0; t < SAMPLES; t++) {
        everett_step(&past, input[t], model_output[t], row);
        double sum = 0;
        for (size_t k = 0; k < EVERETT_FREE; k++) {
            sum += row[k] * everett.value[k];
        }
        // Of each extreme 16 products of splines, which sum to 1, in two orders; then as many terms as
        // coefficients.
        TEST_ASSERT_DOUBLE_WITHIN((2 * 16 * EVERETT_MOST_EXTREMES + EVERETT_FREE) * DBL_EPSILON, sum,
                                  output[t]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_line_is_predicted);
    RUN_TEST(test_a_play_is_predicted);
    RUN_TEST(test_what_is_carried_is_not_fitted);
    RUN_TEST(test_a_model_s_own_steps_are_taken_away);
    RUN_TEST(test_closed_loops_are_forgotten);
    RUN_TEST(test_a_run_is_the_sum_of_its_steps);
    return UNITY_END();
}
