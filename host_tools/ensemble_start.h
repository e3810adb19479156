/// Where the search for radii begins: partitions of the plays into groups.
#ifndef HYST_HOST_ENSEMBLE_START_H
#define HYST_HOST_ENSEMBLE_START_H

#include "ensemble_gram.h"

/// The partition whose groups' own mean-square errors have the least sum, each group as one play with its
/// total weight at its best candidate: errors of different groups are taken for uncorrelated. By dynamic
/// programming; exact in the groups. chosen[num_groups] gets the candidates.
void start_least_squares(const gram_t* gram, const play_set_t* plays, size_t num_groups, size_t* chosen);

#endif
