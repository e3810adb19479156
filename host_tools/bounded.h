/// A number between two bounds as an unbounded one, for searches that know no bounds: its place between them,
/// over a sine, so that a bound can be reached.
#ifndef HYST_HOST_BOUNDED_H
#define HYST_HOST_BOUNDED_H

#include <stdbool.h>

typedef struct {
    double low, high;
    bool logarithmic; ///< search its logarithm (low > 0)
} bounds_t;

/// `value` within the bounds, or brought there.
double bounded_to_free(bounds_t bounds, double value);
double bounded_from_free(bounds_t bounds, double free);

#endif
