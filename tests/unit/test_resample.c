#include "resample.h"
#include <math.h>
#include <unity.h>

enum { STRETCHES = 24 };

static double part[STRETCHES];
static double whole[STRETCHES];

void setUp(void)
{
    for (size_t s = 0; s < STRETCHES; s++) {
        part[s] = 0;
        whole[s] = 1;
    }
}

void tearDown(void)
{
}

static void test_equal_stretches_leave_no_doubt(void)
{
    for (size_t s = 0; s < STRETCHES; s++) {
        part[s] = 0.25;
    }
    const interval_t interval = resample_ratio(part, whole, STRETCHES, 0);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, interval.low);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, interval.high);
}

/// Half the stretches have all of it: a binomial of 24 draws, whose 5 % and 95 % quantiles are 8 and 16. With
/// 400 draws their place scatters by sqrt(0.05 * 0.95 / 400) = 1.1 %, four times that reach 7 ... 8 and
/// 16 ... 17 (P(at most 7) = 3.2 %, P(at most 8) = 7.6 %).
static void test_interval_is_the_binomial_one(void)
{
    for (size_t s = 0; s < STRETCHES; s += 2) {
        part[s] = 1;
    }
    const interval_t interval = resample_ratio(part, whole, STRETCHES, 0);
    TEST_ASSERT_TRUE(interval.low >= 7.0 / STRETCHES - 1e-12 && interval.low <= 8.0 / STRETCHES + 1e-12);
    TEST_ASSERT_TRUE(interval.high >= 16.0 / STRETCHES - 1e-12 && interval.high <= 17.0 / STRETCHES + 1e-12);
}

static void test_nothing_at_all_is_what_the_caller_says(void)
{
    for (size_t s = 0; s < STRETCHES; s++) {
        whole[s] = 0;
    }
    const interval_t interval = resample_ratio(part, whole, STRETCHES, 1);
    TEST_ASSERT_EQUAL_DOUBLE(1, interval.low);
    TEST_ASSERT_EQUAL_DOUBLE(1, interval.high);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_equal_stretches_leave_no_doubt);
    RUN_TEST(test_interval_is_the_binomial_one);
    RUN_TEST(test_nothing_at_all_is_what_the_caller_says);
    return UNITY_END();
}
