/// Compression of a model to fewer plays (Zhang et al. 2015, Eqs. (9) to (19)).
#ifndef HYST_HOST_COMPRESS_H
#define HYST_HOST_COMPRESS_H

#include "model.h"
#include "partition.h"

typedef struct {
    size_t num_plays; ///< wanted number of plays, >= 1; more than there are moving plays: all are kept
    partition_cost_t cost;
    bool unscaled; ///< group by the weights themselves, without Eq. (19)
} compress_options_t;

typedef struct {
    partition_t partition; ///< of the plays that can move; no groups when none can
    size_t num_fixed;      ///< plays that cannot move, now part of the constant
    double error_bound;    ///< |output difference| for every input from negative saturation, see transport.h
} compression_t;

/// The compressed model. A group's play has, as radius, the centroid under the weights of Eq. (19), and the
/// weight with which it travels as far between the saturations as the group's plays did; unscaled, the plain
/// centroid and the group's total weight. Plays that cannot move (r >= model_largest_moving_radius) go into
/// the constant of the non-hysteretic part, which also keeps the output in negative saturation as it was.
/// `initial` is interpolated in the radius. What was done is recorded in identification.compression; its
/// error_bound adds up over repeated compressions. Where no play can move, one without weight remains.
model_t compress_model(const model_t* model, const compress_options_t* options, compression_t* compression);

/// Likewise with the least number of plays whose error_bound is at most `tolerance` >= 0 [output units];
/// options->num_plays is not read.
model_t compress_to_tolerance(const model_t* model, const compress_options_t* options, double tolerance,
                              compression_t* compression);

void compression_free(compression_t* compression);

/// A cost by its name; false when unknown. The names, comma-separated, for messages.
bool compress_cost_from_name(const char* name, partition_cost_t* cost);
const char* compress_cost_name(partition_cost_t cost);
extern const char compress_cost_names[];

#endif
