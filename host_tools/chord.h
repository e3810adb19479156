/// How far a chord lies from its curve.
#ifndef HYST_HOST_CHORD_H
#define HYST_HOST_CHORD_H

#include "model.h"

/// The largest |curve - chord| over [low, high], low < high, for the chord through the curve's ends: found at
/// the inner knots of a table, and where a tanh has the chord's slope. Includes the rounding of its own
/// evaluation.
double chord_error(const curve_t* curve, double low, double high);

#endif
