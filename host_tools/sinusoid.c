#include "sinusoid.h"

#include <math.h>

static double mean_of(const double* series, size_t num_samples)
{
    double mean = 0;
    for (size_t t = 0; t < num_samples; t++) {
        mean += series[t] / (double)num_samples;
    }
    return mean;
}

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

sinusoid_t strongest_sinusoid(const double* time, const double* series, size_t num_samples)
{
    enum { MOST_LINES = 1500 };
    const double duration = time[num_samples - 1] - time[0];
    const double mean = mean_of(series, num_samples);
    sinusoid_t best = {0};
    double most = -1;
    const size_t lines = num_samples / 2 < MOST_LINES ? num_samples / 2 : MOST_LINES;
    for (size_t k = 0; k < lines; k++) {
        sinusoid_t line = {.frequency = (4 + 0.5 * (double)k) / duration};
        const double energy = fit_sinusoid(time, series, num_samples, mean, &line);
        if (energy > most) {
            most = energy;
            best = line;
        }
    }
    return best;
}

double sinusoid_share(const double* time, const double* series, size_t num_samples, double frequency)
{
    const double mean = mean_of(series, num_samples);
    double energy = 0;
    for (size_t t = 0; t < num_samples; t++) {
        energy += (series[t] - mean) * (series[t] - mean);
    }
    sinusoid_t line = {.frequency = frequency};
    return energy > 0 ? fit_sinusoid(time, series, num_samples, mean, &line) / energy : 0;
}
