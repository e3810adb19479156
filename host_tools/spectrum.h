/// The spectrum of a series over time: how its energy, the sum of its squares, is shared out over frequency.
#ifndef HYST_HOST_SPECTRUM_H
#define HYST_HOST_SPECTRUM_H

#include <kiss_fftr.h>
#include <stddef.h>

typedef struct {
    size_t num_samples;  ///< of the series on its even grid
    double step;         ///< of that grid [s]
    double resolution;   ///< [Hz] between two bins
    size_t num_bins;     ///< 0 ... the Nyquist frequency
    size_t length;       ///< of the transform: num_samples and zeros up to a length that transforms fast
    double mean;         ///< of the series; its energy is all in bin 0
    double scale;        ///< of the lines, so that float holds them
    double interpolated; ///< mean square of the weights that samples of the grid take from the record's: 1
                         ///< for an even record, white noise's remaining part otherwise
    kiss_fft_cpx* line;  ///< [num_bins] of the series less its mean, in float
} spectrum_t;

/// time: strictly increasing, num_samples at least 2; step: its median step. An uneven series is brought to
/// an even grid of that step (or a coarser one, of at most twice as many samples) by linear interpolation.
spectrum_t spectrum_new(const double* time, double step, const double* series, size_t num_samples);
void spectrum_free(spectrum_t* spectrum);

double spectrum_energy(const spectrum_t* spectrum, size_t bin);
/// What white noise of standard deviation `noise` on the record's samples is expected to put into the bin.
double spectrum_noise(const spectrum_t* spectrum, double noise, size_t bin);
/// The series' part in the bins first ... last, on the even grid: part[num_samples].
void spectrum_band(const spectrum_t* spectrum, size_t first, size_t last, double* part);

#endif
