#include "where_band.h"

#include "model.h"
#include "spectrum.h"
#include "where_region.h"
#include <math.h>
#include <stdlib.h>

/// Part of the output's energy about its mean that lies in the bins first ... last.
static double output_part(const effect_run_t* run, const double* output, size_t first, size_t last)
{
    spectrum_t spectrum = spectrum_new(run->time, run->sample_time, output, run->num_samples);
    spectrum.mean = 0;
    double inside = 0;
    double whole = 0;
    for (size_t k = 0; k < spectrum.num_bins; k++) {
        const double energy = spectrum_energy(&spectrum, k);
        inside += k >= first && k <= last ? energy : 0;
        whole += energy;
    }
    spectrum_free(&spectrum);
    return whole > 0 ? inside / whole : 0;
}

/// The share's interval: the gap's part in the band as a course over time, stretch by stretch.
static void set_interval(const spectrum_t* spectrum, double noise, size_t first, size_t last,
                         region_t* region)
{
    const size_t n = spectrum->num_samples;
    double* part = xmalloc(2 * n * sizeof *part);
    double* all = part + n;
    spectrum_band(spectrum, first, last, part);
    spectrum_band(spectrum, 0, spectrum->num_bins - 1, all);
    double noise_inside = 0;
    double noise_whole = 0;
    for (size_t k = 0; k < spectrum->num_bins; k++) {
        const double expected = spectrum_noise(spectrum, noise, k) / (double)n;
        noise_inside += k >= first && k <= last ? expected : 0;
        noise_whole += expected;
    }
    double inside[WHERE_STRETCHES] = {0};
    double whole[WHERE_STRETCHES] = {0};
    for (size_t t = 0; t < n; t++) {
        inside[where_stretch(t, n)] += part[t] * part[t] - noise_inside;
        whole[where_stretch(t, n)] += all[t] * all[t] - noise_whole;
    }
    where_set_interval(inside, whole, region);
    free(part);
}

size_t where_find_band(const effect_run_t* run, const double* output, const double* gap, double noise,
                       region_t* region)
{
    spectrum_t spectrum = spectrum_new(run->time, run->sample_time, gap, run->num_samples);
    place_t* place = xmalloc(spectrum.num_bins * sizeof *place);
    for (size_t k = 0; k < spectrum.num_bins; k++) {
        place[k] = (place_t){.at = spectrum.resolution * (double)k,
                             .energy = spectrum_energy(&spectrum, k) - spectrum_noise(&spectrum, noise, k)};
    }
    size_t first;
    size_t last;
    const bool found = where_best_region(place, spectrum.num_bins, AXIS_FREQUENCY, region, &first, &last);
    if (found) {
        // A bin stands for what is nearer to it than to its neighbours.
        region->from = fmax(region->from - 0.5 * spectrum.resolution, 0);
        region->to = fmin(region->to + 0.5 * spectrum.resolution, 0.5 / spectrum.step);
        region->ordinary = fmax(region->ordinary, output_part(run, output, first, last));
        set_interval(&spectrum, noise, first, last, region);
    }
    free(place);
    spectrum_free(&spectrum);
    return found ? 1 : 0;
}
