/// How sure a ratio of two sums over the stretches of a record is.
#ifndef HYST_HOST_RESAMPLE_H
#define HYST_HOST_RESAMPLE_H

#include <stddef.h>

typedef struct {
    double low, high;
} interval_t;

/// The 90 % interval of sum(part) / sum(whole) when the `count` stretches, at least one, are drawn anew with
/// replacement; `otherwise` is the ratio of a draw whose whole is not above 0. The same numbers each time.
interval_t resample_ratio(const double* part, const double* whole, size_t count, double otherwise);

#endif
