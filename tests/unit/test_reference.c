#include "reference.h"
#include "unity.h"
#include <math.h>

static model_t model;
static reference_t run;

/// Identity envelopes on [-4, 4], radii 1 and 5 (which never moves), D = v.
void setUp(void)
{
    model = model_new("play");
    model.input_min = -4.0;
    model.input_max = 4.0;
    model.nonhysteretic = curve_linear(1.0, 0.0);
    model_set_num_plays(&model, 2);
    model.radius[0] = 1.0;
    model.radius[1] = 5.0;
    model.weight[0] = 2.0;
    model.weight[1] = 10.0;
}

void tearDown(void)
{
    reference_free(&run);
    model_free(&model);
}

static void assert_memory(double first, double second)
{
    TEST_ASSERT_EQUAL_DOUBLE(first, run.memory[0]);
    TEST_ASSERT_EQUAL_DOUBLE(second, run.memory[1]);
}

static void test_negative_saturation(void)
{
    run = reference_new(&model, START_NEGATIVE_SATURATION, -4.0);
    assert_memory(-3.0, 1.0);
    reference_free(&run);
    run = reference_new(&model, START_NEGATIVE_SATURATION, 2.0);
    assert_memory(1.0, 1.0);
    // 2 + 2 * 1 + 10 * 1
    TEST_ASSERT_EQUAL_DOUBLE(14.0, reference_output(&run));
}

static void test_positive_saturation(void)
{
    run = reference_new(&model, START_POSITIVE_SATURATION, 4.0);
    assert_memory(3.0, -1.0);
    reference_free(&run);
    run = reference_new(&model, START_POSITIVE_SATURATION, 0.0);
    assert_memory(1.0, -1.0);
}

static void test_demagnetised(void)
{
    run = reference_new(&model, START_DEMAGNETISED, 0.0);
    assert_memory(0.0, 0.0);
    reference_free(&run);
    run = reference_new(&model, START_DEMAGNETISED, -1.5);
    assert_memory(-0.5, 0.0);
}

/// The closed form against the alternation it stands for. Each half cycle is 0.1 % smaller than the one
/// before, so the last extreme that moved a play is within 0.1 % of the amplitude where it stops, 0.2 for
/// half a cycle either way.
static void test_demagnetised_is_the_limit_of_an_alternation(void)
{
    model.ascending = curve_tanh(0.5, -0.3);
    model.descending = curve_tanh(0.6, 0.4);
    model.radius[0] = 0.3;
    model.radius[1] = 0.6;
    TEST_ASSERT_NULL(model_check(&model).key);
    run = reference_new(&model, START_NEGATIVE_SATURATION, -4.0);
    for (double amplitude = 4.0; amplitude > 1e-3; amplitude *= 0.999) {
        reference_step(&run, amplitude);
        reference_step(&run, -amplitude * 0.9995);
    }
    reference_step(&run, 0.0);
    reference_t closed = reference_new(&model, START_DEMAGNETISED, 0.0);
    // Steepness 0.6 times 0.1 % of the largest amplitude 4.
    TEST_ASSERT_DOUBLE_WITHIN(0.0024, run.memory[0], closed.memory[0]);
    TEST_ASSERT_DOUBLE_WITHIN(0.0024, run.memory[1], closed.memory[1]);
    reference_free(&closed);
}

static void test_own_initial_states(void)
{
    run = reference_new(&model, START_MODEL, 2.0);
    assert_memory(1.0, 1.0);
    reference_free(&run);
    model.initial = xcalloc(2, sizeof(double));
    model.initial[0] = 0.5;
    model.initial[1] = -1.0;
    TEST_ASSERT_NULL(model_check(&model).key);
    run = reference_new(&model, START_MODEL, 1.5);
    assert_memory(0.5, -1.0);
    reference_step(&run, 2.0);
    assert_memory(1.0, -1.0);
    reference_free(&run);
    // At rest for inputs -0.5 ... 1.5; the middle is 0.5, to the bisection's last bit at 4.
    run = reference_start(&model, START_MODEL);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.5, run.input);
}

static void test_step_by_hand(void)
{
    run = reference_new(&model, START_NEGATIVE_SATURATION, 2.0);
    TEST_ASSERT_EQUAL_DOUBLE(13.0, reference_step(&run, 1.0)); // inside the play: only D moves
    TEST_ASSERT_EQUAL_DOUBLE(9.0, reference_step(&run, -1.0)); // w = min(-1 + 1, 1) = 0
    TEST_ASSERT_EQUAL_DOUBLE(9.0, reference_step(&run, -1.0)); // held
    TEST_ASSERT_EQUAL_DOUBLE(26.0, reference_step(&run, 6.0)); // beyond the range: w = 5, 1
}

