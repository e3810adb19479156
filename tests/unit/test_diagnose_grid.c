#include "diagnose_grid.h"
#include "random.h"
#include <math.h>
#include <unity.h>

enum { VALUES = 4000 };

static double values[VALUES];

void setUp(void)
{
    random_t random = random_new(3);
    for (size_t t = 0; t < VALUES; t++) {
        values[t] = 5 + 2 * sin(0.01 * (double)t) + 0.01 * random_normal(&random);
    }
}

void tearDown(void)
{
}

static void round_to(double step, double offset)
{
    for (size_t t = 0; t < VALUES; t++) {
        values[t] = offset + step * round((values[t] - offset) / step);
    }
}

static void test_steps_and_a_level_are_found(void)
{
    round_to(0.05, 0.013);
    const grid_step_t grid = grid_step_of(values, VALUES);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.05, grid.step);
    const double steps = (grid.offset - 0.013) / 0.05;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, round(steps), steps);
}

/// Codes of uneven width, each up to a tenth off: neighbours are then up to a fifth of a step further apart.
static void test_uneven_codes_are_steps(void)
{
    round_to(0.05, 0);
    for (size_t t = 0; t < VALUES; t++) {
        values[t] += 0.005 * sin(12.9898 * round(values[t] / 0.05));
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.2 * 0.05, 0.05, grid_step_of(values, VALUES).step);
}

static void test_continuous_values_have_none(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(0, 0, grid_step_of(values, VALUES).step);
}

/// Two levels are a switch, not a grid; one value or none is nothing.
static void test_too_few_levels_have_none(void)
{
    for (size_t t = 0; t < VALUES; t++) {
        values[t] = t % 2 == 0 ? 1 : 2;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0, 0, grid_step_of(values, VALUES).step);
    TEST_ASSERT_DOUBLE_WITHIN(0, 0, grid_step_of(values, 1).step);
    TEST_ASSERT_DOUBLE_WITHIN(0, 0, grid_step_of(values, 0).step);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_steps_and_a_level_are_found);
    RUN_TEST(test_uneven_codes_are_steps);
    RUN_TEST(test_continuous_values_have_none);
    RUN_TEST(test_too_few_levels_have_none);
    return UNITY_END();
}
