/// Dividing sorted plays into runs of neighbours: group k holds the plays beta[k-1]+1 ... beta[k], Eq. (9).
#ifndef HYST_HOST_PARTITION_H
#define HYST_HOST_PARTITION_H

#include "group_loss.h"
#include <stdbool.h>

typedef enum {
    COST_ENTROPY_SUM, ///< the sum of the groups' losses, Eq. (17)
    COST_ENTROPY_MAX, ///< their maximum, Eq. (18)
    COST_UNIFORM,     ///< groups of equal numbers of plays; its cost is the sum of the losses
    COST_WASSERSTEIN, ///< sum of p |r - median|: weighted k-median
    COST_VARIANCE,    ///< sum of p (r - centroid)^2: weighted k-means
    COST_ENSEMBLE,    ///< mean-square output error: no partition's cost, see ensemble.h
} partition_cost_t;

/// What is minimised. Cost wasserstein has, besides the groups, two places that take up weight without a
/// play, paid for by its distance: r = 0, where a play is the envelope itself, and r = limit, where it never
/// moves.
typedef struct {
    partition_cost_t cost;
    bool zero_is_free; ///< the plays before beta[0] move to r = 0
    bool limit_is_free;
    double limit;    ///< where the plays after beta[num_groups] move to; not below the largest radius
    bool exhaustive; ///< try every partition; entropy, wasserstein and variance, one number of groups at a
                     ///< time
} partition_terms_t;

typedef struct {
    size_t num_groups;
    size_t*
        beta; ///< [num_groups + 1], beta[0] = 0 and beta[num_groups] = num_plays but for free places; owned
    double cost;
    size_t evaluations; ///< how many groups had their loss evaluated to find it
} partition_t;

/// The partition into num_groups non-empty groups of least cost; 1 <= num_groups <= num_plays < 2^32.
/// Entropy costs: O(num_plays^2 num_groups) time. Of partitions whose costs differ by less than one part in
/// 10^12 they take the one with the least beta[num_groups - 1], then the least beta[num_groups - 2], and so
/// on. Wasserstein and variance: O(num_groups num_plays log num_plays) time, divide and conquer (interval
/// costs that keep the quadrangle inequality). Memory: O(num_plays (num_groups + log num_plays)).
partition_t partition_find(const play_set_t* plays, size_t num_groups, partition_cost_t cost);
/// Likewise for least_groups ... most_groups groups in one go: [most_groups - least_groups + 1], owned.
partition_t* partition_find_all(const play_set_t* plays, size_t least_groups, size_t most_groups,
                                const partition_terms_t* terms);
/// How many partitions `exhaustive` goes through; as a double, for it soon exceeds integers.
double partition_count(size_t num_plays, size_t num_groups, const partition_terms_t* terms);
/// The least number of groups with which cost wasserstein is at most `cost` >= 0; num_plays if there is none.
size_t partition_least_groups(const play_set_t* plays, const partition_terms_t* terms, double cost);

/// What a given partition costs, by direct summation.
double partition_cost(const play_set_t* plays, const size_t* beta, size_t num_groups, partition_cost_t cost);
double partition_cost_on(const play_set_t* plays, const size_t* beta, size_t num_groups,
                         const partition_terms_t* terms);
void partition_free(partition_t* partition);

#endif
