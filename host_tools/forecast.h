/// How far an effect's model will shrink the gap on other work of the machine, from what it left of one
/// record.
#ifndef HYST_HOST_FORECAST_H
#define HYST_HOST_FORECAST_H

#include <stddef.h>

/// Contiguous parts of a record that count as independent: work comes in a few kinds, each of its own
/// stretch.
enum { FORECAST_STRETCHES = 4 };

/// 1 - RMS after / RMS before, and a 90 % prediction interval for a record as long as this one.
typedef struct {
    double shrink, low, high;
} forecast_t;

/// after, before: [count] sums of squares of neighbouring pieces of a record, at least FORECAST_STRETCHES.
/// The logarithm of the ratio of the two RMS is taken as normal from record to record, its variance as the
/// jackknife's over the stretches; two records differ by the square root of two more than one from its mean.
/// No mixture of pieces like these shrinks more than the best nor less than the worst of them, which bounds
/// the interval. Where nothing stands before there is nothing to shrink: all 0.
forecast_t forecast_shrink(const double* after, const double* before, size_t count);

#endif
