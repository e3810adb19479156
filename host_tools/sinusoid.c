#include "sinusoid.h"

#include "series.h"
#include "spectrum.h"
#include <math.h>

/// Least-squares amplitudes at one frequency, the mean left out; the energy they explain.
static double fit_sinusoid(const double* time, const double* series, size_t n, double mean, sinusoid_t* line)
{
    double ss = 0;
    double cc = 0;
    double sc = 0;
    double ys = 0;
    double yc = 0;
    for (size_t t = 0; t < n; t++) {
        const double phase = 2 * acos(-1) * line->frequency * time[t];
        const double s = sin(phase);
        const double c = cos(phase);
        const double y = series[t] - mean;
        ss += s * s;
        cc += c * c;
        sc += s * c;
        ys += y * s;
        yc += y * c;
    }
    const double determinant = ss * cc - sc * sc;
    if (!(determinant > 0)) {
        return 0;
    }
    line->sine = (ys * cc - yc * sc) / determinant;
    line->cosine = (yc * ss - ys * sc) / determinant;
    return line->sine * ys + line->cosine * yc;
}

/// The bin from which on two neighbours hold the most: a line between two bins is in both.
static size_t strongest_bin(const spectrum_t* spectrum, double least_frequency)
{
    size_t best = 0;
    double most = -1;
    for (size_t bin = 1; bin + 1 < spectrum->num_bins; bin++) {
        const double energy = spectrum_energy(spectrum, bin) + spectrum_energy(spectrum, bin + 1);
        if (((double)bin + 0.5) * spectrum->resolution >= least_frequency && energy > most) {
            most = energy;
            best = bin;
        }
    }
    return best;
}

sinusoid_t strongest_sinusoid(const double* time, double step, const double* series, size_t num_samples)
{
    spectrum_t spectrum = spectrum_new(time, step, series, num_samples);
    const double least = 4 / (time[num_samples - 1] - time[0]);
    const double bin = (double)strongest_bin(&spectrum, least);
    const double mean = series_mean(series, num_samples);
    double low = fmax((bin - 0.5) * spectrum.resolution, least);
    double high = fmax((bin + 1.5) * spectrum.resolution, least);
    spectrum_free(&spectrum);
    // Within a line's width its energy has one maximum. 22 thirds leave 3e-4 of the width.
    for (int i = 0; i < 22; i++) {
        sinusoid_t left = {.frequency = low + (high - low) / 3};
        sinusoid_t right = {.frequency = high - (high - low) / 3};
        if (fit_sinusoid(time, series, num_samples, mean, &left) <
            fit_sinusoid(time, series, num_samples, mean, &right)) {
            low = left.frequency;
        } else {
            high = right.frequency;
        }
    }
    sinusoid_t line = {.frequency = 0.5 * (low + high)};
    (void)fit_sinusoid(time, series, num_samples, mean, &line);
    return line;
}

double sinusoid_fit(const double* time, const double* series, size_t num_samples, sinusoid_t* line)
{
    return fit_sinusoid(time, series, num_samples, series_mean(series, num_samples), line);
}

double sinusoid_share(const double* time, const double* series, size_t num_samples, double frequency)
{
    const double mean = series_mean(series, num_samples);
    double energy = 0;
    for (size_t t = 0; t < num_samples; t++) {
        energy += (series[t] - mean) * (series[t] - mean);
    }
    sinusoid_t line = {.frequency = frequency};
    return energy > 0 ? fit_sinusoid(time, series, num_samples, mean, &line) / energy : 0;
}
