#include "fast_plays.h"
#include "random.h"
#include "random_model.h"
#include "reference.h"
#include <math.h>
#include <stdlib.h>
#include <unity.h>

enum { SAMPLES = 2000 };

void setUp(void)
{
}

void tearDown(void)
{
}

/// How far a curve leaves its chords of 1/4096 of the range: a smooth curve's chord is worst about its
/// middle; a table's kink inside a cell at the kink, which quarter points find to within a factor of 4.
static double chord_error(const curve_t* curve, double low, double step)
{
    double worst = 0;
    for (size_t i = 0; i < 8192; i++) {
        const double left = low + step * (double)i;
        const double a = curve_value(curve, left);
        const double b = curve_value(curve, left + step);
        for (int q = 1; q <= 3; q++) {
            worst = fmax(worst, fabs(curve_value(curve, left + 0.25 * q * step) - (a + 0.25 * q * (b - a))));
        }
    }
    return 4 * worst;
}

/// |difference| <= sum p times the larger envelope error, plus D's: the plays are 1-Lipschitz in the
/// envelopes.
static double bound_of(const model_t* model)
{
    const double span = model->input_max - model->input_min;
    const double low = model->input_min - 0.5 * span;
    const double step = 2 * span / 8192;
    double weight = 0;
    for (size_t j = 0; j < model->num_plays; j++) {
        weight += model->weight[j];
    }
    const double envelope =
        fmax(chord_error(&model->ascending, low, step), chord_error(&model->descending, low, step));
    return weight * envelope + chord_error(&model->nonhysteretic, low, step) + 1e-9 * (1 + weight);
}

static void test_equals_the_loop_over_all_plays(void)
{
    static double input[SAMPLES];
    static double sum[SAMPLES];
    static double expected[SAMPLES];
    for (uint64_t seed = 0; seed < 60; seed++) {
        random_t random = random_new(seed);
        model_t model = random_model(&random);
        const double span = model.input_max - model.input_min;
        double v = random_uniform(&random, model.input_min, model.input_max);
        for (size_t t = 0; t < SAMPLES; t++) {
            // Small moves, holds and jumps, at times beyond the range.
            const size_t kind = random_below(&random, 8);
            v = kind == 0
                    ? random_uniform(&random, model.input_min - 0.2 * span, model.input_max + 0.2 * span)
                : kind == 1 ? v
                            : v + 0.02 * span * random_uniform(&random, -1, 1);
            v = fmin(fmax(v, model.input_min - 0.4 * span), model.input_max + 0.4 * span);
            input[t] = v;
        }
        const start_t start = seed % 2 == 0 ? START_NEGATIVE_SATURATION : START_DEMAGNETISED;
        fast_plays_t* plays = fast_plays_new(&model, start);
        fast_plays_run(plays, input, SAMPLES, sum);
        reference_run(&model, start, input, SAMPLES, expected);
        const double bound = bound_of(&model);
        for (size_t t = 0; t < SAMPLES; t++) {
            const double got = sum[t] + fast_plays_nonhysteretic(plays, input[t]);
            TEST_ASSERT_TRUE(isfinite(got));
            TEST_ASSERT_TRUE_MESSAGE(fabs(got - expected[t]) <= bound, "further off than the tables");
        }
        fast_plays_free(plays);
        model_free(&model);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_equals_the_loop_over_all_plays);
    return UNITY_END();
}
