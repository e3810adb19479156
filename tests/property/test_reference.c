#include "random_model.h"
#include "reference.h"
#include "unity.h"
#include <float.h>
#include <stdio.h>
#include <string.h>

enum { NUM_MODELS = 300, NUM_SAMPLES = 120 };

static random_t source;
static model_t model;
static double input[NUM_SAMPLES];
static char place[64];

void setUp(void)
{
    source = random_new(20150401);
}

void tearDown(void)
{
    model_free(&model);
}

static void next_case(int index, model_t (*make)(random_t*))
{
    model_free(&model);
    model = make(&source);
    random_input(&source, &model, input, NUM_SAMPLES);
    (void)snprintf(place, sizeof place, "seed 20150401, model %d", index);
    const model_fault_t fault = model_check(&model);
    TEST_ASSERT_NULL_MESSAGE(fault.key, fault.text);
}

static void assert_within(double bound, double expected, double actual)
{
    TEST_ASSERT_TRUE_MESSAGE(isfinite(expected) && isfinite(actual), place);
    TEST_ASSERT_TRUE_MESSAGE(fabs(expected - actual) <= bound, place);
}

/// Samples between two others change nothing: the later envelope value is the one that counts.
static void test_rate_independence(void)
{
    for (int i = 0; i < NUM_MODELS; ++i) {
        next_case(i, random_model);
        reference_t coarse = reference_new(&model, START_NEGATIVE_SATURATION, input[0]);
        reference_t fine = reference_new(&model, START_NEGATIVE_SATURATION, input[0]);
        for (size_t k = 1; k < NUM_SAMPLES; ++k) {
            const size_t num_between = random_below(&source, 4);
            for (size_t m = 1; m <= num_between; ++m) {
                const double share = (double)m / (double)(num_between + 1);
                reference_step(&fine, input[k - 1] + share * (input[k] - input[k - 1]));
            }
            const double expected = reference_step(&coarse, input[k]);
            assert_within(output_rounding(&model), expected, reference_step(&fine, input[k]));
        }
        reference_free(&coarse);
        reference_free(&fine);
    }
}

/// Back at the largest input so far, whatever happened below it since is forgotten.
static void test_wiping_out(void)
{
    for (int i = 0; i < NUM_MODELS; ++i) {
        next_case(i, random_model);
        double highest = input[0];
        for (size_t k = 1; k < NUM_SAMPLES; ++k) {
            highest = fmax(highest, input[k]);
        }
        reference_t direct = reference_new(&model, START_NEGATIVE_SATURATION, highest);
        reference_t wandering = reference_new(&model, START_NEGATIVE_SATURATION, input[0]);
        for (size_t k = 1; k < NUM_SAMPLES; ++k) {
            reference_step(&wandering, input[k]);
        }
        reference_step(&wandering, highest);
        for (size_t j = 0; j < model.num_plays; ++j) {
            assert_within(state_rounding(&model), direct.memory[j], wandering.memory[j]);
        }
        reference_free(&direct);
        reference_free(&wandering);
    }
}

/// An input nowhere below another gives an output nowhere below its.
static void test_order_is_preserved(void)
{
    for (int i = 0; i < NUM_MODELS; ++i) {
        next_case(i, random_model);
        double higher[NUM_SAMPLES];
        random_input(&source, &model, higher, NUM_SAMPLES);
        for (size_t k = 0; k < NUM_SAMPLES; ++k) {
            higher[k] = fmax(higher[k], input[k]);
        }
        double low[NUM_SAMPLES];
        double high[NUM_SAMPLES];
        reference_run(&model, START_DEMAGNETISED, input, NUM_SAMPLES, low);
        reference_run(&model, START_DEMAGNETISED, higher, NUM_SAMPLES, high);
        for (size_t k = 0; k < NUM_SAMPLES; ++k) {
            TEST_ASSERT_TRUE_MESSAGE(low[k] <= high[k] + output_rounding(&model), place);
        }
    }
}

/// |w_r - w_s| <= |r - s| from every start, and every play stays inside its strip.
static void test_memory_is_lipschitz_and_in_its_strip(void)
{
    for (int i = 0; i < NUM_MODELS; ++i) {
        next_case(i, random_model);
        const double rounding = state_rounding(&model);
        // An order condition that the least radius meets only to the model's tolerance lets a strip be that
        // thin.
        const double slack = 2.0 * rounding + model_tolerance(&model);
        reference_t run = reference_new(&model, (start_t)(i % 3), input[0]);
        for (size_t k = 0; k < NUM_SAMPLES; ++k) {
            reference_step(&run, input[k]);
            const double ascending = curve_value(&model.ascending, input[k]);
            const double descending = curve_value(&model.descending, input[k]);
            for (size_t j = 0; j < model.num_plays; ++j) {
                TEST_ASSERT_TRUE_MESSAGE(run.memory[j] >= ascending - model.radius[j] - slack, place);
                TEST_ASSERT_TRUE_MESSAGE(run.memory[j] <= descending + model.radius[j] + slack, place);
                if (j > 0) {
                    const double apart = fabs(run.memory[j] - run.memory[j - 1]);
                    TEST_ASSERT_TRUE_MESSAGE(apart <= model.radius[j] - model.radius[j - 1] + 2.0 * rounding,
                                             place);
                }
            }
        }
        reference_free(&run);
    }
}

