#include "compress.h"
#include "output_range.h"
#include "random.h"
#include "reference.h"
#include "unity.h"
#include <float.h>
#include <stdlib.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static model_t vo2_model(random_t* random, size_t num_plays)
{
    model_t model = model_new("vo2");
    model.input_min = 30.0;
    model.input_max = 90.0;
    model.ascending = curve_tanh(0.16, -10.26);
    model.descending = curve_tanh(0.201, -11.58);
    model.nonhysteretic = curve_tanh(0.03, -1.61);
    curve_add(&model.nonhysteretic, -3.26);
    model_set_num_plays(&model, num_plays);
    for (size_t j = 0; j < num_plays; ++j) {
        // Table 6's radii; from 0.2 on the tanh envelopes stay in order.
        model.radius[j] = 0.2 + 0.8 * (double)(j + 1) / (double)num_plays;
        model.weight[j] = random_below(random, 5) == 0 ? 0.0 : exp(random_uniform(random, -6.0, 1.0));
    }
    return model;
}

static compress_options_t to_plays(size_t num_plays)
{
    return (compress_options_t){.num_plays = num_plays, .cost = COST_ENTROPY_SUM};
}

static double total_weight(const model_t* model)
{
    double sum = 0.0;
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j];
    }
    return sum;
}

/// Rounding of a sum of num_plays products in double, in the model's own order: (num_plays + 4) u for each of
/// the two models, times the sum of the terms' magnitudes.
static double rounding(const model_t* model)
{
    const double terms = 5.0 + total_weight(model) * 3.0;
    return 2.0 * ((double)model->num_plays + 4.0) * DBL_EPSILON * terms;
}

static void saturation_and_weight_are_kept(void)
{
    random_t random = random_new(1);
    for (size_t num_plays = 1; num_plays <= 40; ++num_plays) {
        model_t model = vo2_model(&random, num_plays);
        for (int unscaled = 0; unscaled < 2; ++unscaled) {
            compress_options_t options = to_plays(1 + random_below(&random, num_plays));
            options.unscaled = unscaled != 0;
            compression_t compression;
            model_t small = compress_model(&model, &options, &compression);
            TEST_ASSERT_NULL(model_check(&small).key);
            TEST_ASSERT_DOUBLE_WITHIN(rounding(&model), model_output_min(&model), model_output_min(&small));
            // r_N = 1 exceeds half the envelopes' range, which tanh keeps below 1.
            TEST_ASSERT_EQUAL_UINT64(1, compression.num_fixed);
            const double moving = total_weight(&model) - model.weight[num_plays - 1];
            TEST_ASSERT_DOUBLE_WITHIN(rounding(&model), moving, total_weight(&small));
            compression_free(&compression);
            model_free(&small);
        }
        model_free(&model);
    }
}

static double random_input(random_t* random, const model_t* model, double last)
{
    const double span = model->input_max - model->input_min;
    const double step = random_below(random, 3) == 0 ? span : 0.1 * span;
    return fmin(fmax(last + random_uniform(random, -step, step), model->input_min), model->input_max);
}

static double largest_difference(random_t* random, const model_t* model, const model_t* small)
{
    reference_t whole = reference_new(model, START_NEGATIVE_SATURATION, model->input_min);
    reference_t compressed = reference_new(small, START_NEGATIVE_SATURATION, model->input_min);
    double largest = 0.0;
    double input = model->input_min;
    for (int i = 0; i < 400; ++i) {
        input = random_input(random, model, input);
        largest = fmax(largest, fabs(reference_step(&whole, input) - reference_step(&compressed, input)));
    }
    reference_free(&whole);
    reference_free(&compressed);
    return largest;
}

static void error_bound_is_never_exceeded(void)
{
    random_t random = random_new(2);
    for (int trial = 0; trial < 300; ++trial) {
        model_t model = vo2_model(&random, 1 + random_below(&random, 30));
        compress_options_t options = to_plays(1 + random_below(&random, 8));
        options.cost = (partition_cost_t)random_below(&random, 3);
        options.unscaled = random_below(&random, 2) == 0;
        compression_t compression;
        model_t small = compress_model(&model, &options, &compression);
        const double largest = largest_difference(&random, &model, &small);
        TEST_ASSERT_TRUE(largest <= compression.error_bound + rounding(&model));
        compression_free(&compression);
        model_free(&small);
        model_free(&model);
    }
}

static model_t classical_model(const double* radius, const double* weight, size_t num_plays)
{
    model_t model = model_new("classical");
    model.input_min = -1.0;
    model_set_num_plays(&model, num_plays);
    for (size_t j = 0; j < num_plays; ++j) {
        model.radius[j] = radius[j];
        model.weight[j] = weight[j];
    }
    return model;
}

/// Plays 0, 0.25, 0.5 of weight 1 become one at 0.25 of weight 3: G = 1 on [0, 0.25) and -1 on [0.25, 0.5),
/// so the bound is 2 * 0.25.
static void error_bound_is_attained(void)
{
    model_t model = classical_model((const double[]){0.0, 0.25, 0.5}, (const double[]){1.0, 1.0, 1.0}, 3);
    compress_options_t options = to_plays(1);
    options.unscaled = true;
    compression_t compression;
    model_t small = compress_model(&model, &options, &compression);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, small.radius[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, compression.error_bound);
    const double input[] = {-1.0, 0.25, -0.25};
    double y[3];
    double y_small[3];
    reference_run(&model, START_NEGATIVE_SATURATION, input, 3, y);
    reference_run(&small, START_NEGATIVE_SATURATION, input, 3, y_small);
    // From -1 to 0.25 and back to -0.25: states -0.25, 0, -0.25 against 3 * 0.
    TEST_ASSERT_EQUAL_DOUBLE(-0.5, y[2] - y_small[2]);
    compression_free(&compression);
    model_free(&small);
    model_free(&model);
}

