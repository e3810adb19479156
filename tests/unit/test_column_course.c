#include "column_course.h"
#include "random.h"
#include "series.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 6000, LONG = 60000, REACH = 20 };

static const double pi = 3.14159265358979324;
static const double noise = 0.02;
static double time_of[LONG];
static double value[LONG];
static double truth[LONG];

void setUp(void)
{
}
void tearDown(void)
{
}

/// A temperature's course, six slow waves a record of SAMPLES, and its sensor's noise; every ninth sample
/// lost.
static void measure(size_t num_samples, double of_noise, bool is_complete)
{
    random_t random = random_new(3);
    size_t at = 0;
    for (size_t t = 0; t < num_samples; t++, at++) {
        at += !is_complete && at % 9 == 8;
        time_of[t] = 5 + 0.01 * (double)at;
        const double part = (double)at / SAMPLES;
        truth[t] = 20 + sin(2 * pi * 6 * part) + 0.4 * cos(2 * pi * 2.3 * part);
        value[t] = truth[t] + of_noise * random_normal(&random);
    }
}

static double left_of(const double* course, size_t first, size_t end)
{
    return sqrt(series_mean_square(course + first, truth + first, end - first));
}

/// A parabola over 2 REACH + 1 neighbours leaves sqrt(9 / (4 (2 REACH + 1))) = 0.23 of white noise inside
/// (Savitzky, Golay 1964). The likeliest spline may be as wide as the course allows, which is wider.
static void check_less_than_a_parabola(size_t num_samples, bool is_complete)
{
    measure(num_samples, noise, is_complete);
    double* course = column_course(time_of, value, num_samples);
    TEST_ASSERT_TRUE(left_of(course, REACH, num_samples - REACH) < noise * sqrt(9.0 / (4 * (2 * REACH + 1))));
    // At the very ends a parabola through REACH neighbours on one side leaves 9 / REACH of the noise's
    // variance: one number drawn from that, four standard deviations of which are asked.
    TEST_ASSERT_TRUE(left_of(course, 0, REACH) < 4 * noise * sqrt(9.0 / REACH));
    free(course);
}

static void test_the_sensors_noise_is_taken_away(void)
{
    check_less_than_a_parabola(SAMPLES, true);
}

static void test_lost_samples_do_not_matter(void)
{
    check_less_than_a_parabola(SAMPLES, false);
}

static void test_a_long_records_noise_is_taken_away(void)
{
    check_less_than_a_parabola(LONG, true);
}

static void check_stays(void)
{
    double* course = column_course(time_of, value, SAMPLES);
    TEST_ASSERT_EQUAL_MEMORY(value, course, SAMPLES * sizeof *course);
    free(course);
}

/// Without noise the course is what was measured, to the last bit: slow, straight from point to point, or
/// fast.
static void test_a_clean_column_stays(void)
{
    measure(SAMPLES, 0, true);
    check_stays();
    for (size_t t = 0; t < SAMPLES; t++) {
        const size_t from = t / 3 * 3;
        value[t] =
            truth[from] + (truth[from + 3 < SAMPLES ? from + 3 : from] - truth[from]) * (double)(t % 3) / 3;
    }
    check_stays();
    for (size_t t = 0; t < SAMPLES; t++) {
        value[t] = sin(0.7 * (double)t);
    }
    check_stays();
}

/// Four pressures, each held: nothing is off by more than five of the noise's standard deviations, least of
/// all beside a jump of a hundred and more; and where it is held the noise is taken away as anywhere.
static void test_jumps_stay(void)
{
    static const double pressure[] = {1, 5, 3, 7};
    random_t random = random_new(4);
    for (size_t t = 0; t < SAMPLES; t++) {
        time_of[t] = (double)t;
        truth[t] = pressure[t * 4 / SAMPLES];
        value[t] = truth[t] + noise * random_normal(&random);
    }
    double* course = column_course(time_of, value, SAMPLES);
    for (size_t t = 0; t < SAMPLES; t++) {
        TEST_ASSERT_DOUBLE_WITHIN(5 * noise, truth[t], course[t]);
    }
    TEST_ASSERT_TRUE(left_of(course, 0, SAMPLES) < noise * sqrt(9.0 / (4 * (2 * REACH + 1))));
    free(course);
}

/// What is no slow course beside small noise is taken as it is: the plant may feel all of it.
static void test_a_noisy_quantity_stays(void)
{
    random_t random = random_new(5);
    measure(SAMPLES, 0, true);
    for (size_t t = 0; t < SAMPLES; t++) {
        value[t] = 24 + random_normal(&random) + 2 * sin(0.002 * (double)t);
    }
    check_stays();
}

static void test_short_and_constant_columns_stay(void)
{
    measure(SAMPLES, noise, true);
    for (size_t n = 0; n < 16; n++) {
        double* course = column_course(time_of, value, n);
        TEST_ASSERT_EQUAL_INT(0, memcmp(value, course, n * sizeof *course));
        free(course);
    }
    for (size_t t = 0; t < SAMPLES; t++) {
        value[t] = 25;
    }
    check_stays();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_sensors_noise_is_taken_away);
    RUN_TEST(test_lost_samples_do_not_matter);
    RUN_TEST(test_a_long_records_noise_is_taken_away);
    RUN_TEST(test_a_clean_column_stays);
    RUN_TEST(test_jumps_stay);
    RUN_TEST(test_a_noisy_quantity_stays);
    RUN_TEST(test_short_and_constant_columns_stay);
    return UNITY_END();
}
