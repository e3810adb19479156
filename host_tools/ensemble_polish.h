/// The last part of the search: radii off the grid of candidates.
#ifndef HYST_HOST_ENSEMBLE_POLISH_H
#define HYST_HOST_ENSEMBLE_POLISH_H

#include "ensemble_input.h"
#include "message.h"

/// A few plays that stand for many over the ensemble.
typedef struct {
    size_t num_plays;
    double* radius;     ///< [num_plays] not decreasing, owned
    double* weight;     ///< [num_plays] >= 0
    double constant;    ///< y - y^ in negative saturation
    double rms;         ///< the output error that is left over the ensemble
    size_t evaluations; ///< sets of radii tried
} ensemble_plays_t;

ensemble_plays_t ensemble_plays_new(size_t num_plays);
void ensemble_plays_free(ensemble_plays_t* plays);

/// Moves the radii within [low, high] to a local minimum of the mean-square error under the best weights >= 0
/// and constant, which it sets: variable projection (Golub and Pereyra 1973, Kaufman's Jacobian) with
/// MINPACK's Levenberg-Marquardt. output[drive->num_samples]: the play part to be met, centred; `mean`: what
/// centring took off. OUTCOME_NUMERICAL when the weights cannot be solved for.
outcome_t ensemble_polish(const drive_t* drive, const double* output, double mean, double low, double high,
                          ensemble_plays_t* plays);

#endif
