#include "diagnose_where.h"
#include "random.h"
#include <math.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 4000 };

static double time_of[SAMPLES];
static double input[SAMPLES];
static double output[SAMPLES];
static double gap[SAMPLES];
static effect_run_t run;
static region_t region[WHERE_MAX_REGIONS];
static const double noise = 0.1;

void setUp(void)
{
    // Ten triangles of 4 s each between 0 and 10.
    random_t random = random_new(3);
    for (size_t t = 0; t < SAMPLES; t++) {
        const double phase = 10.0 * (double)t / SAMPLES;
        const double part = phase - floor(phase);
        time_of[t] = 0.01 * (double)t;
        input[t] = 10 * (part < 0.5 ? 2 * part : 2 - 2 * part);
        output[t] = 3 * input[t];
        gap[t] = noise * random_normal(&random);
    }
    run = (effect_run_t){
        .num_samples = SAMPLES, .time = time_of, .input = input, .input_span = 10, .duration = 40};
}

void tearDown(void)
{
}

static const region_t* region_on(axis_t axis, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (region[i].axis == axis) {
            return &region[i];
        }
    }
    return NULL;
}

/// A gap of 1 in 8 ... 12 s has all its energy there: a tenth of the samples, lift 10. The noise's own energy
/// is subtracted, so what is left of it is its estimate's scatter: 4000 squares of 0.1 against 400 of 1,
/// below 1 %.
static void test_time_region_is_found(void)
{
    for (size_t t = 800; t < 1200; t++) {
        gap[t] += 1;
    }
    const size_t count = where_find(&run, output, gap, noise, region);
    TEST_ASSERT_EQUAL(AXIS_TIME, region[0].axis);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 8, region[0].from);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 12, region[0].to);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 1, region[0].share);
    TEST_ASSERT_DOUBLE_WITHIN(0.5, 10, region[0].lift);
    TEST_ASSERT_TRUE(count >= 6);
}

static void test_descending_gap_is_found(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        const double phase = 10.0 * (double)t / SAMPLES;
        gap[t] += phase - floor(phase) >= 0.5 ? 1 : 0;
    }
    const size_t count = where_find(&run, output, gap, noise, region);
    TEST_ASSERT_EQUAL(AXIS_DIRECTION, region[0].axis);
    TEST_ASSERT_EQUAL_DOUBLE(-1, region[0].from);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 1, region[0].share);
    TEST_ASSERT_NOT_NULL(region_on(AXIS_TIME, count));
}

/// The first 0.2 s after each reversal, a tenth of the samples.
static void test_gap_after_reversals_is_found(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        gap[t] += (t + 199) % 200 < 20 ? 1 : 0; // the turning point itself still belongs to the move before
    }
    const size_t count = where_find(&run, output, gap, noise, region);
    const region_t* since = region_on(AXIS_SINCE_REVERSAL, count);
    TEST_ASSERT_NOT_NULL(since);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 0, since->from);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 0.2, since->to);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 1, since->share);
    char text[200];
    where_describe(since, "V", "um", text, sizeof text);
    TEST_ASSERT_NOT_NULL(strstr(text, "after a reversal"));
}

static void test_input_region_and_interval(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        gap[t] += input[t] > 7 && input[t] < 9 ? 1 : 0;
    }
    const size_t count = where_find(&run, output, gap, noise, region);
    const region_t* at = region_on(AXIS_INPUT, count);
    TEST_ASSERT_NOT_NULL(at);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 7, at->from);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 9, at->to);
    TEST_ASSERT_TRUE(at->share_low <= at->share && at->share <= at->share_high);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_time_region_is_found);
    RUN_TEST(test_descending_gap_is_found);
    RUN_TEST(test_gap_after_reversals_is_found);
    RUN_TEST(test_input_region_and_interval);
    return UNITY_END();
}
