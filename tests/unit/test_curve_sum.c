#include "curve_sum.h"
#include "unity.h"
#include <float.h>
#include <math.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static curve_t line(void)
{
    curve_t curve = curve_linear(2.0, -1.0);
    curve_scale(&curve, 0.5);
    return curve;
}

static curve_t table(void)
{
    return curve_table((const double[]){-1.0, 0.0, 2.0}, (const double[]){0.0, 1.0, 4.0}, 3);
}

static curve_t other_table(void)
{
    return curve_table((const double[]){-2.0, 0.0, 1.0}, (const double[]){-3.0, 0.5, 0.75}, 3);
}

/// Also beyond the tables' ends, where they continue. Values stay below 100, in some ten operations.
static void assert_adds(curve_t curve, curve_t other)
{
    const curve_t before = curve_copy(&curve);
    TEST_ASSERT_TRUE(curve_add_curve(&curve, &other, 1.5));
    for (double v = -5.0; v <= 5.0; v += 0.25) {
        const double expected = curve_value(&before, v) + 1.5 * curve_value(&other, v);
        TEST_ASSERT_TRUE(fabs(expected - curve_value(&curve, v)) <= 10.0 * 100.0 * DBL_EPSILON);
    }
    curve_t copy = before;
    curve_free(&copy);
    curve_free(&curve);
    curve_free(&other);
}

static void sums_that_are_curves(void)
{
    curve_t constant = curve_linear(0.0, 3.0);
    curve_t same_tanh = curve_tanh(0.7, 0.2);
    curve_scale(&same_tanh, 3.0);
    curve_add(&same_tanh, -1.0);
    assert_adds(line(), curve_linear(0.3, 0.4));
    assert_adds(line(), table());
    assert_adds(table(), line());
    assert_adds(table(), other_table());
    assert_adds(constant, curve_tanh(0.7, 0.2));
    assert_adds(same_tanh, curve_tanh(0.7, 0.2));
    assert_adds(constant, line());
}

static void assert_refuses(curve_t curve, curve_t other)
{
    const curve_t before = curve_copy(&curve);
    TEST_ASSERT_FALSE(curve_add_curve(&curve, &other, 1.5));
    TEST_ASSERT_TRUE(curve_equal(&before, &curve));
    curve_t copy = before;
    curve_free(&copy);
    curve_free(&curve);
    curve_free(&other);
}

static void sums_that_are_none(void)
{
    assert_refuses(line(), curve_tanh(1.0, 0.0));
    assert_refuses(curve_tanh(1.0, 0.0), line());
    assert_refuses(curve_tanh(1.0, 0.0), table());
    assert_refuses(table(), curve_tanh(1.0, 0.0));
    assert_refuses(curve_tanh(1.0, 0.0), curve_tanh(1.0, 0.5));
}

static void equality(void)
{
    curve_t one = table();
    curve_t same = table();
    curve_t other = other_table();
    const curve_t steep = curve_tanh(2.0, 0.0);
    const curve_t flat = curve_tanh(1.0, 0.0);
    TEST_ASSERT_TRUE(curve_equal(&one, &same));
    TEST_ASSERT_FALSE(curve_equal(&one, &other));
    TEST_ASSERT_FALSE(curve_equal(&one, &steep));
    TEST_ASSERT_FALSE(curve_equal(&flat, &steep));
    TEST_ASSERT_TRUE(curve_equal(&steep, &steep));
    curve_free(&one);
    curve_free(&same);
    curve_free(&other);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(sums_that_are_curves);
    RUN_TEST(sums_that_are_none);
    RUN_TEST(equality);
    return UNITY_END();
}
