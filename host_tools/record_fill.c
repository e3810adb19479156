#include "record_fill.h"

#include "model.h"
#include "sample_steps.h"
#include <math.h>
#include <stdlib.h>

static size_t count_filled(const unsigned char* steps, size_t num_samples)
{
    size_t count = 0;
    for (size_t t = 0; t < num_samples; t++) {
        count += steps[t];
    }
    return count;
}

/// Replaces *series by one with the lost samples, each on the line between its neighbours.
static void fill_series(double** series, const unsigned char* steps, size_t num_samples, size_t num_filled)
{
    if (*series == NULL) {
        return;
    }
    double* filled = xmalloc(num_filled * sizeof *filled);
    const double* value = *series;
    filled[0] = value[0];
    for (size_t t = 1, k = 1; t < num_samples; t++) {
        for (unsigned step = 1; step < steps[t]; step++) {
            filled[k++] = value[t - 1] + (value[t] - value[t - 1]) * step / steps[t];
        }
        filled[k++] = value[t];
    }
    free(*series);
    *series = filled;
}

static void fill_carried(bool** carried, const unsigned char* steps, size_t num_samples, size_t num_filled)
{
    bool* filled = xmalloc(num_filled * sizeof *filled);
    for (size_t t = 0, k = 0; t < num_samples; t++) {
        for (unsigned step = 1; step < steps[t]; step++) {
            filled[k++] = true;
        }
        filled[k++] = *carried != NULL && (*carried)[t];
    }
    free(*carried);
    *carried = filled;
}

static double parabola(double near, double middle, double far)
{
    return 3 * (near - middle) + far;
}

/// The lost sample between x[-1] and x[1], three known ones on either side of it. It lies on the course
/// before the turn or on the one behind it, so on neither's far side, and no further beyond its neighbours
/// than a step, however noisy they are.
static double turning_point(const double* x)
{
    const double before = x[-1] - x[-2];
    const double behind = x[2] - x[1];
    const double way = copysign(1, before);
    const double there = way * fmin(way * parabola(x[-1], x[-2], x[-3]), way * parabola(x[1], x[2], x[3]));
    const double furthest = way * fmax(way * x[-1], way * x[1]) + way * fmax(fabs(before), fabs(behind));
    const double nearest = way * fmin(way * x[-1], way * x[1]);
    return way * fmin(fmax(way * there, way * nearest), way * furthest);
}

static bool is_turn(const double* x)
{
    return (x[-1] - x[-2]) * (x[2] - x[1]) < 0;
}

/// steps: of the record before it was filled, where `input` has its lost samples already.
static void fill_turns(double* input, const unsigned char* steps, size_t num_samples)
{
    for (size_t t = 1, k = 1; t < num_samples; k += steps[t], t++) {
        // k: where the samples after t - 1 begin.
        const bool is_alone = steps[t] == 2 && t >= 3 && t + 2 < num_samples && steps[t - 1] == 1 &&
                              steps[t - 2] == 1 && steps[t + 1] == 1 && steps[t + 2] == 1;
        if (is_alone && is_turn(&input[k])) {
            input[k] = turning_point(&input[k]);
        }
    }
}

void record_fill(record_t* record)
{
    const size_t n = record->num_samples;
    unsigned char* steps = sample_steps_new(record->time, n);
    if (steps == NULL) {
        return;
    }
    const size_t num_filled = count_filled(steps, n);
    fill_carried(&record->carried, steps, n, num_filled);
    fill_series(&record->time, steps, n, num_filled);
    fill_series(&record->input, steps, n, num_filled);
    fill_series(&record->output, steps, n, num_filled);
    for (size_t c = 0; c < record->num_auxiliary; c++) {
        fill_series(&record->auxiliary[c].value, steps, n, num_filled);
    }
    if (record->input != NULL) {
        fill_turns(record->input, steps, n);
    }
    record->num_samples = num_filled;
    free(steps);
}
