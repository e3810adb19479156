#include "model.h"
#include "unity.h"
#include <math.h>
#include <string.h>

static model_t model;

/// The VO2 film of Zhang et al. 2015, Table 6, with two plays.
void setUp(void)
{
    model = model_new("vo2_film");
    model.input_min = 30.0;
    model.input_max = 90.0;
    model.ascending = curve_tanh(0.16, -10.26);
    model.descending = curve_tanh(0.201, -11.58);
    model.nonhysteretic = curve_tanh(0.03, -1.61);
    model_set_num_plays(&model, 2);
    model.radius[0] = 0.1;
    model.radius[1] = 0.2;
    model.weight[0] = 1.5;
    model.weight[1] = 0.5;
}

void tearDown(void)
{
    model_free(&model);
}

static void assert_fault(const char* key, const char* subkey, long index)
{
    const model_fault_t fault = model_check(&model);
    TEST_ASSERT_NOT_NULL(fault.key);
    TEST_ASSERT_EQUAL_STRING(key, fault.key);
    TEST_ASSERT_EQUAL_STRING(subkey, fault.subkey);
    TEST_ASSERT_EQUAL_INT(index, fault.index);
    TEST_ASSERT_NOT_EQUAL(0, strlen(fault.text));
}

static void test_valid_model_has_no_fault(void)
{
    TEST_ASSERT_NULL(model_check(&model).key);
}

static void test_range(void)
{
    model.input_max = 30.0;
    assert_fault("input", "max", -1);
    model.input_max = (double)INFINITY;
    assert_fault("input", "max", -1);
    model.input_min = (double)NAN;
    assert_fault("input", "min", -1);
    model.input_min = -1e308;
    model.input_max = 1e308;
    assert_fault("input", "max", -1);
}

static void test_envelopes(void)
{
    model.descending.gain = (double)NAN;
    assert_fault("descending", "gain", -1);
    model.descending.gain = -1.0;
    assert_fault("descending", "slope", -1);
    model.descending.gain = 1.0;
    model.ascending.slope = 0.0;
    assert_fault("ascending", "slope", -1);
    // Saturated over the whole range: slope above 0, yet nothing moves.
    model.ascending = curve_tanh(0.16, 100.0);
    assert_fault("ascending", NULL, -1);
    model.ascending = curve_linear(1e308, 0.0);
    assert_fault("ascending", NULL, -1);
}

static void test_tables(void)
{
    const double x[] = {30.0, 60.0, 90.0};
    const double y[] = {-1.0, 0.0, 0.0};
    model.nonhysteretic = curve_table(x, y, 3);
    TEST_ASSERT_NULL(model_check(&model).key);
    model.nonhysteretic.y[2] = -0.5;
    assert_fault("nonhysteretic", "y", 2);
    model.nonhysteretic.x[1] = 30.0;
    assert_fault("nonhysteretic", "x", 1);
    model.nonhysteretic.num_knots = 1;
    assert_fault("nonhysteretic", "x", -1);
    curve_free(&model.nonhysteretic);
    model.nonhysteretic = curve_linear(0.0, 0.0);
    model.ascending = curve_table(x, y, 3);
    assert_fault("ascending", "y", 2);
}

static void test_plays(void)
{
    model.weight[1] = -1e-9;
    assert_fault("weights", NULL, 1);
    model.weight[1] = (double)INFINITY;
    assert_fault("weights", NULL, 1);
    model.weight[0] = 1e308;
    model.weight[1] = 1e308;
    assert_fault("weights", NULL, 1);
    model.radius[1] = 0.05;
    assert_fault("radii", NULL, 1);
    model.radius[0] = -0.1;
    assert_fault("radii", NULL, 0);
    model_set_num_plays(&model, 0);
    assert_fault("radii", NULL, -1);
    model_set_num_plays(&model, MODEL_MAX_PLAYS + 1);
    assert_fault("radii", NULL, -1);
}

static void test_equal_radii_are_allowed(void)
{
    model.radius[1] = 0.1;
    TEST_ASSERT_NULL(model_check(&model).key);
}

