#include "forecast.h"

#include <math.h>

/// Student's t at 95 % for FORECAST_STRETCHES - 1 degrees of freedom.
static const double student = 2.353;
/// Ratios of squares below it count as it: an RMS a millionth of the other's is rounding.
static const double least_ratio = 1e-12;

/// Logarithm of the ratio of the two RMS; with nothing before there is nothing to shrink.
static double log_ratio(double after, double before)
{
    return before > 0 ? 0.5 * log(fmax(after / before, least_ratio)) : 0;
}

/// Standard error of log_ratio over the whole, from leaving out one stretch at a time.
static double jackknife(const double* after, const double* before, double all_after, double all_before)
{
    const double count = FORECAST_STRETCHES;
    double sum = 0;
    double squares = 0;
    for (size_t s = 0; s < FORECAST_STRETCHES; s++) {
        const double without = log_ratio(all_after - after[s], all_before - before[s]);
        sum += without;
        squares += without * without;
    }
    return sqrt(fmax((count - 1) / count * (squares - sum * sum / count), 0));
}

forecast_t forecast_shrink(const double* after, const double* before, size_t count)
{
    double a[FORECAST_STRETCHES] = {0};
    double b[FORECAST_STRETCHES] = {0};
    double sum_a = 0;
    double sum_b = 0;
    double best = HUGE_VAL;
    double worst = -HUGE_VAL;
    for (size_t i = 0; i < count; i++) {
        a[i * FORECAST_STRETCHES / count] += after[i];
        b[i * FORECAST_STRETCHES / count] += before[i];
        sum_a += after[i];
        sum_b += before[i];
        best = fmin(best, log_ratio(after[i], before[i]));
        worst = fmax(worst, log_ratio(after[i], before[i]));
    }
    if (!(sum_b > 0)) {
        return (forecast_t){0};
    }
    const double middle = log_ratio(sum_a, sum_b);
    const double reach = student * sqrt(2) * jackknife(a, b, sum_a, sum_b);
    return (forecast_t){.shrink = 1 - exp(middle),
                        .low = 1 - exp(fmax(fmin(middle + reach, worst), middle)),
                        .high = 1 - exp(fmin(fmax(middle - reach, best), middle))};
}
