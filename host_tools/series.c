#include "series.h"

#include <math.h>

size_t series_drop_carried(const bool* carried, double* values, size_t count)
{
    size_t kept = 0;
    for (size_t t = 0; t < count; t++) {
        if (carried == NULL || !carried[t]) {
            values[kept++] = values[t];
        }
    }
    return kept;
}

double series_sum(const double* values, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += values[i];
    }
    return sum;
}

double series_mean(const double* values, size_t count)
{
    // Each value's part by itself: large values' sum may be beyond a double.
    double mean = 0;
    for (size_t i = 0; i < count; i++) {
        mean += values[i] / (double)count;
    }
    return mean;
}

double series_mean_square(const double* a, const double* b, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return sum / (double)count;
}

double series_span(const double* values, size_t count)
{
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    return high - low;
}

double series_correlation(const double* values, size_t count)
{
    double energy = 0;
    for (size_t t = 0; t < count; t++) {
        energy += values[t] * values[t];
    }
    double sum = 1;
    for (size_t lag = 1; lag < count / 10; lag++) {
        double product = 0;
        for (size_t t = lag; t < count; t++) {
            product += values[t] * values[t - lag];
        }
        if (!(product > 0.05 * energy)) {
            break;
        }
        sum += 2 * product / energy;
    }
    return sum;
}
