#include "record_fill.h"

#include "model.h"
#include "sample_steps.h"
#include <math.h>
#include <stddef.h>
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

/// A course up to a gap, from its last sample on: what it goes on by in a step, and by how much less or more
/// in each further one.
typedef struct {
    double last, step, bend;
} course_t;

/// away: 1 or -1, where the course's earlier samples are.
static course_t course_to(const double* x, ptrdiff_t away)
{
    return (course_t){x[0], x[0] - x[away], x[0] - 2 * x[away] + x[2 * away]};
}

/// As a parabola.
static double continued(const course_t* course, unsigned steps)
{
    return course->last + steps * course->step + 0.5 * steps * (steps + 1) * course->bend;
}

/// Ahead of a turn a course may slow down, and by no more than makes one parabola of both, however noisy its
/// samples are.
static void slow_down(course_t* course, double way, double most)
{
    course->bend = -way * fmin(fmax(-way * course->bend, 0), most);
}

/// The lost samples between x[0] and x[gap], three known ones on either side of them. Each lies on the course
/// before the turn or on the one behind it, so on neither's far side, and on no nearer one than the line.
static void fill_turn(double* x, unsigned gap)
{
    course_t before = course_to(x, -1);
    course_t behind = course_to(&x[gap], 1);
    const double way = copysign(1, before.step);
    const double most = (fabs(before.step) + fabs(behind.step)) / gap;
    slow_down(&before, way, most);
    slow_down(&behind, way, most);
    for (unsigned step = 1; step < gap; step++) {
        const double there = way * fmin(way * continued(&before, step), way * continued(&behind, gap - step));
        x[step] = way * fmax(way * there, way * x[step]);
    }
}

/// Whether it comes back behind the gap.
static bool is_turn(const double* x, unsigned gap)
{
    return (x[0] - x[-1]) * (x[gap + 1] - x[gap]) < 0;
}

/// steps: of the record before it was filled, where `input` has its lost samples already, on lines.
static void fill_turns(double* input, const unsigned char* steps, size_t num_samples, size_t num_filled)
{
    for (size_t t = 1, k = 0; t < num_samples; k += steps[t], t++) {
        // k: where the sample t - 1 is.
        const bool has_courses = k >= 2 && k + steps[t] + 2 < num_filled;
        if (steps[t] > 1 && has_courses && is_turn(&input[k], steps[t])) {
            fill_turn(&input[k], steps[t]);
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
        fill_turns(record->input, steps, n, num_filled);
    }
    record->num_samples = num_filled;
    free(steps);
}
