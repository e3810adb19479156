#include "random.h"
#include "spectrum.h"
#include <float.h>
#include <math.h>
#include <unity.h>

enum { MOST = 4001 };

static double time_of[MOST];
static double series[MOST];
static double part[2 * MOST + 1];
static spectrum_t spectrum;

static const double pi = 3.14159265358979324;
static const double step = 0.01;

void setUp(void)
{
    for (size_t t = 0; t < MOST; t++) {
        time_of[t] = 5 + step * (double)t;
    }
}

void tearDown(void)
{
    spectrum_free(&spectrum);
}

static double sum_of_squares(size_t n)
{
    double sum = 0;
    for (size_t t = 0; t < n; t++) {
        sum += series[t] * series[t];
    }
    return sum;
}

static double energy(size_t first, size_t last)
{
    double sum = 0;
    for (size_t k = first; k <= last; k++) {
        sum += spectrum_energy(&spectrum, k);
    }
    return sum;
}

/// Parseval, for lengths that are fast, odd and prime: float's rounding in some log2(4001) = 12 stages of
/// complex butterflies of four operations each.
static void test_no_energy_is_lost(void)
{
    static const size_t lengths[] = {2, 3, 200, 999, 3989, 4000, 4001};
    random_t random = random_new(1);
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        const size_t n = lengths[i];
        for (size_t t = 0; t < n; t++) {
            series[t] = 3e20 + 1e20 * random_normal(&random);
        }
        spectrum = spectrum_new(time_of, step, series, n);
        TEST_ASSERT_EQUAL(n, spectrum.num_samples);
        TEST_ASSERT_DOUBLE_WITHIN(4 * 12 * (double)FLT_EPSILON * sum_of_squares(n), sum_of_squares(n),
                                  energy(0, spectrum.num_bins - 1));
        spectrum_band(&spectrum, 0, spectrum.num_bins - 1, part);
        for (size_t t = 0; t < n; t++) {
            TEST_ASSERT_DOUBLE_WITHIN(4 * 2 * 12 * (double)FLT_EPSILON * spectrum.scale, series[t], part[t]);
        }
        spectrum_free(&spectrum);
    }
}

/// 1000 samples, whole periods of 4 and 20 Hz: each is a line of half its amplitude's square a sample.
static void test_lines_stand_where_they_belong(void)
{
    const size_t n = 1000;
    for (size_t t = 0; t < n; t++) {
        const double at = step * (double)t;
        series[t] = 2 + 3 * sin(2 * pi * 4 * at) + cos(2 * pi * 20 * at + 0.3);
    }
    spectrum = spectrum_new(time_of, step, series, n);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1, spectrum.resolution);
    const double tolerance = 48 * (double)FLT_EPSILON * sum_of_squares(n);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, 4.0 * (double)n, energy(0, 0));
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, 4.5 * (double)n, energy(40, 40));
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, 0.5 * (double)n, energy(200, 200));
    spectrum_band(&spectrum, 150, 250, part);
    for (size_t t = 0; t < n; t++) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, cos(2 * pi * 20 * step * (double)t + 0.3), part[t]);
    }
}

/// A tenth of the samples is missing: the grid is the whole record's all the same, a sample that was there
/// keeps its value, and one between two others is their mean, so half its noise is left.
static void test_missing_samples_are_filled_in(void)
{
    size_t n = 0;
    for (size_t t = 0; t < MOST; t++) {
        if (t % 10 != 5) {
            time_of[n] = step * (double)t;
            series[n] = (double)(t % 7);
            n++;
        }
    }
    spectrum = spectrum_new(time_of, step, series, n);
    TEST_ASSERT_EQUAL(MOST, spectrum.num_samples);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, step, spectrum.step);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.9 + 0.1 * 0.5, spectrum.interpolated);
    spectrum_band(&spectrum, 0, spectrum.num_bins - 1, part);
    for (size_t t = 0; t < MOST; t++) {
        const double filled = 0.5 * (double)((t - 1) % 7 + (t + 1) % 7);
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, t % 10 == 5 ? filled : (double)(t % 7), part[t]);
    }
}

/// Bursts of a step far below the record's mean one may not make the grid grow without bound.
static void test_bursts_keep_the_grid_small(void)
{
    for (size_t t = 0; t < 1000; t++) {
        time_of[t] = (double)(t / 10) + 1e-6 * (double)(t % 10);
        series[t] = (double)(t / 10 % 2);
    }
    spectrum = spectrum_new(time_of, 1e-6, series, 1000);
    TEST_ASSERT_EQUAL(2001, spectrum.num_samples);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, time_of[999] / 2000, spectrum.step);
}

static void test_white_noise_is_flat(void)
{
    const size_t n = 4000;
    random_t random = random_new(9);
    for (size_t t = 0; t < n; t++) {
        series[t] = 0.5 * random_normal(&random);
    }
    spectrum = spectrum_new(time_of, step, series, n);
    // A band of 400 bins holds 800 squares of N(0, 1): their mean scatters by sqrt(2 / 800) = 5 %, four times
    // that are 20 %.
    for (size_t first = 1; first + 400 < spectrum.num_bins; first += 400) {
        double expected = 0;
        for (size_t k = first; k < first + 400; k++) {
            expected += spectrum_noise(&spectrum, 0.5, k);
        }
        TEST_ASSERT_DOUBLE_WITHIN(0.2 * expected, expected, energy(first, first + 399));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_energy_is_lost);
    RUN_TEST(test_lines_stand_where_they_belong);
    RUN_TEST(test_missing_samples_are_filled_in);
    RUN_TEST(test_bursts_keep_the_grid_small);
    RUN_TEST(test_white_noise_is_flat);
    return UNITY_END();
}
