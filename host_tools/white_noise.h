/// How large the white part of a signal is.
#ifndef HYST_HOST_WHITE_NOISE_H
#define HYST_HOST_WHITE_NOISE_H

#include <stddef.h>

/// Standard deviation of the white part of a signal that is otherwise smooth, from the median of its second
/// differences.
double white_noise(const double* signal, size_t num_samples);

#endif
