#include "sample_steps.h"

#include "model.h"
#include <math.h>
#include <stdlib.h>

/// Steps enough for their median, whole runs of them: every n-th would see only one of n.
enum { RUNS = 100, RUN = 1000 };
/// After more sample times than this nobody knows by what way the input came.
static const double most_steps = 8;
/// Of the samples there are, the part that may be lost: more are no loss, the record has another rate there.
static const double most_lost = 0.25;
/// How far beside a multiple of the sample time a step may be.
static const double tolerance = 0.1;

static int ascending_order(const void* left, const void* right)
{
    const double a = *(const double*)left;
    const double b = *(const double*)right;
    return (a > b) - (a < b);
}

double sample_time_of(const double* time, size_t num_samples)
{
    if (num_samples < 2) {
        return 1;
    }
    const size_t num_steps = num_samples - 1;
    const size_t runs = num_steps <= RUNS * RUN ? 1 : RUNS;
    const size_t length = runs == 1 ? num_steps : RUN;
    const size_t count = runs * length;
    double* step = xmalloc(count * sizeof *step);
    for (size_t i = 0; i < count; i++) {
        const size_t begin = runs == 1 ? 0 : i / length * (num_steps - length) / (runs - 1);
        step[i] = time[begin + i % length + 1] - time[begin + i % length];
    }
    qsort(step, count, sizeof *step, ascending_order);
    const double median = step[count / 2];
    free(step);
    return median;
}

static unsigned char steps_of(double sample_times)
{
    const double whole = round(sample_times);
    return fabs(sample_times - whole) < tolerance && whole > 1 && whole <= most_steps ? (unsigned char)whole
                                                                                      : 1;
}

unsigned char* sample_steps_new(const double* time, size_t num_samples)
{
    if (time == NULL || num_samples < 2) {
        return NULL;
    }
    const double sample_time = sample_time_of(time, num_samples);
    unsigned char* steps = xmalloc(num_samples);
    size_t lost = 0;
    steps[0] = 1;
    for (size_t t = 1; t < num_samples; t++) {
        steps[t] = steps_of((time[t] - time[t - 1]) / sample_time);
        lost += steps[t] - 1U;
    }
    if (lost == 0 || (double)lost > most_lost * (double)num_samples) {
        free(steps);
        return NULL;
    }
    return steps;
}
