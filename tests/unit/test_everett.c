#include "everett.h"
#include "random.h"
#include <math.h>
#include <stdlib.h>
#include <unity.h>

enum { SAMPLES = 3000 };

static model_t model;
static double input[SAMPLES];
static double difference[SAMPLES];
static double value[EVERETT_FREE];
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

static double held_out(double (*body)(size_t t))
{
    for (size_t t = 0; t < SAMPLES; t++) {
        difference[t] = body(t);
    }
    return everett_fit(&model, input, difference, SAMPLES, 1, 10, value, precision);
}

static double line(size_t t)
{
    return 0.4 + 0.3 * (input[t] + 2) / 8;
}

/// A radius of two cells: E(alpha, beta) = max(0, alpha - beta - 2 r) bends along a line through nodes, so
/// that the grid holds it but in the cells on that line.
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
        mean += difference[t] / SAMPLES;
    }
    for (size_t t = 0; t < SAMPLES; t++) {
        sum += (difference[t] - mean) * (difference[t] - mean) / SAMPLES;
    }
    return sqrt(sum);
}

/// E = 0.3 (alpha - beta) is on the grid exactly; what the pull towards 0 leaves is less than a hundredth.
static void test_a_line_is_predicted(void)
{
    TEST_ASSERT_TRUE(held_out(line) < 0.01 * rms());
}

/// The bend of a cell h wide is off by at most h / 4 in the two triangles that it cuts; the loop's width is 4
/// h: a sixteenth of it, taken here against the output's RMS.
static void test_a_play_is_predicted(void)
{
    TEST_ASSERT_TRUE(held_out(one_play) < 0.25 / EVERETT_CELLS);
}

/// After a loop closed, the coefficients are those of a run that never made it: wiping-out.
static void test_closed_loops_are_forgotten(void)
{
    double with[EVERETT_FREE];
    double without[EVERETT_FREE];
    everett_past_t past = everett_start(&model);
    const double looped[] = {4, 1, 3, 2, 2.5, 5};
    for (size_t k = 0; k < sizeof looped / sizeof looped[0]; k++) {
        everett_step(&past, looped[k], with);
    }
    everett_past_t straight = everett_start(&model);
    everett_step(&straight, 5, without);
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(without, with, EVERETT_FREE);
    // And more nested reversals than are remembered neither overrun nor leave anything but numbers.
    for (size_t k = 0; k < 3 * EVERETT_MOST_EXTREMES; k++) {
        const double swing = 3.0 * pow(0.98, (double)k);
        everett_step(&past, k % 2 == 0 ? 2 - swing : 2 + swing, with);
    }
    for (size_t k = 0; k < EVERETT_FREE; k++) {
        TEST_ASSERT_TRUE(isfinite(with[k]));
    }
}

/// Run at once, with turns ahead of it, it is the sum of values and coefficients.
static void test_a_run_is_the_sum_of_its_steps(void)
{
    static const double turn[] = {3, -1, 2};
    everett_t everett = {.input_min = model.input_min, .input_max = model.input_max};
    random_t random = random_new(8);
    for (size_t k = 0; k < EVERETT_FREE; k++) {
        everett.value[k] = random_uniform(&random, -1, 1);
    }
    static double output[SAMPLES];
    everett_add(&everett, turn, 3, input, SAMPLES, output);
    everett_past_t past = everett_start(&model);
    double row[EVERETT_FREE];
    for (size_t k = 0; k < 3; k++) {
        everett_step(&past, turn[k], row);
    }
    for (size_t t = 0; t < SAMPLES; t++) {
        everett_step(&past, input[t], row);
        double sum = 0;
        for (size_t k = 0; k < EVERETT_FREE; k++) {
            sum += row[k] * everett.value[k];
        }
        // At most as many terms of at most 1 as extremes and cells' corners.
        TEST_ASSERT_DOUBLE_WITHIN(8 * EVERETT_MOST_EXTREMES * 1e-15, sum, output[t]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_line_is_predicted);
    RUN_TEST(test_a_play_is_predicted);
    RUN_TEST(test_closed_loops_are_forgotten);
    RUN_TEST(test_a_run_is_the_sum_of_its_steps);
    return UNITY_END();
}
