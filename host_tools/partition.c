#include "partition.h"
#include "model.h"
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/// Stages of the dynamic programme: least[k * (num_plays + 1) + i] is the least cost of the first i plays in
/// k groups, before[...] the end of group k - 1 in that division.
typedef struct {
    size_t num_plays, num_groups;
    partition_cost_t cost;
    double* least;
    size_t* before;
} stages_t;

static double combined(partition_cost_t cost, double groups, double group)
{
    return cost == COST_ENTROPY_MAX ? fmax(groups, group) : groups + group;
}

static group_sums_t sums_of(const play_set_t* plays, size_t first, size_t end)
{
    group_sums_t sums = group_sums_begin(plays->radius[first]);
    for (size_t j = first; j < end; ++j) {
        group_sums_add(&sums, plays->radius[j], plays->weight[j]);
    }
    return sums;
}

double partition_cost(const play_set_t* plays, const size_t* beta, size_t num_groups, partition_cost_t cost)
{
    double total = 0.0;
    for (size_t k = 0; k < num_groups; ++k) {
        const group_sums_t sums = sums_of(plays, beta[k], beta[k + 1]);
        total = combined(cost, total, group_loss(&sums));
    }
    return total;
}

static stages_t stages_new(size_t num_plays, size_t num_groups, partition_cost_t cost)
{
    const size_t length = (num_groups + 1) * (num_plays + 1);
    stages_t stages = {.num_plays = num_plays, .num_groups = num_groups, .cost = cost};
    stages.least = xmalloc(length * sizeof(double));
    stages.before = xcalloc(length, sizeof(size_t));
    for (size_t i = 0; i < length; ++i) {
        stages.least[i] = (double)INFINITY;
    }
    stages.least[0] = 0.0;
    return stages;
}

/// The numbers of groups *low ... *high that may lie before the group start + 1 ... end: each of them needs a
/// play, and so does each group behind. False when there is none.
static bool groups_before(const stages_t* stages, size_t start, size_t end, size_t* low, size_t* high)
{
    const size_t behind = stages->num_plays - end;
    const size_t others = stages->num_groups - 1;
    *low = others > behind ? others - behind : 0;
    *low = *low == 0 && start > 0 ? 1 : *low;
    *high = behind == 0 ? others : others - (others > 0 ? 1 : 0);
    *high = *high < start ? *high : start;
    *low = behind == 0 ? others : *low;
    return *low <= *high && (behind == 0 || others > 0);
}

/// Offers the group start + 1 ... end to every stage it can belong to.
static void offer(stages_t* stages, size_t start, size_t end, size_t low, size_t high, double loss)
{
    const size_t width = stages->num_plays + 1;
    for (size_t k = low; k <= high; ++k) {
        const double total = combined(stages->cost, stages->least[k * width + start], loss);
        double* least = &stages->least[(k + 1) * width + end];
        if (isinf(*least) || total < *least - 1e-12 * *least) {
            *least = total;
            stages->before[(k + 1) * width + end] = start;
        }
    }
}

static void walk_back(const stages_t* stages, size_t* beta)
{
    size_t end = stages->num_plays;
    for (size_t k = stages->num_groups; k > 0; --k) {
        beta[k] = end;
        end = stages->before[k * (stages->num_plays + 1) + end];
    }
    beta[0] = 0;
}

/// Starts are visited in ascending order, so that the stages up to a start are complete when it is reached
/// and a group grows by one play at a time: every group is evaluated once, in O(1).
static size_t fill(stages_t* stages, const play_set_t* plays)
{
    size_t evaluations = 0;
    for (size_t start = 0; start < plays->num_plays; ++start) {
        group_sums_t sums = group_sums_begin(plays->radius[start]);
        for (size_t end = start + 1; end <= plays->num_plays; ++end) {
            group_sums_add(&sums, plays->radius[end - 1], plays->weight[end - 1]);
            size_t low;
            size_t high;
            if (groups_before(stages, start, end, &low, &high)) {
                ++evaluations;
                offer(stages, start, end, low, high, group_loss(&sums));
            }
        }
    }
    return evaluations;
}

static partition_t uniform(const play_set_t* plays, partition_t partition)
{
    for (size_t k = 0; k <= partition.num_groups; ++k) {
        partition.beta[k] = (k * plays->num_plays + partition.num_groups / 2) / partition.num_groups;
    }
    partition.evaluations = partition.num_groups;
    return partition;
}

partition_t partition_find(const play_set_t* plays, size_t num_groups, partition_cost_t cost)
{
    partition_t partition = {.num_groups = num_groups, .beta = xcalloc(num_groups + 1, sizeof(size_t))};
    if (cost == COST_UNIFORM) {
        partition = uniform(plays, partition);
    } else {
        stages_t stages = stages_new(plays->num_plays, num_groups, cost);
        partition.evaluations = fill(&stages, plays);
        walk_back(&stages, partition.beta);
        free(stages.least);
        free(stages.before);
    }
    partition.cost = partition_cost(plays, partition.beta, num_groups, cost);
    return partition;
}

void partition_free(partition_t* partition)
{
    free(partition->beta);
    *partition = (partition_t){0};
}
