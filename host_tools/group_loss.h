/// What merging a run of neighbouring plays into one loses.
#ifndef HYST_HOST_GROUP_LOSS_H
#define HYST_HOST_GROUP_LOSS_H

#include <stddef.h>

/// The plays that are to be merged: their radii and the (scaled) weights that the loss is counted in.
typedef struct {
    const double* radius; ///< [num_plays] not decreasing
    const double* weight; ///< [num_plays] >= 0
    size_t num_plays;
} play_set_t;

/// Sums over a group, radii d taken from the group's first one so that nothing cancels.
typedef struct {
    double origin; ///< the group's first radius
    size_t num_plays;
    long double radius;         ///< sum of d, for a group without weight
    long double weight;         ///< sum of p
    long double moment;         ///< sum of p d
    long double square;         ///< sum of p^2
    long double square_moment;  ///< sum of p^2 d
    long double square_inertia; ///< sum of p^2 d^2
    long double entropy;        ///< sum of -p log p, natural logarithm
} group_sums_t;

group_sums_t group_sums_begin(double origin);
void group_sums_add(group_sums_t* sums, double radius, double weight);

/// The radius of the play that stands for the group: the weighted centroid; the plain mean without weight.
double group_centroid(const group_sums_t* sums);
/// Entropy of the group's normalised weights times the length of the vector p_j (r_j - centroid). 0 for one
/// play and for a group without weight.
double group_loss(const group_sums_t* sums);

#endif
