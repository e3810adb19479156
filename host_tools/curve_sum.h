/// Adding one curve to another.
#ifndef HYST_HOST_CURVE_SUM_H
#define HYST_HOST_CURVE_SUM_H

#include "model.h"

/// Adds factor * other to *curve, where the sum is again a linear, tanh or table curve; false, and nothing
/// changed, where it is not: a tanh with a line, a table or a tanh of other steepness or place.
bool curve_add_curve(curve_t* curve, const curve_t* other, double factor);

/// Whether two curves are the same function, written in the same way.
bool curve_equal(const curve_t* curve, const curve_t* other);

#endif
