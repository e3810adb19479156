#include "diagnose_where.h"

#include "where_band.h"
#include "where_region.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    const double x = ((const place_t*)a)->at;
    const double y = ((const place_t*)b)->at;
    return (x > y) - (x < y);
}

static void set_interval(const place_t* place, size_t n, double from, double to, region_t* region)
{
    double inside[WHERE_STRETCHES] = {0};
    double whole[WHERE_STRETCHES] = {0};
    for (size_t i = 0; i < n; i++) {
        whole[place[i].stretch] += place[i].energy;
        inside[place[i].stretch] += place[i].at >= from && place[i].at <= to ? place[i].energy : 0;
    }
    where_set_interval(inside, whole, region);
}

static bool find_region(place_t* place, size_t n, axis_t axis, region_t* region)
{
    size_t first;
    size_t last;
    qsort(place, n, sizeof *place, by_place);
    if (!where_best_region(place, n, axis, region, &first, &last)) {
        return false;
    }
    set_interval(place, n, region->from, region->to, region);
    return true;
}

/// How much a region says: what it holds beyond what any gap would have there, counted with the interval's
/// lower end.
static double telling(const region_t* region)
{
    return region->share_low - region->ordinary;
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
    place_t* place = xmalloc(n * sizeof *place);
    double total = 0;
    for (size_t t = 0; t < n; t++) {
        place[t] = (place_t){direction[t], energy[t], where_stretch(t, n)};
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
            r->ordinary = (double)samples / (double)n;
            r->lift = r->share / r->ordinary;
            set_interval(place, n, d - 0.5, d + 0.5, r);
        }
    }
    free(place);
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
    place_t* place = xmalloc(n * sizeof *place);
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
            place[t] = (place_t){at[axis], energy[t], where_stretch(t, n)};
        }
        count += find_region(place, n, (axis_t)axis, &region[count]);
    }
    count += where_find_band(run, output, gap, noise, &region[count]);
    count += find_direction(direction, energy, n, &region[count]);
    free(place);
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
