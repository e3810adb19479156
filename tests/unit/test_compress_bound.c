#include "compress.h"
#include "output_range.h"
#include "random_model.h"
#include "reference.h"
#include "unity.h"
#include "worst_input.h"
#include <float.h>
#include <stdlib.h>

enum { NUM_COSTS = COST_VARIANCE + 1 };

void setUp(void)
{
}

void tearDown(void)
{
}

static double total_weight(const model_t* model)
{
    double sum = 0.0;
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j];
    }
    return sum;
}

/// Identity envelopes; with `gap` the descending one lies higher, so that r = 0 is no free place.
static model_t small_model(random_t* random, bool gap)
{
    model_t model = model_new("small");
    model.input_min = -1.0;
    if (gap) {
        curve_add(&model.descending, 0.1);
    }
    model_set_num_plays(&model, 1 + random_below(random, 12));
    double radius = random_below(random, 3) == 0 ? 0.0 : random_uniform(random, 0.0, 0.2);
    for (size_t j = 0; j < model.num_plays; ++j) {
        radius += random_below(random, 4) == 0 ? 0.0 : random_uniform(random, 0.0, 0.2);
        model.radius[j] = radius;
        model.weight[j] = (double)random_below(random, 4);
        model.weight[j] *= random_below(random, 2) == 0 ? 1.0 : random_uniform(random, 0.0, 1.0);
    }
    return model;
}

/// W1 to the best weights at the radii of the plays in `chosen`, a set of bits.
static double least_distance(const model_t* model, unsigned chosen, bool zero_is_free)
{
    const double limit = model_largest_moving_radius(model);
    double sum = 0.0;
    for (size_t j = 0; j < model->num_plays && model->radius[j] < limit; ++j) {
        const double r = model->radius[j];
        double nearest = zero_is_free ? fmin(r, limit - r) : limit - r;
        for (size_t k = 0; k < model->num_plays; ++k) {
            nearest = (chosen >> k & 1U) != 0 ? fmin(nearest, fabs(r - model->radius[k])) : nearest;
        }
        sum += model->weight[j] * nearest;
    }
    return sum;
}

/// least[m]: the least W1 of all sets of m radii out of the plays' own, among which a k-median has its best.
static void least_of_all_sets(const model_t* model, bool zero_is_free, double* least)
{
    for (size_t m = 0; m <= model->num_plays; ++m) {
        least[m] = (double)INFINITY;
    }
    for (unsigned chosen = 1; chosen < 1U << model->num_plays; ++chosen) {
        size_t count = 0;
        for (size_t k = 0; k < model->num_plays; ++k) {
            count += chosen >> k & 1U;
        }
        least[count] = fmin(least[count], least_distance(model, chosen, zero_is_free));
    }
}

static void wasserstein_bound_is_the_least(void)
{
    random_t random = random_new(21);
    for (int trial = 0; trial < 1000; ++trial) {
        const bool gap = trial % 2 == 1;
        model_t model = small_model(&random, gap);
        double least[13];
        least_of_all_sets(&model, !gap, least);
        // The total weight of a group is rounded: 12 plays, limit 1.
        const double rounding = 12.0 * DBL_EPSILON * total_weight(&model);
        for (size_t m = 1; m <= model.num_plays; ++m) {
            const compress_options_t options = {.num_plays = m, .cost = COST_WASSERSTEIN};
            compression_t compression;
            model_t small = compress_model(&model, &options, &compression);
            TEST_ASSERT_NULL(model_check(&small).key);
            TEST_ASSERT_TRUE(small.num_plays <= m);
            TEST_ASSERT_DOUBLE_WITHIN(rounding, least[m], compression.error_bound);
            TEST_ASSERT_DOUBLE_WITHIN(rounding, compression.partition.cost, compression.error_bound);
            compression_free(&compression);
            model_free(&small);
        }
        model_free(&model);
    }
}

