/// Lines of a series' least-squares spectrum (Lomb 1976), at any sample times.
#ifndef HYST_HOST_SINUSOID_H
#define HYST_HOST_SINUSOID_H

#include <stddef.h>

/// sine * sin(2 pi frequency t) + cosine * cos(2 pi frequency t), t the given times.
typedef struct {
    double frequency, sine, cosine;
} sinusoid_t;

/// The strongest line from four periods a record on. step: the times' median step, which sets the highest,
/// half its inverse, or where samples are missing num_samples over the duration if that is less (spectrum.h):
/// in a thinned record faster lines are not found.
sinusoid_t strongest_sinusoid(const double* time, double step, const double* series, size_t num_samples);
/// Least-squares amplitudes at the line's frequency, the series' mean left out; returns the energy that they
/// explain.
double sinusoid_fit(const double* time, const double* series, size_t num_samples, sinusoid_t* line);
/// The part of the series' variance, 0 ... 1, in the line of this frequency.
double sinusoid_share(const double* time, const double* series, size_t num_samples, double frequency);

#endif
