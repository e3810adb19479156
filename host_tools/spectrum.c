#include "spectrum.h"

#include "model.h"
#include <math.h>
#include <stdlib.h>

/// A transform's length is an int.
static const double most_samples = 1 << 27;

/// Chooses the grid; returns whether the record's samples lie on it as they are, to within a twentieth of a
/// step.
static bool choose_grid(const double* time, double step, size_t num_samples, spectrum_t* spectrum)
{
    const double duration = time[num_samples - 1] - time[0];
    const double most = fmin(2 * (double)num_samples, most_samples);
    const double intervals = fmin(round(duration / step), most);
    spectrum->num_samples = (size_t)intervals + 1;
    spectrum->step = duration / intervals;
    double furthest = 0;
    for (size_t t = 0; t < num_samples; t++) {
        furthest = fmax(furthest, fabs(time[t] - time[0] - spectrum->step * (double)t));
    }
    return spectrum->num_samples == num_samples && furthest < 0.05 * spectrum->step;
}

/// even[spectrum->num_samples]
static void interpolate(const double* time, const double* series, size_t num_samples, spectrum_t* spectrum,
                        double* even)
{
    double weights = 0;
    size_t t = 0;
    for (size_t k = 0; k < spectrum->num_samples; k++) {
        const double at = time[0] + spectrum->step * (double)k;
        while (t + 2 < num_samples && time[t + 1] <= at) {
            t++;
        }
        const double part = fmin(fmax((at - time[t]) / (time[t + 1] - time[t]), 0), 1);
        even[k] = (1 - part) * series[t] + part * series[t + 1];
        weights += (1 - part) * (1 - part) + part * part;
    }
    spectrum->interpolated = weights / (double)spectrum->num_samples;
}

static double* even_series(const double* time, double step, const double* series, size_t num_samples,
                           spectrum_t* spectrum)
{
    const bool is_even = choose_grid(time, step, num_samples, spectrum);
    double* even = xmalloc(spectrum->num_samples * sizeof *even);
    if (!is_even) {
        interpolate(time, series, num_samples, spectrum, even);
        return even;
    }
    for (size_t t = 0; t < num_samples; t++) {
        even[t] = series[t];
    }
    spectrum->interpolated = 1;
    return even;
}

/// The mean is a line of its own: zeros behind the series would spread it over the bins beside 0.
static void take_out_mean(spectrum_t* spectrum, double* even)
{
    const double count = (double)spectrum->num_samples;
    for (size_t k = 0; k < spectrum->num_samples; k++) {
        spectrum->mean += even[k] / count;
    }
    for (size_t k = 0; k < spectrum->num_samples; k++) {
        even[k] -= spectrum->mean;
        spectrum->scale = fmax(spectrum->scale, fabs(even[k]));
    }
    spectrum->scale = spectrum->scale > 0 ? spectrum->scale : 1;
}

static kiss_fftr_cfg transform_new(size_t length, bool is_inverse)
{
    size_t size = 0;
    (void)kiss_fftr_alloc((int)length, is_inverse, NULL, &size);
    void* memory = xmalloc(size);
    return kiss_fftr_alloc((int)length, is_inverse, memory, &size);
}

spectrum_t spectrum_new(const double* time, double step, const double* series, size_t num_samples)
{
    spectrum_t spectrum = {0};
    double* even = even_series(time, step, series, num_samples, &spectrum);
    take_out_mean(&spectrum, even);
    spectrum.length = (size_t)kiss_fftr_next_fast_size_real((int)spectrum.num_samples);
    spectrum.num_bins = spectrum.length / 2 + 1;
    spectrum.resolution = 1 / (spectrum.step * (double)spectrum.length);
    float* padded = xcalloc(spectrum.length, sizeof *padded);
    for (size_t k = 0; k < spectrum.num_samples; k++) {
        padded[k] = (float)(even[k] / spectrum.scale);
    }
    spectrum.line = xcalloc(spectrum.num_bins, sizeof *spectrum.line);
    kiss_fftr_cfg transform = transform_new(spectrum.length, false);
    kiss_fftr(transform, padded, spectrum.line);
    free(transform);
    free(padded);
    free(even);
    return spectrum;
}

void spectrum_free(spectrum_t* spectrum)
{
    free(spectrum->line);
    *spectrum = (spectrum_t){0};
}

/// How many of the transform's lines, of either sign of the frequency, the bin stands for.
static double sides(const spectrum_t* spectrum, size_t bin)
{
    return bin == 0 || bin + 1 == spectrum->num_bins ? 1 : 2;
}

double spectrum_energy(const spectrum_t* spectrum, size_t bin)
{
    const double re = spectrum->scale * (double)spectrum->line[bin].r;
    const double im = spectrum->scale * (double)spectrum->line[bin].i;
    const double constant = bin == 0 ? (double)spectrum->num_samples * spectrum->mean * spectrum->mean : 0;
    return constant + sides(spectrum, bin) * (re * re + im * im) / (double)spectrum->length;
}

double spectrum_noise(const spectrum_t* spectrum, double noise, size_t bin)
{
    const double total = noise * noise * spectrum->interpolated * (double)spectrum->num_samples;
    return sides(spectrum, bin) * total / (double)spectrum->length;
}

void spectrum_band(const spectrum_t* spectrum, size_t first, size_t last, double* part)
{
    kiss_fft_cpx* line = xcalloc(spectrum->num_bins, sizeof *line);
    for (size_t k = first; k <= last; k++) {
        line[k] = spectrum->line[k];
    }
    float* series = xcalloc(spectrum->length, sizeof *series);
    kiss_fftr_cfg transform = transform_new(spectrum->length, true);
    kiss_fftri(transform, line, series);
    free(transform);
    const double mean = first == 0 ? spectrum->mean : 0;
    for (size_t k = 0; k < spectrum->num_samples; k++) {
        part[k] = mean + spectrum->scale * (double)series[k] / (double)spectrum->length;
    }
    free(series);
    free(line);
}
