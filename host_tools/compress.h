/// Compression of a model to fewer plays (Zhang et al. 2015, Eqs. (9) to (19)).
#ifndef HYST_HOST_COMPRESS_H
#define HYST_HOST_COMPRESS_H

#include "message.h"
#include "model.h"
#include "partition.h"

typedef struct {
    size_t num_plays; ///< wanted number of plays, >= 1; more than there are moving plays: all are kept
    partition_cost_t cost;
    bool unscaled;   ///< entropy costs and uniform: group by the weights themselves, without Eq. (19)
    bool exhaustive; ///< try every partition; not for uniform
} compress_options_t;

typedef struct {
    partition_t partition;  ///< of the plays that can move; no groups when none can
    size_t num_fixed;       ///< plays that cannot move, now part of the constant
    double envelope_weight; ///< weight that became part of the non-hysteretic part (wasserstein)
    double constant;    ///< output before less output after in negative saturation (wasserstein, ensemble)
    double error_bound; ///< |output difference| for every input, see transport.h
    outcome_t outcome;  ///< of ensemble_find; not OUTCOME_OK: the plays that move are as they were
} compression_t;

/// The compressed model. Plays that cannot move (r >= model_largest_moving_radius) go into the constant of
/// the non-hysteretic part. A group's play has, as radius,
/// - entropy costs and uniform: the centroid under the weights of Eq. (19), and the weight with which it
/// travels
///   as far between the saturations as the group's plays did; unscaled, the plain centroid and total weight;
/// - variance: the plain centroid, and the group's total weight;
/// - wasserstein: the weighted median, and the total weight. Plays nearer to model_largest_moving_radius than
/// to
///   any group go into the constant. With equal envelopes, where D can take the envelope in
///   (model_takes_envelope), those nearer to r = 0 go into D. The constant is centred, so that error_bound is
///   W1, the least that any model with as many plays, the same envelopes and another constant can have.
/// - ensemble: ensemble.h; its partition tells which play is nearest to which, its cost is the RMS error.
/// The other costs keep the output in negative saturation as it was. `initial` is interpolated in the radius.
/// What was done is recorded in identification.compression; its error_bound adds up over repeated
/// compressions. It holds for every input within the range from negative saturation, and from any start
/// (CONTRACT, --initial) where no radius is above model_largest_moving_radius: a wider play stays where its
/// start put it. Where no play can move, one without weight remains.
model_t compress_model(const model_t* model, const compress_options_t* options, compression_t* compression);

/// Likewise with the least number of plays whose error_bound is at most `tolerance` >= 0 [output units];
/// options->num_plays is not read, options->exhaustive must be false.
model_t compress_to_tolerance(const model_t* model, const compress_options_t* options, double tolerance,
                              compression_t* compression);

/// Whether the cost counts the plays by Eq. (19).
bool compress_is_scaled(const compress_options_t* options);
/// How many partitions the exhaustive method would go through.
double compress_partition_count(const model_t* model, const compress_options_t* options);

void compression_free(compression_t* compression);

/// A cost by its name; false when unknown. The names, comma-separated, for messages.
bool compress_cost_from_name(const char* name, partition_cost_t* cost);
const char* compress_cost_name(partition_cost_t cost);
extern const char compress_cost_names[];

#endif
