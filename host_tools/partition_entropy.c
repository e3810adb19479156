#include "first_least.h"
#include "interval_table.h"
#include "model.h"
#include "partition_internal.h"
#include <math.h>
#include <stdlib.h>

/// least[k][i] is the least cost of the first i plays in k groups.
typedef struct {
    division_t* division;
    size_t least_groups;
    bool maximum;
    double most_cost; ///< no partition that is looked for costs more
    double* least;
    double* loss; ///< [num_plays] of the groups i ... end - 1
} stages_t;

/// The best start out of `count`: of costs that are equal to one part in 10^12 the first.
static inline size_t best_start(const double* groups, const double* loss, size_t count, bool maximum,
                                double* least)
{
    const double lowest = least_cost(groups, loss, count, maximum);
    const size_t best = first_at_most(groups, loss, lowest + 1e-12 * lowest, maximum);
    *least = cost_joined(groups[best], loss[best], maximum);
    return best;
}

/// Group k to `end` from the starts first ... end_start - 1; loss[i] is that of the group from start i.
static void fill_stage(const stages_t* stages, size_t k, size_t end, size_t first, size_t end_start)
{
    const size_t width = stages->division->num_plays + 1;
    const size_t start = k - 1 > first ? k - 1 : first; // each group before needs a play
    const size_t count = k == 1 ? 1 : end_start - start;
    const double* groups = stages->least + (k - 1) * width + start;
    const double* loss = stages->loss + start;
    double* least = &stages->least[k * width + end];
    if (start >= end_start || (k == 1 && start > 0)) {
        *least = (double)INFINITY;
        return;
    }
    const size_t best = stages->maximum ? best_start(groups, loss, count, true, least)
                                        : best_start(groups, loss, count, false, least);
    stages->division->before[k * width + end] = (uint32_t)(start + best);
}

/// The numbers of groups that the first `end` plays may form: each group behind needs a play too.
static void groups_up_to(const stages_t* stages, size_t end, size_t* low, size_t* high)
{
    const size_t behind = stages->division->num_plays - end;
    const size_t most = stages->division->most_groups - (behind > 0 ? 1 : 0);
    *low = stages->least_groups > behind + 1 ? stages->least_groups - behind : 1;
    *high = most < end ? most : end;
}

static void fill(const stages_t* stages, const interval_table_t* table)
{
    for (size_t end = 1; end <= stages->division->num_plays; ++end) {
        size_t low;
        size_t high;
        groups_up_to(stages, end, &low, &high);
        if (low > high) {
            continue;
        }
        size_t first = low - 1;
        const size_t end_start = high == 1 ? 1 : end; // one group begins with the first play
        interval_table_row(table, join_entropy_loss, first, end_start, end - 1, stages->loss + first);
        stages->division->evaluations += end_start - first;
        // The loss mostly grows with the group, so that the longest groups fall away.
        while (first < end_start && stages->loss[first] > stages->most_cost) {
            ++first;
        }
        for (size_t k = low; k <= high; ++k) {
            fill_stage(stages, k, end, first, end_start);
        }
    }
}

/// What each number of groups can certainly be had for, by k-means: no optimum contains a group that alone
/// costs more than the dearest of these.
static double most_cost(const play_set_t* plays, size_t least_groups, size_t most_groups, bool maximum)
{
    const partition_terms_t variance = {.cost = COST_VARIANCE};
    const partition_cost_t cost = maximum ? COST_ENTROPY_MAX : COST_ENTROPY_SUM;
    partition_t* partitions = partition_find_all(plays, least_groups, most_groups, &variance);
    double dearest = 0.0;
    for (size_t k = 0; k <= most_groups - least_groups; ++k) {
        dearest = fmax(dearest, partition_cost(plays, partitions[k].beta, partitions[k].num_groups, cost));
        partition_free(&partitions[k]);
    }
    free(partitions);
    // The table's losses are rounded otherwise: with radii and weights up to 1, by some 1e-16 times the
    // entropy, at most log N, and the root of the sum of squares, at most sqrt N; below 1e-11 for N up to
    // 10^7.
    return dearest * (1.0 + 1e-9) + 1e-11;
}

void divide_by_entropy(const play_set_t* plays, size_t least_groups, bool maximum, division_t* division)
{
    const size_t num_plays = plays->num_plays;
    stages_t stages = {.division = division, .least_groups = least_groups, .maximum = maximum};
    stages.most_cost = most_cost(plays, least_groups, division->most_groups, maximum);
    stages.least = xcalloc((division->most_groups + 1) * (num_plays + 1), sizeof(double));
    stages.loss = xmalloc(num_plays * sizeof(double));
    interval_table_t table = interval_table_new(plays, interval_entropy);
    fill(&stages, &table);
    interval_table_free(&table);
    for (size_t k = 0; k <= division->most_groups; ++k) {
        division->last_end[k] = num_plays;
    }
    free(stages.loss);
    free(stages.least);
}
