#include "diagnose_next.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NEXT_SAMPLES = 4000 };

/// A triangle of period 1 between -1 and 1, from -1 at phase 0.
static double triangle(double phase)
{
    const double part = phase - floor(phase);
    return part < 0.5 ? 4 * part - 1 : 3 - 4 * part;
}

/// Each input over x = 0 ... 1 in -1 ... 1.
static double steps_with_holds(double x)
{
    static const double level[] = {-1, 0.8, -0.4, 0.3, -0.8, 1, 0, 0.6};
    const size_t i = (size_t)(x * 8);
    return level[i < 8 ? i : 7];
}

static double several_speeds(double x)
{
    // The same loop, three times slow, then 3 times and 10 times as fast.
    const double third = 3 * x;
    return third < 1   ? triangle(2 * third)
           : third < 2 ? triangle(6 * (third - 1))
                       : triangle(20 * (third - 2));
}

static double repeated_loops(double x)
{
    return triangle(12 * x);
}

static double sweep(double x)
{
    return -cos(2 * acos(-1) * 40 * x * x);
}

static double several_sizes(double x)
{
    const double cycles = 12 * x;
    return (1 - floor(cycles) / 12) * triangle(cycles);
}

static const struct {
    const char* what;
    double (*shape)(double x);
} shapes[] = {{"steps with long holds", steps_with_holds},
              {"the same loop at several speeds", several_speeds},
              {"the same loop repeated many times at one speed", repeated_loops},
              {"a frequency sweep over the full range", sweep},
              {"loops of several sizes", several_sizes}};

static bool needs_column(const hypothesis_t* hypothesis)
{
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        if (hypothesis->use[i].effect->needs_column) {
            return true;
        }
    }
    return false;
}

static double separation(const gap_t* gap, const hypothesis_t* a, const hypothesis_t* b,
                         const record_t* record)
{
    effect_run_t run = effect_run_new(gap->model, record);
    double* first = xmalloc(2 * record->num_samples * sizeof *first);
    double* second = first + record->num_samples;
    effect_simulate(&run, gap->model, gap->start, a->use, a->num_uses, first);
    effect_simulate(&run, gap->model, gap->start, b->use, b->num_uses, second);
    double sum = 0;
    for (size_t t = 0; t < record->num_samples; t++) {
        sum += (first[t] - second[t]) * (first[t] - second[t]);
    }
    free(first);
    effect_run_free(&run);
    return sqrt(sum / (double)record->num_samples);
}

next_input_t next_input_find(const gap_t* gap, const hypothesis_t* a, const hypothesis_t* b)
{
    next_input_t next = {.what = "", .num_samples = NEXT_SAMPLES};
    if (needs_column(a) || needs_column(b)) {
        next.what = "the same loop repeated while the auxiliary column changes";
    }
    next.time = xmalloc(NEXT_SAMPLES * sizeof *next.time);
    next.input = xmalloc(NEXT_SAMPLES * sizeof *next.input);
    double* trial = xmalloc(NEXT_SAMPLES * sizeof *trial);
    const double centre = 0.5 * (gap->model->input_min + gap->model->input_max);
    const double half = 0.5 * (gap->model->input_max - gap->model->input_min);
    for (size_t t = 0; t < NEXT_SAMPLES; t++) {
        next.time[t] = gap->run->duration * (double)t / (NEXT_SAMPLES - 1);
        next.input[t] = centre + half * repeated_loops((double)t / NEXT_SAMPLES);
    }
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes && !needs_column(a) && !needs_column(b); k++) {
        for (size_t t = 0; t < NEXT_SAMPLES; t++) {
            trial[t] = centre + half * shapes[k].shape((double)t / NEXT_SAMPLES);
        }
        const record_t record = {.num_samples = NEXT_SAMPLES, .time = next.time, .input = trial};
        const double distance = separation(gap, a, b, &record);
        if (distance > next.separation) {
            next.separation = distance;
            next.what = shapes[k].what;
            memcpy(next.input, trial, NEXT_SAMPLES * sizeof *trial);
        }
    }
    free(trial);
    return next;
}

void next_input_free(next_input_t* next)
{
    free(next->time);
    free(next->input);
    *next = (next_input_t){0};
}