static compress_options_t random_options(random_t* random, const model_t* model)
{
    return (compress_options_t){.num_plays = 1 + random_below(random, (model->num_plays + 1) / 2),
                                .cost = (partition_cost_t)random_below(random, NUM_COSTS),
                                .unscaled = random_below(random, 2) == 0};
}

/// Ratios below 1 can only come from rounding, which outputs of some 1e-14 of the range do not show.
static void assert_attained(random_t* random, const model_t* model)
{
    const compress_options_t options = random_options(random, model);
    compression_t compression;
    model_t small = compress_model(model, &options, &compression);
    const replacement_t replacement = {.plays = {small.radius, small.weight, small.num_plays},
                                       .envelope_weight = compression.envelope_weight,
                                       .constant = compression.constant};
    size_t num_samples;
    double* input = worst_input(model, &replacement, &num_samples);
    for (size_t i = 0; i < num_samples; ++i) {
        TEST_ASSERT_TRUE(input[i] >= model->input_min && input[i] <= model->input_max);
    }
    const double attained = largest_difference(model, &small, input, num_samples);
    const double rounding = output_rounding(model) + output_rounding(&small);
    TEST_ASSERT_TRUE(attained <= compression.error_bound + rounding);
    TEST_ASSERT_TRUE(attained >= 0.99 * compression.error_bound - rounding);
    free(input);
    compression_free(&compression);
    model_free(&small);
}

static void worst_input_attains_the_bound(void)
{
    random_t random = random_new(22);
    for (int trial = 0; trial < 1000; ++trial) {
        model_t model = trial % 2 == 0 ? random_classical_model(&random) : random_model(&random);
        assert_attained(&random, &model);
        model_free(&model);
    }
}

static void no_start_and_no_input_exceeds_the_bound(void)
{
    enum { NUM_SAMPLES = 100 };
    static const start_t starts[] = {START_NEGATIVE_SATURATION, START_POSITIVE_SATURATION,
                                     START_DEMAGNETISED};
    random_t random = random_new(23);
    for (int trial = 0; trial < 300; ++trial) {
        model_t model = trial % 2 == 0 ? random_classical_model(&random) : random_model(&random);
        const compress_options_t options = random_options(&random, &model);
        compression_t compression;
        model_t small = compress_model(&model, &options, &compression);
        const double rounding = output_rounding(&model) + output_rounding(&small);
        double input[NUM_SAMPLES];
        double output[2][NUM_SAMPLES];
        random_input(&random, &model, input, NUM_SAMPLES);
        // A play wider than the range stays where its start put it: there the starts differ.
        const bool wide = model.radius[model.num_plays - 1] > model_largest_moving_radius(&model);
        for (size_t s = 0; s < (wide ? 1 : 3); ++s) {
            reference_run(&model, starts[s], input, NUM_SAMPLES, output[0]);
            reference_run(&small, starts[s], input, NUM_SAMPLES, output[1]);
            for (size_t i = 0; i < NUM_SAMPLES; ++i) {
                TEST_ASSERT_TRUE(fabs(output[0][i] - output[1][i]) <= compression.error_bound + rounding);
            }
        }
        compression_free(&compression);
        model_free(&small);
        model_free(&model);
    }
}

static double bound_with(const model_t* model, compress_options_t options, size_t num_plays)
{
    options.num_plays = num_plays;
    compression_t compression;
    model_t small = compress_model(model, &options, &compression);
    const double bound = compression.error_bound;
    compression_free(&compression);
    model_free(&small);
    return bound;
}

