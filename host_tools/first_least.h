/// The search for the best start of a group, inner loop of all dynamic programmes.
#ifndef HYST_HOST_FIRST_LEAST_H
#define HYST_HOST_FIRST_LEAST_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

static inline double cost_joined(double groups, double group, bool maximum)
{
    return maximum ? (groups < group ? group : groups) : groups + group;
}

/// The least of the costs of count >= 1 starts, each the sum or the larger of groups[i] and group[i].
static inline double least_cost(const double* groups, const double* group, size_t count, bool maximum)
{
    // Independent lanes, which compilers turn into vector instructions.
    enum { LANES = 4 };
    double lane[LANES];
    for (size_t l = 0; l < LANES; ++l) {
        lane[l] = (double)INFINITY;
    }
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        for (size_t l = 0; l < LANES; ++l) {
            const double total = cost_joined(groups[i + l], group[i + l], maximum);
            lane[l] = total < lane[l] ? total : lane[l];
        }
    }
    for (; i < count; ++i) {
        const double total = cost_joined(groups[i], group[i], maximum);
        lane[0] = total < lane[0] ? total : lane[0];
    }
    for (size_t l = 1; l < LANES; ++l) {
        lane[0] = lane[l] < lane[0] ? lane[l] : lane[0];
    }
    return lane[0];
}

/// The first start whose cost is at most `cost`; there must be one.
static inline size_t first_at_most(const double* groups, const double* group, double cost, bool maximum)
{
    size_t first = 0;
    while (cost_joined(groups[first], group[first], maximum) > cost) {
        ++first;
    }
    return first;
}

#endif
