/// What a plant feels of a measured column: its course, without the white noise of the sensor that measured
/// it. A temperature's noise is not the material's: followed by a hysteretic part, it would shake it through
/// small reversals that never were.
#ifndef HYST_HOST_COLUMN_COURSE_H
#define HYST_HOST_COLUMN_COURSE_H

#include <stddef.h>

/// The cubic smoothing spline through value[num_samples] at time[num_samples] (strictly increasing), as
/// smooth as is most likely for a course whose slope is a random walk, anew behind each jump. The values
/// themselves where they show no white noise, and where what is taken away is more than a quarter of the
/// course (as RMS about its mean), since that is no slow quantity's sensor. Allocated. Time and memory:
/// num_samples. Sources: C. H. Reinsch, Numer. Math. 10 (1967) 177; G. Wahba, J. R. Stat. Soc. B 40 (1978)
/// 364 (the spline as that walk's estimate).
double* column_course(const double* time, const double* value, size_t num_samples);

#endif
