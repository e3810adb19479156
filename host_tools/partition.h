/// Dividing sorted plays into runs of neighbours: group k holds the plays beta[k-1]+1 ... beta[k], Eq. (9).
#ifndef HYST_HOST_PARTITION_H
#define HYST_HOST_PARTITION_H

#include "group_loss.h"

typedef enum {
    COST_ENTROPY_SUM, ///< the sum of the groups' losses, Eq. (17)
    COST_ENTROPY_MAX, ///< their maximum, Eq. (18)
    COST_UNIFORM,     ///< groups of equal numbers of plays; its cost is the sum of the losses
} partition_cost_t;

typedef struct {
    size_t num_groups;
    size_t* beta; ///< [num_groups + 1], beta[0] = 0, beta[num_groups] = num_plays; owned
    double cost;
    size_t evaluations; ///< how many different groups had their loss evaluated
} partition_t;

/// The partition into num_groups groups of least cost, by dynamic programming: O(num_plays^2 num_groups)
/// time, O(num_plays num_groups) memory. 1 <= num_groups <= num_plays. Of partitions whose costs differ by
/// less than one part in 10^12 it takes the one with the least beta[num_groups - 1], then the least
/// beta[num_groups - 2], and so on.
partition_t partition_find(const play_set_t* plays, size_t num_groups, partition_cost_t cost);
/// What a given partition costs.
double partition_cost(const play_set_t* plays, const size_t* beta, size_t num_groups, partition_cost_t cost);
void partition_free(partition_t* partition);

#endif
