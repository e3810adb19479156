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

enum { STEPS, SPEEDS, REPEATED, SWEEP, SIZES };
static const struct {
    const char* what;
    double (*shape)(double x);
} shapes[] = {[STEPS] = {"steps with long holds", steps_with_holds},
              [SPEEDS] = {"the same loop at several speeds", several_speeds},
              [REPEATED] = {"the same loop repeated many times at one speed", repeated_loops},
              [SWEEP] = {"a frequency sweep over the full range", sweep},
              [SIZES] = {"loops of several sizes", several_sizes}};

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
    effect_run_t run = effect_run_new(gap->model, record, true);
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

static void draw_shape(const model_t* model, size_t shape, double* input)
{
    const double centre = 0.5 * (model->input_min + model->input_max);
    const double half = 0.5 * (model->input_max - model->input_min);
    for (size_t t = 0; t < NEXT_SAMPLES; t++) {
        input[t] = centre + half * shapes[shape].shape((double)t / NEXT_SAMPLES);
    }
}

/// As long as the record.
static next_input_t next_of(const gap_t* gap, size_t shape)
{
    next_input_t next = {.what = shapes[shape].what, .num_samples = NEXT_SAMPLES};
    next.time = xmalloc(NEXT_SAMPLES * sizeof *next.time);
    next.input = xmalloc(NEXT_SAMPLES * sizeof *next.input);
    for (size_t t = 0; t < NEXT_SAMPLES; t++) {
        next.time[t] = gap->run->duration * (double)t / (NEXT_SAMPLES - 1);
    }
    draw_shape(gap->model, shape, next.input);
    return next;
}

next_input_t next_input_find(const gap_t* gap, const hypothesis_t* a, const hypothesis_t* b)
{
    next_input_t next = next_of(gap, REPEATED);
    if (needs_column(a) || needs_column(b)) {
        next.what = "the same loop repeated while the auxiliary column changes";
        return next;
    }
    double* trial = xmalloc(NEXT_SAMPLES * sizeof *trial);
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++) {
        draw_shape(gap->model, k, trial);
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

next_input_t next_input_along(const gap_t* gap, axis_t axis)
{
    static const size_t shape[NUM_AXES] = {
        [AXIS_TIME] = REPEATED,   [AXIS_INPUT] = SIZES,      [AXIS_OUTPUT] = SIZES,
        [AXIS_RATE] = SPEEDS,     [AXIS_DEPTH] = SIZES,      [AXIS_SINCE_REVERSAL] = STEPS,
        [AXIS_FREQUENCY] = SWEEP, [AXIS_DIRECTION] = SPEEDS,
    };
    return next_of(gap, shape[axis]);
}

void next_input_free(next_input_t* next)
{
    free(next->time);
    free(next->input);
    *next = (next_input_t){0};
}