static void test_least_radius(void)
{
    // Linear: the gap 0.5 v + 1 is largest at the upper end, (45 + 1) / 2.
    model.descending = curve_linear(0.5, -1.0);
    model.ascending = curve_linear(1.0, 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(23.0, model_least_radius(&model));
    model.descending = curve_linear(1.0, 1.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, model_least_radius(&model));
    TEST_ASSERT_NULL(model_check(&model).key);
}

static void test_least_radius_at_a_knot(void)
{
    const double x[] = {30.0, 50.0, 90.0};
    const double y[] = {30.0, 56.0, 90.0};
    model.ascending = curve_table(x, y, 3);
    model.descending = curve_linear(1.0, 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, model_least_radius(&model));
    assert_fault("radii", NULL, 0);
    // The condition is met to 1e-9 of the envelopes' span of 60, no further.
    model.radius[0] = 3.0 - 5e-8;
    model.radius[1] = 3.0;
    TEST_ASSERT_NULL(model_check(&model).key);
    model.radius[0] = 3.0 - 7e-8;
    assert_fault("radii", NULL, 0);
}

static void test_least_radius_between_grid_points(void)
{
    // tanh(a (v - b)) - tanh(a (v - c)) peaks half way, at 2 tanh(a (c - b) / 2).
    const double slope = 3.0;
    model.ascending = curve_tanh(slope, -slope * 57.1234);
    model.descending = curve_tanh(slope, -slope * 57.2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, tanh(slope * 0.0766 / 2.0), model_least_radius(&model));
}

static void test_largest_moving_radius(void)
{
    const double expected = 0.5 * (tanh(0.16 * 90.0 - 10.26) - tanh(0.201 * 30.0 - 11.58));
    TEST_ASSERT_EQUAL_DOUBLE(expected, model_largest_moving_radius(&model));
}

static void test_initial_states(void)
{
    model.ascending = curve_linear(1.0, 0.0);
    model.descending = curve_linear(1.0, 0.0);
    model.initial = xcalloc(2, sizeof(double));
    model.initial[0] = 50.0;
    model.initial[1] = 50.05;
    double low;
    double high;
    TEST_ASSERT_TRUE(model_initial_inputs(&model, &low, &high));
    // |v - 50| <= 0.1, and the bisection's last bit at 90.
    TEST_ASSERT_DOUBLE_WITHIN(2e-14, 49.9, low);
    TEST_ASSERT_DOUBLE_WITHIN(2e-14, 50.1, high);
    TEST_ASSERT_NULL(model_check(&model).key);
    model.initial[1] = 50.3;
    assert_fault("initial", NULL, 1);
    model.initial[1] = 49.7;
    assert_fault("initial", NULL, 1);
    model.initial[0] = 90.2;
    model.initial[1] = 90.2;
    assert_fault("initial", NULL, 0);
    model.initial[0] = (double)NAN;
    assert_fault("initial", NULL, 0);
}

static void test_copy_and_free(void)
{
    model.initial = xcalloc(2, sizeof(double));
    model.effects = json_pack("[{s:s}]", "type", "delay");
    model_t copy = model_copy(&model);
    copy.radius[0] = 9.0;
    json_array_clear(copy.effects);
    TEST_ASSERT_EQUAL_DOUBLE(0.1, model.radius[0]);
    TEST_ASSERT_EQUAL_INT(1, json_array_size(model.effects));
    TEST_ASSERT_EQUAL_STRING("vo2_film", copy.name);
    model_free(&copy);
    model_free(&copy);
    TEST_ASSERT_NULL(copy.radius);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_valid_model_has_no_fault);
    RUN_TEST(test_range);
    RUN_TEST(test_envelopes);
    RUN_TEST(test_tables);
    RUN_TEST(test_plays);
    RUN_TEST(test_equal_radii_are_allowed);
    RUN_TEST(test_least_radius);
    RUN_TEST(test_least_radius_at_a_knot);
    RUN_TEST(test_least_radius_between_grid_points);
    RUN_TEST(test_largest_moving_radius);
    RUN_TEST(test_initial_states);
    RUN_TEST(test_copy_and_free);
    return UNITY_END();
}