/// Each play is 1-Lipschitz in the sup norm of its input, D by its slope: the output by their weighted sum.
static void test_classical_output_is_lipschitz_in_the_input(void)
{
    for (int i = 0; i < NUM_MODELS; ++i) {
        next_case(i, random_classical_model);
        double other[NUM_SAMPLES];
        double largest = 0.0;
        const double radius = random_uniform(&source, 0.0, 0.5);
        for (size_t k = 0; k < NUM_SAMPLES; ++k) {
            other[k] = input[k] + random_uniform(&source, -radius, radius);
            other[k] = fmin(fmax(other[k], model.input_min), model.input_max);
            largest = fmax(largest, fabs(other[k] - input[k]));
        }
        double constant = model.nonhysteretic.slope;
        for (size_t j = 0; j < model.num_plays; ++j) {
            constant += model.weight[j];
        }
        double first[NUM_SAMPLES];
        double second[NUM_SAMPLES];
        reference_run(&model, START_POSITIVE_SATURATION, input, NUM_SAMPLES, first);
        reference_run(&model, START_POSITIVE_SATURATION, other, NUM_SAMPLES, second);
        for (size_t k = 0; k < NUM_SAMPLES; ++k) {
            assert_within(constant * largest + 2.0 * output_rounding(&model), first[k], second[k]);
        }
    }
}

/// The bisection ends between two neighbouring inputs: the outputs there differ by at most the output's
/// steepest slope times one unit in the input's last place.
static double round_trip_bound(void)
{
    const double envelope = fmax(curve_steepness(&model.ascending), curve_steepness(&model.descending));
    double slope = curve_steepness(&model.nonhysteretic);
    for (size_t j = 0; j < model.num_plays; ++j) {
        slope += model.weight[j] * envelope;
    }
    return slope * DBL_EPSILON * fmax(fabs(model.input_min), fabs(model.input_max)) +
           2.0 * output_rounding(&model);
}

static void test_inverse_round_trip(void)
{
    for (int i = 0; i < NUM_MODELS; ++i) {
        next_case(i, random_model);
        const double bound = round_trip_bound();
        reference_t run = reference_new(&model, (start_t)(i % 3), input[0]);
        for (size_t k = 0; k < NUM_SAMPLES; ++k) {
            const reference_inverse_t range = reference_inverse(&run, 0.0);
            const double share = random_uniform(&source, 0.0, 1.0);
            const double wanted = range.reachable_min + share * (range.reachable_max - range.reachable_min);
            const reference_inverse_t found = reference_inverse(&run, wanted);
            TEST_ASSERT_FALSE_MESSAGE(found.clamped, place);
            TEST_ASSERT_TRUE_MESSAGE(found.input >= model.input_min && found.input <= model.input_max, place);
            assert_within(bound, wanted, reference_step(&run, found.input));
        }
        reference_free(&run);
    }
}

/// What lies beyond the reachable outputs is clamped to the end that is nearest, and flagged.
static void test_inverse_clamps(void)
{
    for (int i = 0; i < NUM_MODELS; ++i) {
        next_case(i, random_model);
        reference_t run = reference_new(&model, START_DEMAGNETISED, input[0]);
        const reference_inverse_t high = reference_inverse(&run, 1e9);
        TEST_ASSERT_TRUE_MESSAGE(high.clamped, place);
        assert_within(round_trip_bound(), high.reachable_max, reference_step(&run, high.input));
        const reference_inverse_t low = reference_inverse(&run, -1e9);
        TEST_ASSERT_TRUE_MESSAGE(low.clamped, place);
        assert_within(round_trip_bound(), low.reachable_min, reference_step(&run, low.input));
        reference_free(&run);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rate_independence);
    RUN_TEST(test_wiping_out);
    RUN_TEST(test_order_is_preserved);
    RUN_TEST(test_memory_is_lipschitz_and_in_its_strip);
    RUN_TEST(test_classical_output_is_lipschitz_in_the_input);
    RUN_TEST(test_inverse_round_trip);
    RUN_TEST(test_inverse_clamps);
    return UNITY_END();
}
