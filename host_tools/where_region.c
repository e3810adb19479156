#include "where_region.h"

#include "resample.h"
#include <math.h>

size_t where_stretch(size_t t, size_t num_samples)
{
    return t * WHERE_STRETCHES / num_samples;
}

/// The largest sum of a run of (energy / total - 1 / count); places at the same value stay together.
static void best_run(const place_t* place, size_t count, double total, size_t* first, size_t* last)
{
    double best = -HUGE_VAL;
    double sum = 0;
    size_t begin = 0;
    *first = 0;
    *last = count - 1;
    for (size_t i = 0; i < count; i++) {
        if (sum <= 0) {
            sum = 0;
            begin = i;
        }
        sum += place[i].energy / total - 1.0 / (double)count;
        const bool boundary = i + 1 == count || place[i + 1].at > place[i].at;
        if (boundary && sum > best) {
            best = sum;
            *first = begin;
            *last = i;
        }
    }
    while (*first > 0 && place[*first - 1].at >= place[*first].at) {
        --*first;
    }
}

bool where_best_region(const place_t* place, size_t count, axis_t axis, region_t* region, size_t* first,
                       size_t* last)
{
    double total = 0;
    for (size_t i = 0; i < count; i++) {
        total += place[i].energy;
    }
    if (!(total > 0)) {
        return false;
    }
    best_run(place, count, total, first, last);
    double sum = 0;
    for (size_t i = *first; i <= *last; i++) {
        sum += place[i].energy;
    }
    *region = (region_t){.axis = axis, .from = place[*first].at, .to = place[*last].at};
    region->share = fmin(fmax(sum / total, 0), 1);
    region->ordinary = (double)(*last - *first + 1) / (double)count;
    region->lift = region->share / region->ordinary;
    return true;
}

void where_set_interval(const double inside[WHERE_STRETCHES], const double whole[WHERE_STRETCHES],
                        region_t* region)
{
    const interval_t interval = resample_ratio(inside, whole, WHERE_STRETCHES, 0);
    region->share_low = fmin(fmax(interval.low, 0), 1);
    region->share_high = fmin(fmax(interval.high, 0), 1);
}
