#include "random.h"
#include "sinusoid.h"
#include <math.h>
#include <unity.h>

enum { SAMPLES = 6000 };

static double time_of[SAMPLES];
static double series[SAMPLES];
static const double pi = 3.14159265358979324;
static const double step = 0.001;

void setUp(void)
{
}
void tearDown(void)
{
}

static void make_times(double jitter)
{
    random_t random = random_new(8);
    for (size_t t = 0; t < SAMPLES; t++) {
        time_of[t] = 40 + step * ((double)t + random_uniform(&random, 0, jitter));
    }
}

/// A line of amplitude 1 in noise of 1, and a slower one of 0.7.
static void make_lines(double frequency)
{
    random_t random = random_new(5);
    for (size_t t = 0; t < SAMPLES; t++) {
        series[t] = 3 + cos(2 * pi * frequency * time_of[t]) + 0.7 * sin(2 * pi * 1.9 * time_of[t]) +
                    random_normal(&random);
    }
}

/// From four periods a record to seven samples a period, on a bin and between two: 6 s.
static void test_the_strongest_line_is_found(void)
{
    static const double frequency[] = {4.0 / 6, 1.0, 12.25, 100.0 + 1.0 / 12, 1000.0 / 7};
    for (size_t i = 0; i < sizeof frequency / sizeof frequency[0]; i++) {
        make_times(i % 2 == 0 ? 0 : 0.5);
        make_lines(frequency[i]);
        const sinusoid_t line = strongest_sinusoid(time_of, step, series, SAMPLES);
        // Five times the Cramer-Rao bound, sqrt(24 / n) noise / (amplitude duration) over 2 pi, and the skirt
        // of the other line, 0.7 over pi times its distance in widths, which a curvature of pi^2 / 3 shifts.
        const double skirt = 0.7 / pi / fmax(6 * fabs(frequency[i] - 1.9), 1) / (pi * pi / 3) / 6;
        const double bound = 5 * sqrt(24.0 / SAMPLES) / 6 / (2 * pi) + skirt;
        TEST_ASSERT_DOUBLE_WITHIN(bound, frequency[i], line.frequency);
    }
}

static void test_shares_of_two_lines(void)
{
    make_times(0.5);
    for (size_t t = 0; t < SAMPLES; t++) {
        series[t] = 5 + 2 * sin(2 * pi * 20 * time_of[t]) + sin(2 * pi * 50 * time_of[t] + 1);
    }
    // Whole periods of both: 4 to 1, but for half a step of jitter, 2 pi 50 0.0005 / 2 of the amplitude.
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.8, sinusoid_share(time_of, series, SAMPLES, 20));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.2, sinusoid_share(time_of, series, SAMPLES, 50));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, sinusoid_share(time_of, series, SAMPLES, 35));
}

static void test_a_constant_has_no_line(void)
{
    make_times(0);
    for (size_t t = 0; t < SAMPLES; t++) {
        series[t] = 3;
    }
    // What the mean's rounding leaves is a constant, too, of which whole periods take nothing.
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0, sinusoid_share(time_of, series, SAMPLES, 7));
    TEST_ASSERT_TRUE(isfinite(strongest_sinusoid(time_of, step, series, SAMPLES).frequency));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_strongest_line_is_found);
    RUN_TEST(test_shares_of_two_lines);
    RUN_TEST(test_a_constant_has_no_line);
    return UNITY_END();
}
