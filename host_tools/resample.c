#include "resample.h"

#include <stdlib.h>

enum { RESAMPLES = 400 };

static int by_value(const void* a, const void* b)
{
    const double x = *(const double*)a;
    const double y = *(const double*)b;
    return (x > y) - (x < y);
}

interval_t resample_ratio(const double* part, const double* whole, size_t count, double otherwise)
{
    double ratio[RESAMPLES];
    unsigned long long seed = 20150757;
    for (size_t r = 0; r < RESAMPLES; r++) {
        double a = 0;
        double b = 0;
        for (size_t s = 0; s < count; s++) {
            seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
            // The high bits: a remainder would hang on the low ones, which hardly vary.
            const size_t drawn = (size_t)(((seed >> 33) * count) >> 31);
            a += part[drawn];
            b += whole[drawn];
        }
        ratio[r] = b > 0 ? a / b : otherwise;
    }
    qsort(ratio, RESAMPLES, sizeof *ratio, by_value);
    return (interval_t){ratio[RESAMPLES / 20], ratio[RESAMPLES - 1 - RESAMPLES / 20]};
}