static void test_inverse_takes_the_nearest_on_a_flat_stretch(void)
{
    model.nonhysteretic = curve_linear(0.0, 0.0);
    run = reference_new(&model, START_NEGATIVE_SATURATION, 2.0);
    // Within the play, inputs 0 ... 2, the output stays at 12: the present input is the answer.
    TEST_ASSERT_EQUAL_DOUBLE(2.0, reference_inverse(&run, 12.0).input);
    reference_step(&run, 1.0);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, reference_inverse(&run, 12.0).input);
    // 13 needs w = 1.5; the last bit of an input of 4 at most.
    TEST_ASSERT_DOUBLE_WITHIN(9e-16, 2.5, reference_inverse(&run, 13.0).input);
    TEST_ASSERT_DOUBLE_WITHIN(9e-16, -0.5, reference_inverse(&run, 11.0).input);
}

static void test_inverse_takes_the_near_end_of_a_flat_stretch(void)
{
    const double x[] = {-4.0, 1.0, 3.0, 4.0};
    const double y[] = {-4.0, 1.0, 1.0, 2.0};
    model.nonhysteretic = curve_table(x, y, 4);
    model.weight[0] = 0.0;
    model.weight[1] = 0.0;
    run = reference_new(&model, START_NEGATIVE_SATURATION, 0.0);
    // The last bit of an input of 4 at most.
    TEST_ASSERT_DOUBLE_WITHIN(9e-16, 1.0, reference_inverse(&run, 1.0).input);
    reference_step(&run, 4.0);
    TEST_ASSERT_DOUBLE_WITHIN(9e-16, 3.0, reference_inverse(&run, 1.0).input);
}

static void test_inverse_clamps_to_the_near_end_of_a_flat_stretch(void)
{
    model.nonhysteretic = curve_tanh(20.0, 0.0);
    model.weight[0] = 0.0;
    model.weight[1] = 0.0;
    run = reference_new(&model, START_NEGATIVE_SATURATION, 0.0);
    // 1 - tanh(x) = 2 exp(-2 x) is below half an ulp of 1 from x = 19.1 on.
    TEST_ASSERT_TRUE(reference_inverse(&run, 1000.0).input < 1.0);
    TEST_ASSERT_TRUE(reference_inverse(&run, -1000.0).input > -1.0);
}

static void test_inverse_range_and_clamping(void)
{
    run = reference_new(&model, START_NEGATIVE_SATURATION, 2.0);
    const reference_inverse_t high = reference_inverse(&run, 1000.0);
    TEST_ASSERT_EQUAL_DOUBLE(20.0, high.reachable_max);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, high.reachable_min);
    TEST_ASSERT_TRUE(high.clamped);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, high.input);
    const reference_inverse_t nothing = reference_inverse(&run, (double)NAN);
    TEST_ASSERT_TRUE(nothing.clamped);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, nothing.input);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, run.input);
}

static void test_inverse_from_beyond_the_range(void)
{
    run = reference_new(&model, START_NEGATIVE_SATURATION, 8.0);
    const reference_inverse_t found = reference_inverse(&run, 1000.0);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, found.input);
    TEST_ASSERT_TRUE(found.clamped);
    // w is left at 5 and 3 by falling to 4: 4 + 2 * 5 + 10 * 3
    TEST_ASSERT_EQUAL_DOUBLE(44.0, found.reachable_max);
}

static void test_run_of_no_samples(void)
{
    reference_run(&model, START_NEGATIVE_SATURATION, NULL, 0, NULL);
    const double input[] = {2.0, 1.0};
    double output[2];
    reference_run(&model, START_NEGATIVE_SATURATION, input, 2, output);
    TEST_ASSERT_EQUAL_DOUBLE(14.0, output[0]);
    TEST_ASSERT_EQUAL_DOUBLE(13.0, output[1]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_negative_saturation);
    RUN_TEST(test_positive_saturation);
    RUN_TEST(test_demagnetised);
    RUN_TEST(test_demagnetised_is_the_limit_of_an_alternation);
    RUN_TEST(test_own_initial_states);
    RUN_TEST(test_step_by_hand);
    RUN_TEST(test_inverse_takes_the_nearest_on_a_flat_stretch);
    RUN_TEST(test_inverse_takes_the_near_end_of_a_flat_stretch);
    RUN_TEST(test_inverse_clamps_to_the_near_end_of_a_flat_stretch);
    RUN_TEST(test_inverse_range_and_clamping);
    RUN_TEST(test_inverse_from_beyond_the_range);
    RUN_TEST(test_run_of_no_samples);
    return UNITY_END();
}
