#include "forecast.h"
#include "random.h"
#include <math.h>
#include <unity.h>

enum { PIECES = 24, RECORDS = 1000 };

static double after[PIECES];
static double before[PIECES];

void setUp(void)
{
    for (size_t i = 0; i < PIECES; i++) {
        after[i] = 0.25;
        before[i] = 1;
    }
}

void tearDown(void)
{
}

/// Pieces of work that differ by a tenth in what they leave and in what the model alone leaves.
static void make_record(random_t* random)
{
    for (size_t i = 0; i < PIECES; i++) {
        after[i] = 0.25 * (1 + 0.1 * random_normal(random));
        before[i] = 1 + 0.1 * random_normal(random);
    }
}

static void test_equal_pieces_leave_no_doubt(void)
{
    const forecast_t forecast = forecast_shrink(after, before, PIECES);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, forecast.shrink);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 0.5, forecast.low);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 0.5, forecast.high);
}

/// Of so many records nine in ten have the next one's shrink within their interval, with a binomial's
/// standard deviation of sqrt(0.9 * 0.1 / 1000) = 0.95 %; three of them either way.
static void test_interval_holds_the_next_record(void)
{
    random_t random = random_new(57);
    size_t held = 0;
    make_record(&random);
    for (size_t k = 0; k < RECORDS; k++) {
        const forecast_t forecast = forecast_shrink(after, before, PIECES);
        make_record(&random);
        const double realised = forecast_shrink(after, before, PIECES).shrink;
        held += forecast.low <= realised && realised <= forecast.high;
    }
    TEST_ASSERT_DOUBLE_WITHIN(3 * sqrt(0.9 * 0.1 / RECORDS), 0.9, (double)held / RECORDS);
}

/// What one piece alone shows is uncertain, but where no piece was made worse no mixture of them is, and none
/// is better than the best.
static void test_pieces_bound_the_interval(void)
{
    for (size_t i = 0; i < PIECES; i++) {
        after[i] = 1;
    }
    before[5] = 400;
    const forecast_t forecast = forecast_shrink(after, before, PIECES);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1 - sqrt(24.0 / 423), forecast.shrink);
    TEST_ASSERT_EQUAL_DOUBLE(0, forecast.low);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1 - sqrt(1.0 / 400), forecast.high);
}

static void test_harm_is_negative(void)
{
    for (size_t i = 0; i < PIECES; i++) {
        after[i] = 4;
    }
    const forecast_t forecast = forecast_shrink(after, before, PIECES);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1, forecast.shrink);
    TEST_ASSERT_TRUE(forecast.high < 0);
}

static void test_no_gap_has_nothing_to_shrink(void)
{
    for (size_t i = 0; i < PIECES; i++) {
        before[i] = 0;
    }
    const forecast_t forecast = forecast_shrink(after, before, PIECES);
    TEST_ASSERT_EQUAL_DOUBLE(0, forecast.shrink);
    TEST_ASSERT_EQUAL_DOUBLE(0, forecast.low);
    TEST_ASSERT_EQUAL_DOUBLE(0, forecast.high);
}

/// An effect that leaves nothing at all is finite, too.
static void test_nothing_left_is_all(void)
{
    for (size_t i = 0; i < PIECES; i++) {
        after[i] = 0;
    }
    const forecast_t forecast = forecast_shrink(after, before, PIECES);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 1, forecast.shrink);
    TEST_ASSERT_TRUE(forecast.low <= forecast.shrink && forecast.shrink <= forecast.high);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_equal_pieces_leave_no_doubt);
    RUN_TEST(test_interval_holds_the_next_record);
    RUN_TEST(test_pieces_bound_the_interval);
    RUN_TEST(test_harm_is_negative);
    RUN_TEST(test_no_gap_has_nothing_to_shrink);
    RUN_TEST(test_nothing_left_is_all);
    return UNITY_END();
}