static void enough_plays_change_nothing_that_moves(void)
{
    random_t random = random_new(3);
    model_t model = vo2_model(&random, 12);
    const compress_options_t options = to_plays(50);
    compression_t compression;
    model_t same = compress_model(&model, &options, &compression);
    TEST_ASSERT_EQUAL_UINT64(11, same.num_plays);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, compression.partition.cost);
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(model.weight, same.weight, 11);
    for (size_t j = 0; j < 11; ++j) {
        TEST_ASSERT_DOUBLE_WITHIN(DBL_EPSILON, model.radius[j], same.radius[j]);
    }
    TEST_ASSERT_TRUE(largest_difference(&random, &model, &same) <= rounding(&model));
    compression_free(&compression);
    model_free(&same);
    model_free(&model);
}

static void nothing_that_moves_leaves_one_play_without_weight(void)
{
    model_t model = classical_model((const double[]){1.0, 2.0}, (const double[]){3.0, 4.0}, 2);
    const compress_options_t options = to_plays(1);
    compression_t compression;
    model_t small = compress_model(&model, &options, &compression);
    TEST_ASSERT_EQUAL_UINT64(1, small.num_plays);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, small.weight[0]);
    TEST_ASSERT_EQUAL_UINT64(2, compression.num_fixed);
    TEST_ASSERT_EQUAL_UINT64(0, compression.partition.num_groups);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, compression.error_bound);
    TEST_ASSERT_EQUAL_DOUBLE(model_output_min(&model), model_output_min(&small));
    compression_free(&compression);
    model_free(&small);
    model_free(&model);
}

static void weightless_and_equal_plays_merge(void)
{
    model_t model =
        classical_model((const double[]){0.1, 0.1, 0.1, 0.4}, (const double[]){0.0, 0.0, 0.0, 0.0}, 4);
    const compress_options_t options = to_plays(2);
    compression_t compression;
    model_t small = compress_model(&model, &options, &compression);
    TEST_ASSERT_NULL(model_check(&small).key);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, total_weight(&small));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, compression.error_bound);
    compression_free(&compression);
    model_free(&small);
    model_free(&model);
}

static void initial_states_follow_the_radii(void)
{
    model_t model = classical_model((const double[]){0.0, 0.2, 0.4}, (const double[]){1.0, 1.0, 1.0}, 3);
    model.initial = xcalloc(3, sizeof(double));
    model.initial[0] = 0.1;
    model.initial[1] = 0.3;
    model.initial[2] = 0.1;
    TEST_ASSERT_NULL(model_check(&model).key);
    compress_options_t options = to_plays(2);
    options.unscaled = true;
    compression_t compression;
    model_t small = compress_model(&model, &options, &compression);
    TEST_ASSERT_NULL(model_check(&small).key);
    // Two equal plays merge halfway; either pair's states average to 0.2.
    TEST_ASSERT_EQUAL_UINT64(2, small.num_plays);
    const size_t merged = compression.partition.beta[1] == 1 ? 1 : 0;
    TEST_ASSERT_DOUBLE_WITHIN(2.0 * DBL_EPSILON, 0.2, small.initial[merged]);
    TEST_ASSERT_DOUBLE_WITHIN(2.0 * DBL_EPSILON, 0.1, small.initial[1 - merged]);
    compression_free(&compression);
    model_free(&small);
    model_free(&model);
}

static void tolerance_gets_the_fewest_plays(void)
{
    random_t random = random_new(4);
    model_t model = vo2_model(&random, 20);
    const double range = model_output_max(&model) - model_output_min(&model);
    const compress_options_t options = to_plays(1);
    for (int i = 0; i < 4; ++i) {
        const double tolerance = i == 3 ? 0.0 : range * (double[]){0.1, 0.03, 0.01}[i];
        compression_t compression;
        model_t small = compress_to_tolerance(&model, &options, tolerance, &compression);
        // The centroid of one play is that play to an ulp, which the bound of the identity may show.
        TEST_ASSERT_TRUE(compression.error_bound <= tolerance + rounding(&model));
        for (size_t fewer = 1; fewer < small.num_plays; ++fewer) {
            const compress_options_t less = to_plays(fewer);
            compression_t tried;
            model_t smaller = compress_model(&model, &less, &tried);
            TEST_ASSERT_TRUE(tried.error_bound > tolerance);
            compression_free(&tried);
            model_free(&smaller);
        }
        compression_free(&compression);
        model_free(&small);
    }
    model_free(&model);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(saturation_and_weight_are_kept);
    RUN_TEST(error_bound_is_never_exceeded);
    RUN_TEST(error_bound_is_attained);
    RUN_TEST(enough_plays_change_nothing_that_moves);
    RUN_TEST(nothing_that_moves_leaves_one_play_without_weight);
    RUN_TEST(weightless_and_equal_plays_merge);
    RUN_TEST(initial_states_follow_the_radii);
    RUN_TEST(tolerance_gets_the_fewest_plays);
    return UNITY_END();
}
