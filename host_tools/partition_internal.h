/// Between the files that search partitions.
#ifndef HYST_HOST_PARTITION_INTERNAL_H
#define HYST_HOST_PARTITION_INTERNAL_H

#include "partition.h"
#include <stdint.h>

/// The divisions a dynamic programme found, one for every number of groups up to most_groups.
typedef struct {
    size_t num_plays, most_groups;
    uint32_t*
        before; ///< [most_groups + 1][num_plays + 1] where group k begins when it ends before play i; owned
    size_t* last_end; ///< [most_groups + 1] where the last of k groups ends; owned
    size_t evaluations;
} division_t;

/// Entropy costs, for least_groups ... most_groups groups.
void divide_by_entropy(const play_set_t* plays, size_t least_groups, bool maximum, division_t* division);
/// Costs wasserstein and variance, likewise.
void divide_by_distance(const play_set_t* plays, const partition_terms_t* terms, size_t least_groups,
                        division_t* division);

/// All partitions into division->most_groups groups, one by one.
void divide_exhaustively(const play_set_t* plays, const partition_terms_t* terms, division_t* division);

/// The cost of one group by direct summation.
double group_cost(const play_set_t* plays, size_t first, size_t end, partition_cost_t cost);
/// The sum of the groups' costs, or the larger of them for entropy-max.
double cost_combined(partition_cost_t cost, double groups, double group);

#endif
