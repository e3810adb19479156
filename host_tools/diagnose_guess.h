/// Where a search begins with parameters that no gradient leads to.
#ifndef HYST_HOST_DIAGNOSE_GUESS_H
#define HYST_HOST_DIAGNOSE_GUESS_H

#include "diagnose_hypothesis.h"

/// Into the use's parameters: the frequency of a disturbance, from the spectrum of what `predicted` leaves of
/// the gap's output, or of a mode; or how what is left follows a column. Returns whether it is such an
/// effect.
bool guess_parameters(const gap_t* gap, const double* predicted, effect_use_t* use);

#endif
