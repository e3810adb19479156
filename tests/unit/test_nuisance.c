#include "nuisance.h"
#include <math.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 1300, NUMBERS = 3 };

static bool counts[SAMPLES];
static double residual[SAMPLES];

void setUp(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        counts[t] = true;
    }
}

void tearDown(void)
{
}

static double derivative(size_t number, size_t t)
{
    return number == 0 ? 1 : number == 1 ? cos(0.01 * (double)t) : 0;
}

static void rows(void* context, size_t begin, size_t end, double* derivatives)
{
    (void)context;
    for (size_t t = begin; t < end; t++) {
        for (size_t k = 0; k < NUMBERS; k++) {
            derivatives[(t - begin) * NUMBERS + k] = derivative(k, t);
        }
    }
}

/// Independent numbers of variance 1 / precision; the third does nothing.
static nuisance_t make(double first, double second)
{
    double precision[NUMBERS * NUMBERS] = {first, 0, 0, 0, second, 0, 0, 0, 1};
    return nuisance_new(precision, NUMBERS, SAMPLES, 1e-6, rows, NULL);
}

/// The covariance of the series is that of the numbers, carried over by the derivatives.
static void test_series_have_the_numbers_covariance(void)
{
    nuisance_t nuisance = make(4, 0.25);
    TEST_ASSERT_EQUAL(2, nuisance.count);
    for (size_t t = 0; t < SAMPLES; t += 17) {
        const size_t s = SAMPLES - 1 - t;
        double covariance = 0;
        for (size_t k = 0; k < nuisance.count; k++) {
            covariance += nuisance.series[k * SAMPLES + t] * nuisance.series[k * SAMPLES + s];
        }
        const double expected =
            derivative(0, t) * derivative(0, s) / 4 + derivative(1, t) * derivative(1, s) / 0.25;
        // Sums of 1300 terms of the order of 1 in double precision, through a factorisation and its
        // eigenvalues.
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, expected, covariance);
    }
    nuisance_free(&nuisance);
}

/// One direction s with the price `variance`: the least of |r - a s|^2 + variance a^2 is at a = s'r / (s's +
/// variance).
static void test_the_amount_balances_gain_and_price(void)
{
    nuisance_t nuisance = make(4, 1e12);
    TEST_ASSERT_EQUAL(1, nuisance.count);
    const double variance = 50;
    double energy = 0;
    double product = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        counts[t] = t % 3 != 0;
        residual[t] = counts[t] ? 2 + sin(0.3 * (double)t) : 0;
        const double s = nuisance.series[t];
        energy += counts[t] ? s * s : 0;
        product += s * residual[t];
    }
    nuisance_filter_t filter = nuisance_filter_new(&nuisance, variance, counts);
    double amount[1];
    nuisance_filter_find(&filter, residual, amount);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * fabs(amount[0]), product / (energy + variance), amount[0]);
    const double before = residual[7];
    nuisance_take(&nuisance, amount, residual);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, before - amount[0] * nuisance.series[7], residual[7]);
    nuisance_filter_free(&filter);
    nuisance_free(&nuisance);
}

static void test_without_directions_nothing_is_taken(void)
{
    const nuisance_t nothing = {.num_samples = SAMPLES};
    nuisance_filter_t filter = nuisance_filter_new(&nothing, 1, counts);
    double amount[1] = {3};
    residual[5] = 7;
    nuisance_filter_find(&filter, residual, amount);
    nuisance_take(&nothing, amount, residual);
    TEST_ASSERT_DOUBLE_WITHIN(0, 7, residual[5]);
    nuisance_filter_free(&filter);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_series_have_the_numbers_covariance);
    RUN_TEST(test_the_amount_balances_gain_and_price);
    RUN_TEST(test_without_directions_nothing_is_taken);
    return UNITY_END();
}
