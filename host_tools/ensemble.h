/// Compression for the least mean-square output error over an ensemble of reversal inputs.
#ifndef HYST_HOST_ENSEMBLE_H
#define HYST_HOST_ENSEMBLE_H

#include "ensemble_polish.h"
#include "partition.h"

/// How many plays may be kept (`num_plays` below).
enum { ENSEMBLE_MOST_PLAYS = 64 };

/// The plays, at most num_plays (>= 1), that stand for `plays` (>= 1, radii from the least to the largest
/// that moves) under the model's envelopes over drive_new's ensemble. Radii stay between the first and the
/// last of `plays`; weights are >= 0, their total is free. Starts from several partitions, exchanges radii
/// for others on a grid while that helps, then moves the best ones off the grid. The same model gives the
/// same answer. Time: O(samples plays->num_plays) for many plays, besides some 0.3 s for 6 to be kept and 10
/// s for 64. Not reported, with `found` the plays as they were: OUTCOME_USAGE for more than
/// ENSEMBLE_MOST_PLAYS, unless there are no more; OUTCOME_NUMERICAL when least squares do not settle.
outcome_t ensemble_find(const model_t* model, const play_set_t* plays, size_t num_plays,
                        ensemble_plays_t* found);

/// Which of the plays are nearest to which of those found; of equally near ones to the first. Groups may be
/// empty. cost: the RMS error.
partition_t ensemble_partition(const play_set_t* plays, const ensemble_plays_t* found);

#endif
