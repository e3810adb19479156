#include "diagnose_where.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Stretches that are resampled for the shares' intervals, and how often.
enum { STRETCHES = 24, RESAMPLES = 200 };

/// A sample on one axis with its energy above the noise.
typedef struct {
    double at;
    double energy;
    size_t stretch;
} entry_t;

const char* where_axis_name(axis_t axis)
{
    switch (axis) {
    case AXIS_TIME:
        return "time";
    case AXIS_INPUT:
        return "input";
    case AXIS_OUTPUT:
        return "output";
    case AXIS_RATE:
        return "rate";
    case AXIS_SINCE_REVERSAL:
        return "since_reversal";
    case AXIS_DEPTH:
        return "depth";
    case AXIS_FREQUENCY:
        return "frequency";
    case AXIS_DIRECTION:
    case NUM_AXES:
        break;
    }
    return "direction";
}

/// d input / dt over a few samples around t, so that a quantised command still has a rate.
static double rate_at(const effect_run_t* run, size_t t)
{
    const size_t before = t > 2 ? t - 2 : 0;
    const size_t after = t + 2 < run->num_samples ? t + 2 : run->num_samples - 1;
    return (run->input[after] - run->input[before]) / (run->time[after] - run->time[before]);
}

/// Direction of each sample's move: 1, -1, or 0 where the input holds.
static void directions(const effect_run_t* run, double* direction)
{
    double largest = 0;
    for (size_t t = 0; t < run->num_samples; t++) {
        largest = fmax(largest, fabs(rate_at(run, t)));
    }
    for (size_t t = 0; t < run->num_samples; t++) {
        const double rate = rate_at(run, t);
        direction[t] = fabs(rate) <= 1e-3 * largest ? 0 : rate > 0 ? 1 : -1;
    }
}

/// Seconds since the input last turned, and how many turning points are still open around the present move:
/// an excursion past an older turning point closes (wipes out) the loop that began there.
static void reversals(const effect_run_t* run, double* since, double* depth)
{
    double* open = xmalloc((run->num_samples + 1) * sizeof *open);
    size_t count = 1;
    open[0] = run->input[0];
    double last = run->time[0];
    double sign = 0;
    for (size_t t = 0; t < run->num_samples; t++) {
        const double step = t > 0 ? run->input[t] - run->input[t - 1] : 0;
        const double now = step > 0 ? 1 : step < 0 ? -1 : sign;
        if (now * sign < 0) {
            open[count++] = run->input[t - 1];
            last = run->time[t - 1];
        }
        sign = now;
        while (count > 2 && sign * (run->input[t] - open[count - 2]) >= 0) {
            count -= 2;
        }
        since[t] = run->time[t] - last;
        depth[t] = (double)(count - 1);
    }
    free(open);
}

static int by_place(const void* a, const void* b)
{
    const double x = ((const entry_t*)a)->at;
    const double y = ((const entry_t*)b)->at;
    return (x > y) - (x < y);
}

static size_t stretch_of(size_t t, size_t num_samples)
{
    return t * STRETCHES / num_samples;
}

/// The interval of sorted entries whose share of the energy exceeds its share of the samples the most: the
/// largest sum of a run of (energy / total - 1 / n).
static void best_run(const entry_t* entry, size_t n, double total, size_t* first, size_t* last)
{
    double best = -HUGE_VAL;
    double sum = 0;
    size_t begin = 0;
    *first = 0;
    *last = n - 1;
    for (size_t i = 0; i < n; i++) {
        if (sum <= 0) {
            sum = 0;
            begin = i;
        }
        sum += entry[i].energy / total - 1.0 / (double)n;
        const bool boundary = i + 1 == n || entry[i + 1].at > entry[i].at;
        if (boundary && sum > best) {
            best = sum;
            *first = begin;
            *last = i;
        }
    }
    while (*first > 0 && entry[*first - 1].at >= entry[*first].at) {
        --*first;
    }
}

/// The share's 90 % interval when the record's stretches are drawn anew, with replacement.
static void share_interval(const entry_t* entry, size_t n, double from, double to, region_t* region)
{
    double inside[STRETCHES] = {0};
    double whole[STRETCHES] = {0};
    for (size_t i = 0; i < n; i++) {
        whole[entry[i].stretch] += entry[i].energy;
        inside[entry[i].stretch] += entry[i].at >= from && entry[i].at <= to ? entry[i].energy : 0;
    }
    double share[RESAMPLES];
    unsigned long long seed = 20150757;
    for (size_t r = 0; r < RESAMPLES; r++) {
        double a = 0;
        double b = 0;
        for (size_t s = 0; s < STRETCHES; s++) {
            seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
            const size_t drawn = (size_t)((seed >> 33) % STRETCHES);
            a += inside[drawn];
            b += whole[drawn];
        }
        share[r] = b > 0 ? fmin(fmax(a / b, 0), 1) : 0;
        for (size_t k = r; k > 0 && share[k] < share[k - 1]; k--) {
            const double swap = share[k];
            share[k] = share[k - 1];
            share[k - 1] = swap;
        }
    }
    region->share_low = share[RESAMPLES / 20];
    region->share_high = share[RESAMPLES - 1 - RESAMPLES / 20];
}

