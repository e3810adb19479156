#include "diagnose_grid.h"

#include "model.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VALUES_A_LEVEL = 4, LEAST_LEVELS = 3 };

static int by_value(const void* a, const void* b)
{
    const double x = *(const double*)a;
    const double y = *(const double*)b;
    return (x > y) - (x < y);
}

/// Sorts and keeps what differs by more than rounding in a file; returns how many.
static size_t distinct(double* value, size_t count)
{
    qsort(value, count, sizeof *value, by_value);
    const double same = 1e-7 * (value[count - 1] - value[0]);
    size_t kept = 1;
    for (size_t t = 1; t < count; t++) {
        if (value[t] - value[kept - 1] > same) {
            value[kept++] = value[t];
        }
    }
    return kept;
}

grid_step_t grid_step_of(const double* values, size_t num_values)
{
    grid_step_t grid = {0};
    double* level = memcpy(xmalloc((num_values + 1) * sizeof *level), values, num_values * sizeof *level);
    double* gap = xmalloc((num_values + 1) * sizeof *gap);
    const size_t levels = num_values > 0 ? distinct(level, num_values) : 0;
    if (levels >= LEAST_LEVELS && levels * VALUES_A_LEVEL <= num_values) {
        for (size_t k = 0; k + 1 < levels; k++) {
            gap[k] = level[k + 1] - level[k];
        }
        qsort(gap, levels - 1, sizeof *gap, by_value);
        const double step = gap[(levels - 1) / 2];
        size_t even = 0;
        for (size_t k = 0; k + 1 < levels; k++) {
            even += fabs(gap[k] - step) <= 0.25 * step;
        }
        if (even * 10 >= (levels - 1) * 7) {
            grid = (grid_step_t){step, level[levels / 2]};
        }
    }
    free(level);
    free(gap);
    return grid;
}
