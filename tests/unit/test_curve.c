#include "model.h"
#include "unity.h"
#include <math.h>

static curve_t curve;

void setUp(void)
{
    const double x[] = {0.0, 1.0, 3.0};
    const double y[] = {0.0, 2.0, 3.0};
    curve = curve_table(x, y, 3);
}

void tearDown(void)
{
    curve_free(&curve);
}

static void test_formula_values(void)
{
    curve_t line = curve_linear(2.0, 1.0);
    curve_scale(&line, 3.0);
    curve_add(&line, -4.0);
    // 3 (2 v + 1) - 4
    TEST_ASSERT_EQUAL_DOUBLE(11.0, curve_value(&line, 2.0));
    TEST_ASSERT_EQUAL_DOUBLE(6.0, curve_slope(&line, 2.0));
    const curve_t sigmoid = curve_tanh(0.5, -1.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, curve_value(&sigmoid, 2.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, curve_slope(&sigmoid, 2.0));
    // d tanh = 1 / cosh^2, which underflows to 0 but never to a NaN.
    TEST_ASSERT_EQUAL_DOUBLE(0.0, curve_slope(&sigmoid, 1e6));
}

static void test_table_between_and_at_knots(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(1.0, curve_value(&curve, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, curve_value(&curve, 1.0));
    TEST_ASSERT_EQUAL_DOUBLE(2.5, curve_value(&curve, 2.0));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, curve_slope(&curve, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, curve_slope(&curve, 1.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, curve_slope(&curve, 3.0));
}

static void test_table_continues_beyond_its_ends(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(-2.0, curve_value(&curve, -1.0));
    TEST_ASSERT_EQUAL_DOUBLE(4.0, curve_value(&curve, 5.0));
}

static void test_inverse_is_the_least_input(void)
{
    // Bisection ends on neighbouring doubles: half an ulp of 4, the range's magnitude, either way.
    TEST_ASSERT_DOUBLE_WITHIN(4.5e-16, 0.5, curve_inverse(&curve, 1.0, -4.0, 4.0));
    TEST_ASSERT_EQUAL_DOUBLE(-4.0, curve_inverse(&curve, -100.0, -4.0, 4.0));
    TEST_ASSERT_EQUAL_DOUBLE(4.0, curve_inverse(&curve, 100.0, -4.0, 4.0));
    const curve_t saturated = curve_tanh(1.0, 0.0);
    const double v = curve_inverse(&saturated, 1.0, -100.0, 100.0);
    TEST_ASSERT_TRUE(curve_value(&saturated, v) == 1.0 && curve_value(&saturated, nextafter(v, 0.0)) < 1.0);
}

static void test_copy_is_independent(void)
{
    curve_t copy = curve_copy(&curve);
    curve_add(&copy, 10.0);
    curve_scale(&copy, 2.0);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, curve_value(&curve, 1.0));
    TEST_ASSERT_EQUAL_DOUBLE(24.0, curve_value(&copy, 1.0));
    curve_free(&copy);
    curve_free(&copy);
    TEST_ASSERT_NULL(copy.x);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_formula_values);
    RUN_TEST(test_table_between_and_at_knots);
    RUN_TEST(test_table_continues_beyond_its_ends);
    RUN_TEST(test_inverse_is_the_least_input);
    RUN_TEST(test_copy_is_independent);
    return UNITY_END();
}