static bool find_region(entry_t* entry, size_t n, axis_t axis, region_t* region)
{
    double total = 0;
    for (size_t i = 0; i < n; i++) {
        total += entry[i].energy;
    }
    if (!(total > 0)) {
        return false;
    }
    qsort(entry, n, sizeof *entry, by_place);
    size_t first;
    size_t last;
    best_run(entry, n, total, &first, &last);
    double sum = 0;
    for (size_t i = first; i <= last; i++) {
        sum += entry[i].energy;
    }
    *region = (region_t){.axis = axis, .from = entry[first].at, .to = entry[last].at};
    region->share = fmin(fmax(sum / total, 0), 1);
    region->lift = region->share * (double)n / (double)(last - first + 1);
    share_interval(entry, n, region->from, region->to, region);
    return true;
}

/// How much a region says: what it holds beyond its part of the samples, counted with the interval's lower
/// end.
static double telling(const region_t* region)
{
    return region->share_low - region->share / region->lift;
}

static int by_telling(const void* a, const void* b)
{
    const double x = telling(a);
    const double y = telling(b);
    return (x < y) - (x > y);
}

static size_t find_direction(const double* direction, const double* energy, size_t n, region_t* region)
{
    size_t count = 0;
    entry_t* entry = xmalloc(n * sizeof *entry);
    double total = 0;
    for (size_t t = 0; t < n; t++) {
        entry[t] = (entry_t){direction[t], energy[t], stretch_of(t, n)};
        total += energy[t];
    }
    for (int d = -1; d <= 1 && total > 0; d++) {
        double sum = 0;
        size_t samples = 0;
        for (size_t t = 0; t < n; t++) {
            const bool here = lround(direction[t]) == d;
            sum += here ? energy[t] : 0;
            samples += here;
        }
        if (samples > 0) {
            region_t* r = &region[count++];
            *r = (region_t){
                .axis = AXIS_DIRECTION, .from = d, .to = d, .share = fmin(fmax(sum / total, 0), 1)};
            r->lift = r->share * (double)n / (double)samples;
            share_interval(entry, n, d - 0.5, d + 0.5, r);
        }
    }
    free(entry);
    return count;
}

size_t where_find(const effect_run_t* run, const double* output, const double* gap, double noise,
                  region_t* region)
{
    const size_t n = run->num_samples;
    double* work = xmalloc(4 * n * sizeof *work);
    double* since = work;
    double* depth = since + n;
    double* direction = depth + n;
    double* energy = direction + n;
    entry_t* entry = xmalloc(n * sizeof *entry);
    reversals(run, since, depth);
    directions(run, direction);
    for (size_t t = 0; t < n; t++) {
        energy[t] = gap[t] * gap[t] - noise * noise;
    }
    size_t count = 0;
    for (int axis = AXIS_TIME; axis <= AXIS_DEPTH; axis++) {
        for (size_t t = 0; t < n; t++) {
            const double at[] = {run->time[t],          run->input[t], output[t],
                                 fabs(rate_at(run, t)), since[t],      depth[t]};
            entry[t] = (entry_t){at[axis], energy[t], stretch_of(t, n)};
        }
        count += find_region(entry, n, (axis_t)axis, &region[count]);
    }
    count += find_direction(direction, energy, n, &region[count]);
    free(entry);
    free(work);
    qsort(region, count, sizeof *region, by_telling);
    return count;
}

void where_describe(const region_t* region, const char* input_unit, const char* output_unit, char* text,
                    size_t size)
{
    const double percent = 100 * region->share;
    switch (region->axis) {
    case AXIS_TIME:
        snprintf(text, size, "%.0f %% of the gap sits between %.4g s and %.4g s", percent, region->from,
                 region->to);
        break;
    case AXIS_INPUT:
        snprintf(text, size, "%.0f %% of the gap sits at inputs from %.4g to %.4g %s", percent, region->from,
                 region->to, input_unit);
        break;
    case AXIS_OUTPUT:
        snprintf(text, size, "%.0f %% of the gap sits at outputs from %.4g to %.4g %s", percent, region->from,
                 region->to, output_unit);
        break;
    case AXIS_RATE:
        snprintf(text, size, "%.0f %% of the gap sits where the input moves at %.4g to %.4g %s/s", percent,
                 region->from, region->to, input_unit);
        break;
    case AXIS_SINCE_REVERSAL:
        snprintf(text, size, "%.0f %% of the gap sits %.3g to %.3g s after a reversal", percent, region->from,
                 region->to);
        break;
    case AXIS_DEPTH:
        snprintf(text, size, "%.0f %% of the gap sits in loops nested %.0f to %.0f deep", percent,
                 region->from, region->to);
        break;
    case AXIS_FREQUENCY:
        snprintf(text, size, "%.0f %% of the gap sits at %.4g to %.4g Hz", percent, region->from, region->to);
        break;
    case AXIS_DIRECTION:
    case NUM_AXES:
        snprintf(text, size, "%.0f %% of the gap sits where the input is %s", percent,
                 region->from > 0   ? "ascending"
                 : region->from < 0 ? "descending"
                                    : "holding");
        break;
    }
}