static void tolerance_gets_the_fewest_plays_of_every_cost(void)
{
    random_t random = random_new(24);
    for (int trial = 0; trial < 100; ++trial) {
        model_t model = random_classical_model(&random);
        const double range = model_output_max(&model) - model_output_min(&model);
        const double tolerance = range * exp(random_uniform(&random, log(1e-3), log(0.2)));
        const compress_options_t options = {.cost = (partition_cost_t)(trial % NUM_COSTS)};
        compression_t compression;
        model_t small = compress_to_tolerance(&model, &options, tolerance, &compression);
        TEST_ASSERT_TRUE(compression.error_bound <= tolerance);
        for (size_t fewer = 1; fewer < compression.partition.num_groups; ++fewer) {
            TEST_ASSERT_TRUE(bound_with(&model, options, fewer) > tolerance);
        }
        compression_free(&compression);
        model_free(&small);
        model_free(&model);
    }
}

static model_t plays_model(const double* radius, const double* weight, size_t num_plays)
{
    model_t model = model_new("plays");
    model.input_min = -1.0;
    model_set_num_plays(&model, num_plays);
    for (size_t j = 0; j < num_plays; ++j) {
        model.radius[j] = radius[j];
        model.weight[j] = weight[j];
    }
    return model;
}

static void assert_exact(const double* radius, const double* weight, size_t num_plays, size_t wanted)
{
    model_t model = plays_model(radius, weight, num_plays);
    for (partition_cost_t cost = COST_ENTROPY_SUM; cost <= COST_VARIANCE; ++cost) {
        const compress_options_t options = {.num_plays = wanted, .cost = cost};
        compression_t compression;
        model_t small = compress_model(&model, &options, &compression);
        TEST_ASSERT_NULL(model_check(&small).key);
        TEST_ASSERT_TRUE(compression.error_bound == 0.0);
        TEST_ASSERT_TRUE(model_output_max(&model) == model_output_max(&small));
        compression_free(&compression);
        model_free(&small);
    }
    model_free(&model);
}

/// Numbers with few digits, so that nothing is rounded.
static void what_merges_without_error_has_bound_0(void)
{
    const double equal[] = {0.5, 0.5, 0.5, 0.5};
    const double radius[] = {0.125, 0.25, 0.5, 0.75};
    const double weight[] = {1.0, 0.0, 2.0, 0.5};
    const double none[] = {0.0, 0.0, 0.0, 0.0};
    for (size_t wanted = 1; wanted <= 6; ++wanted) {
        assert_exact(equal, weight, 4, wanted);
        assert_exact(radius, none, 4, wanted);
        assert_exact(radius + 2, weight + 2, 1, wanted);
    }
    assert_exact(radius, weight, 4, 4);
    assert_exact(radius, weight, 4, 1000);
}

/// r = 0 is the envelope itself, r = 0.9375 nearly a constant: the one play is left for r = 0.5.
static void free_places_take_what_is_near_them(void)
{
    model_t model = plays_model((const double[]){0.0, 0.5, 0.9375}, (const double[]){1.0, 8.0, 1.0}, 3);
    const compress_options_t options = {.num_plays = 1, .cost = COST_WASSERSTEIN};
    compression_t compression;
    model_t small = compress_model(&model, &options, &compression);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, small.radius[0]);
    TEST_ASSERT_EQUAL_DOUBLE(8.0, small.weight[0]);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, compression.envelope_weight);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, curve_slope(&small.nonhysteretic, 0.0));
    // The last play moves by 2 (1 - 0.9375) from end to end; the constant is in the middle.
    TEST_ASSERT_EQUAL_DOUBLE(0.0625, compression.error_bound);
    TEST_ASSERT_EQUAL_DOUBLE(-0.0625, compression.constant);
    compression_free(&compression);
    model_free(&small);
    model_free(&model);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(wasserstein_bound_is_the_least);
    RUN_TEST(worst_input_attains_the_bound);
    RUN_TEST(no_start_and_no_input_exceeds_the_bound);
    RUN_TEST(tolerance_gets_the_fewest_plays_of_every_cost);
    RUN_TEST(what_merges_without_error_has_bound_0);
    RUN_TEST(free_places_take_what_is_near_them);
    return UNITY_END();
}
