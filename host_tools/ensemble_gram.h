/// Second moments of the plays' states over the ensemble: the mean-square output error as a quadratic form.
#ifndef HYST_HOST_ENSEMBLE_GRAM_H
#define HYST_HOST_ENSEMBLE_GRAM_H

#include "ensemble_input.h"
#include "group_loss.h"

/// Covariances: means are taken off since the constant is free. Candidate radii are `sub` to a step from one
/// play to the next, so that candidate sub * j is play j's radius.
typedef struct {
    size_t num_radii, sub;
    double* radius;     ///< [num_radii] not decreasing, owned
    double* covariance; ///< [num_radii * num_radii] symmetric
    double* target;     ///< [num_radii] with the output's play part
    double variance;    ///< of the output's play part
} gram_t;

/// Takes the mean off; returns it.
double centre(double* values, size_t count);

/// plays: whose radii the candidates are laid between. output[num_samples]: the play part, centred.
gram_t gram_new(const drive_t* drive, const play_set_t* plays, const double* output);
void gram_free(gram_t* gram);

/// The mean-square error of the candidates chosen[count] (different, ascending) under their best weights >=
/// 0.
double gram_error(const gram_t* gram, const size_t* chosen, size_t count);

/// The candidate that, put in place of chosen[k], leaves the least error over unbounded weights; chosen[k]
/// when none does better.
size_t gram_exchange(const gram_t* gram, const size_t* chosen, size_t count, size_t k);

#endif
