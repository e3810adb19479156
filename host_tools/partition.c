#include "model.h"
#include "partition_internal.h"
#include <math.h>
#include <stdlib.h>

double cost_combined(partition_cost_t cost, double groups, double group)
{
    return cost == COST_ENTROPY_MAX ? fmax(groups, group) : groups + group;
}

static double entropy_loss(const play_set_t* plays, size_t first, size_t end)
{
    group_sums_t sums = group_sums_begin(plays->radius[first]);
    for (size_t j = first; j < end; ++j) {
        group_sums_add(&sums, plays->radius[j], plays->weight[j]);
    }
    return group_loss(&sums);
}

double group_cost(const play_set_t* plays, size_t first, size_t end, partition_cost_t cost)
{
    switch (cost) {
    case COST_WASSERSTEIN:
        return group_distance(plays, first, end, plays->radius[group_median(plays, first, end)]);
    case COST_VARIANCE:
        return group_inertia(plays, first, end);
    case COST_ENTROPY_SUM:
    case COST_ENTROPY_MAX:
    case COST_UNIFORM:
    case COST_ENSEMBLE:
        break;
    }
    return entropy_loss(plays, first, end);
}

/// Radii and weights times powers of two, so that their squares neither overflow nor vanish.
typedef struct {
    play_set_t plays;
    double* values;
    int radius_exponent, weight_exponent;
} scaled_t;

static int exponent_of_largest(const double* values, size_t count)
{
    double largest = 0.0;
    for (size_t j = 0; j < count; ++j) {
        largest = fmax(largest, values[j]);
    }
    int exponent;
    (void)frexp(largest, &exponent);
    return exponent;
}

static scaled_t scaled_new(const play_set_t* plays)
{
    const size_t num_plays = plays->num_plays;
    scaled_t scaled = {.values = xmalloc(2 * num_plays * sizeof(double))};
    scaled.radius_exponent = exponent_of_largest(plays->radius, num_plays);
    scaled.weight_exponent = exponent_of_largest(plays->weight, num_plays);
    for (size_t j = 0; j < num_plays; ++j) {
        scaled.values[j] = ldexp(plays->radius[j], -scaled.radius_exponent);
        scaled.values[num_plays + j] = ldexp(plays->weight[j], -scaled.weight_exponent);
    }
    scaled.plays = (play_set_t){scaled.values, scaled.values + num_plays, num_plays};
    return scaled;
}

static partition_terms_t scaled_terms(const scaled_t* scaled, const partition_terms_t* terms)
{
    partition_terms_t result = *terms;
    result.limit = ldexp(terms->limit, -scaled->radius_exponent);
    return result;
}

static int cost_exponent(const scaled_t* scaled, partition_cost_t cost)
{
    return scaled->weight_exponent + (cost == COST_VARIANCE ? 2 : 1) * scaled->radius_exponent;
}

static double scaled_cost(const scaled_t* scaled, const size_t* beta, size_t num_groups,
                          const partition_terms_t* terms)
{
    const play_set_t* plays = &scaled->plays;
    double total = 0.0;
    for (size_t k = 0; k < num_groups; ++k) {
        total = cost_combined(terms->cost, total, group_cost(plays, beta[k], beta[k + 1], terms->cost));
    }
    total += group_distance(plays, 0, beta[0], 0.0);
    if (beta[num_groups] < plays->num_plays) {
        const double limit = scaled_terms(scaled, terms).limit;
        total += group_distance(plays, beta[num_groups], plays->num_plays, limit);
    }
    return ldexp(total, cost_exponent(scaled, terms->cost));
}

double partition_cost_on(const play_set_t* plays, const size_t* beta, size_t num_groups,
                         const partition_terms_t* terms)
{
    scaled_t scaled = scaled_new(plays);
    const double cost = scaled_cost(&scaled, beta, num_groups, terms);
    free(scaled.values);
    return cost;
}

double partition_cost(const play_set_t* plays, const size_t* beta, size_t num_groups, partition_cost_t cost)
{
    const partition_terms_t terms = {.cost = cost};
    return partition_cost_on(plays, beta, num_groups, &terms);
}

static void divide_uniformly(size_t num_groups, division_t* division)
{
    const size_t num_plays = division->num_plays;
    for (size_t k = 1; k <= num_groups; ++k) {
        const size_t end = (k * num_plays + num_groups / 2) / num_groups;
        const size_t start = ((k - 1) * num_plays + num_groups / 2) / num_groups;
        division->before[k * (num_plays + 1) + end] = (uint32_t)start;
    }
    division->last_end[num_groups] = num_plays;
    division->evaluations = num_groups;
}

static division_t divide(const scaled_t* scaled, size_t least_groups, size_t most_groups,
                         const partition_terms_t* terms)
{
    const size_t num_plays = scaled->plays.num_plays;
    division_t division = {.num_plays = num_plays, .most_groups = most_groups};
    division.before = xcalloc((most_groups + 1) * (num_plays + 1), sizeof(uint32_t));
    division.last_end = xcalloc(most_groups + 1, sizeof(size_t));
    const partition_terms_t own = scaled_terms(scaled, terms);
    if (terms->exhaustive) {
        divide_exhaustively(&scaled->plays, &own, &division);
        return division;
    }
    switch (terms->cost) {
    case COST_ENTROPY_SUM:
    case COST_ENTROPY_MAX:
        divide_by_entropy(&scaled->plays, least_groups, terms->cost == COST_ENTROPY_MAX, &division);
        break;
    case COST_WASSERSTEIN:
    case COST_VARIANCE:
        divide_by_distance(&scaled->plays, &own, least_groups, &division);
        break;
    case COST_UNIFORM:
    case COST_ENSEMBLE:
        break;
    }
    return division;
}

static partition_t walk_back(const division_t* division, size_t num_groups)
{
    partition_t partition = {.num_groups = num_groups, .beta = xcalloc(num_groups + 1, sizeof(size_t))};
    size_t end = division->last_end[num_groups];
    for (size_t k = num_groups; k > 0; --k) {
        partition.beta[k] = end;
        end = division->before[k * (division->num_plays + 1) + end];
    }
    partition.beta[0] = end;
    return partition;
}

partition_t* partition_find_all(const play_set_t* plays, size_t least_groups, size_t most_groups,
                                const partition_terms_t* terms)
{
    scaled_t scaled = scaled_new(plays);
    division_t division = divide(&scaled, least_groups, most_groups, terms);
    partition_t* partitions = xcalloc(most_groups - least_groups + 1, sizeof(partition_t));
    for (size_t k = least_groups; k <= most_groups; ++k) {
        if (terms->cost == COST_UNIFORM) {
            divide_uniformly(k, &division);
        }
        partition_t* partition = &partitions[k - least_groups];
        *partition = walk_back(&division, k);
        partition->evaluations = division.evaluations;
        partition->cost = scaled_cost(&scaled, partition->beta, k, terms);
    }
    free(division.before);
    free(division.last_end);
    free(scaled.values);
    return partitions;
}

partition_t partition_find(const play_set_t* plays, size_t num_groups, partition_cost_t cost)
{
    const partition_terms_t terms = {.cost = cost};
    partition_t* only = partition_find_all(plays, num_groups, num_groups, &terms);
    const partition_t partition = only[0];
    free(only);
    return partition;
}

void partition_free(partition_t* partition)
{
    free(partition->beta);
    *partition = (partition_t){0};
}
