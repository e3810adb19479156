/// The band of frequencies that holds most of the gap.
#ifndef HYST_HOST_WHERE_BAND_H
#define HYST_HOST_WHERE_BAND_H

#include "diagnose_where.h"

/// As where_find, for AXIS_FREQUENCY: the number of regions, 0 or 1.
size_t where_find_band(const effect_run_t* run, const double* output, const double* gap, double noise,
                       region_t* region);

#endif
