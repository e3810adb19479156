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

/// Total, centroid and moment of inertia about the centroid. They grow by terms >= 0 and by differences
/// between radii (Welford 1962), so that neither a heavy play elsewhere nor a cluster far from 0 costs
/// digits.
typedef struct {
    double weight;
    double centroid, centroid_rest; ///< the centroid is their sum
    double inertia;                 ///< sum of weight (r - centroid)^2
} moments_t;

void moments_add(moments_t* moments, double radius, double weight);

/// Sums over a group.
typedef struct {
    double origin; ///< a radius within the group
    size_t num_plays;
    double distance;  ///< sum of r - origin, for a group without weight
    moments_t plain;  ///< weighted by p
    moments_t square; ///< weighted by p^2
    double lag;       ///< centroid under p^2 less centroid under p
    double entropy;   ///< sum of p log(P / p), P the sum of p: P times the entropy of the normalised weights
} group_sums_t;

group_sums_t group_sums_begin(double origin);
void group_sums_add(group_sums_t* sums, double radius, double weight);

/// The radius of the play that stands for the group: the weighted centroid; the plain mean without weight.
double group_centroid(const group_sums_t* sums);
/// Entropy of the group's normalised weights times the length of the vector p_j (r_j - centroid). 0 for one
/// play and for a group without weight.
double group_loss(const group_sums_t* sums);

/// P entropy of two parts taken together, less their own: P_1 log(P / P_1) + P_2 log(P / P_2), given the
/// parts' weights and the logarithms of these (0 for weight 0).
double entropy_of_mixing(double weight, double log_weight, double other, double log_other);

/// What the lag needs to know of a part.
typedef struct {
    double weight, square; ///< sums of p and p^2
    double lag;
} lag_part_t;
/// The lag of two parts taken together whose centroids are `apart`. Where one part outweighs the other by all
/// digits, the lag keeps its own.
double lag_of_both(lag_part_t part, lag_part_t other, double apart);

/// The play at the weighted median of the plays first ... end - 1: the first one up to which there is at
/// least half of the weight.
size_t group_median(const play_set_t* plays, size_t first, size_t end);
/// sum p |r - centre| and sum p (r - centroid)^2 over the plays first ... end - 1.
double group_distance(const play_set_t* plays, size_t first, size_t end, double centre);
double group_inertia(const play_set_t* plays, size_t first, size_t end);

#endif
