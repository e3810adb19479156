/// Where the gap lies: regions of the record, found by the data, that hold more of the gap's energy than of
/// its samples.
#ifndef HYST_HOST_DIAGNOSE_WHERE_H
#define HYST_HOST_DIAGNOSE_WHERE_H

#include "effect.h"

enum { WHERE_MAX_REGIONS = 12 };

typedef enum {
    AXIS_TIME,
    AXIS_INPUT,
    AXIS_OUTPUT,
    AXIS_RATE,           ///< |d input / dt|
    AXIS_SINCE_REVERSAL, ///< [s]
    AXIS_DEPTH,          ///< how many reversals are open around the present move
    AXIS_FREQUENCY,      ///< [Hz]
    AXIS_DIRECTION,      ///< ascending, descending, holding
    NUM_AXES
} axis_t;

typedef struct {
    axis_t axis;
    double from, to; ///< AXIS_DIRECTION: from is -1 descending, 0 holding, 1 ascending
    double share;    ///< part of the gap's energy above the noise that lies in here
    double lift;     ///< share over the region's part of the samples (frequency: of the spectrum)
    double ordinary; ///< part of the samples, for frequency the larger of the parts of the spectrum and of
                     ///< the measured output: a gap that is only like the output sits there too
    double share_low, share_high; ///< 90 % interval of the share over resampled stretches
} region_t;

const char* where_axis_name(axis_t axis);
/// The most telling regions, best first, at most WHERE_MAX_REGIONS; returns how many. gap[num_samples]:
/// measured less modelled; noise: standard deviation of what is not counted.
size_t where_find(const effect_run_t* run, const double* output, const double* gap, double noise,
                  region_t* region);
/// A region in words.
void where_describe(const region_t* region, const char* input_unit, const char* output_unit, char* text,
                    size_t size);

#endif
