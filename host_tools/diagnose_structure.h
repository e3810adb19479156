/// What a flexible predictor still finds in a residual: the test for causes that no named effect covers.
#ifndef HYST_HOST_DIAGNOSE_STRUCTURE_H
#define HYST_HOST_DIAGNOSE_STRUCTURE_H

#include "diagnose_hypothesis.h"

/// The part of residual[num_samples]'s energy, 0 ... 1, that a ridge regression on lagged inputs and outputs,
/// rates, plays' states, powers and time predicts on stretches it has not seen. 0: nothing.
double structure_found(const gap_t* gap, const double* predicted, const double* residual);
/// Standard deviation of the white part of a signal that is otherwise smooth, from the median of its second
/// differences.
double white_noise(const double* signal, size_t num_samples);

#endif
