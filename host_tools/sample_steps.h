/// How a record's times go from sample to sample.
#ifndef HYST_HOST_SAMPLE_STEPS_H
#define HYST_HOST_SAMPLE_STEPS_H

#include <stddef.h>

/// The median of the steps between time[num_samples], of a long record of a hundred stretches
/// of a thousand; 1 where there is none.
double sample_time_of(const double* time, size_t num_samples);
/// steps[num_samples], owned: how many sample times lie between a sample and the one before, where up to
/// seven in a row are lost; 1 where none is, after a longer pause, and for times that are no multiples.
/// NULL: every step is 1, there is no time, or more than a quarter would be lost, which is another rate.
unsigned char* sample_steps_new(const double* time, size_t num_samples);

#endif
