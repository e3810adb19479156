#include "white_noise.h"

#include "model.h"
#include <math.h>
#include <stdlib.h>

static int by_value(const void* a, const void* b)
{
    const double x = *(const double*)a;
    const double y = *(const double*)b;
    return (x > y) - (x < y);
}

double white_noise(const double* signal, size_t num_samples)
{
    if (num_samples < 5) {
        return 0;
    }
    const size_t n = num_samples - 2;
    double* magnitude = xmalloc(n * sizeof *magnitude);
    for (size_t t = 0; t < n; t++) {
        magnitude[t] = fabs(signal[t] - 2 * signal[t + 1] + signal[t + 2]);
    }
    qsort(magnitude, n, sizeof *magnitude, by_value);
    const double median = magnitude[n / 2];
    free(magnitude);
    // The median of |N(0, s)| is 0.6745 s; second differences of white noise have 6 times its variance.
    return median / 0.6745 / sqrt(6);
}
