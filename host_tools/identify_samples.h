/// Preparing a record for identification: scaling, thinning without losing reversals, and finding out from
/// where on the memory no longer depends on what was before the record.
#ifndef HYST_HOST_IDENTIFY_SAMPLES_H
#define HYST_HOST_IDENTIFY_SAMPLES_H

#include "record.h"
#include <stdbool.h>
#include <stddef.h>

typedef struct {
    size_t num_samples;
    double* u;      ///< [num_samples] scaled input, (v - centre) / half_range
    double* y;      ///< [num_samples]
    bool* measured; ///< [num_samples] or carried (record.h)
    bool* used;     ///< [num_samples] never those that are carried
    size_t* index;  ///< [num_samples] the record's sample that each one is
    size_t wiped;   ///< first sample after both ends of the record's input range were visited
} samples_t;

/// At most about max_samples samples, twice as many where many were put back: of every block of the record
/// the ones with the least and the largest input, in their order, so that the plays see every reversal that
/// matters to them. All that were measured are marked used.
samples_t samples_new(const record_t* record, double centre, double half_range, size_t max_samples);
void samples_free(samples_t* samples);
/// Marks samples from `first` on as used, those before as not.
void samples_use_from(samples_t* samples, size_t first);

/// RMSE below which no model can come whose output never moves against its input: the isotonic regression of
/// each monotone stretch of the input (pool adjacent violators). Every GPI model with p >= 0, increasing
/// envelopes and non-decreasing D is of that kind. Over samples from `first` on.
double monotone_floor(const record_t* record, size_t first);

#endif
