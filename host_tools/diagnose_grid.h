/// The converter's steps, found in a record's own values.
#ifndef HYST_HOST_DIAGNOSE_GRID_H
#define HYST_HOST_DIAGNOSE_GRID_H

#include <stddef.h>

typedef struct {
    double step;   ///< 0: no grid found
    double offset; ///< one of the levels
} grid_step_t;

/// The grid that all values lie on, when there are far fewer levels than values and most neighbouring levels
/// are one step apart, give or take a quarter (converters' codes are of uneven width).
grid_step_t grid_step_of(const double* values, size_t num_values);

#endif
