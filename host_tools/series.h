/// Sums over series of numbers.
#ifndef HYST_HOST_SERIES_H
#define HYST_HOST_SERIES_H

#include <stdbool.h>
#include <stddef.h>

/// Moves the values of the samples that are not carried (record.h) to the front; returns how many.
size_t series_drop_carried(const bool* carried, double* values, size_t count);
double series_sum(const double* values, size_t count);
double series_mean(const double* values, size_t count);
/// Mean square of the difference.
double series_mean_square(const double* a, const double* b, size_t count);
/// The greatest value less the least.
double series_span(const double* values, size_t count);
/// How many neighbouring values count as one independent: 1 + 2 sum of their autocorrelation, to where that
/// has died out.
double series_correlation(const double* values, size_t count);

#endif
