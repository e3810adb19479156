/// The region of one axis that holds more of the gap's energy than of the axis, and how sure that is.
#ifndef HYST_HOST_WHERE_REGION_H
#define HYST_HOST_WHERE_REGION_H

#include "diagnose_where.h"

/// Stretches of time that are drawn anew for the shares' intervals.
enum { WHERE_STRETCHES = 24 };

/// A sample, or a bin of the spectrum, on an axis.
typedef struct {
    double at;
    double energy; ///< above the noise
    size_t stretch;
} place_t;

/// The stretch of the t-th of num_samples samples.
size_t where_stretch(size_t t, size_t num_samples);
/// The interval of places in order whose share of the energy exceeds its share of the places the most: place
/// *first ... *last. Sets the region but for its interval. False when there is no energy.
bool where_best_region(const place_t* place, size_t count, axis_t axis, region_t* region, size_t* first,
                       size_t* last);
/// The share's interval from the energy inside the region and the whole energy by stretch.
void where_set_interval(const double inside[WHERE_STRETCHES], const double whole[WHERE_STRETCHES],
                        region_t* region);

#endif
