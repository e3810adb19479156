/// What a plant of Preisach's kind does beside a GPI model. Both wipe out and are congruent, so their
/// difference follows from one function of two reversals, the Everett function E(alpha, beta), and is linear
/// in its values on a grid. Source: I. D. Mayergoyz, Mathematical Models of Hysteresis (1991), ch. 1.
#ifndef HYST_HOST_EVERETT_H
#define HYST_HOST_EVERETT_H

#include "model.h"

enum {
    EVERETT_CELLS = 20,                                      ///< over the input's range
    EVERETT_NODES = EVERETT_CELLS * (EVERETT_CELLS + 1) / 2, ///< alpha > beta; E(alpha, alpha) = 0
    EVERETT_FREE = EVERETT_NODES + 1,                        ///< and a constant
    EVERETT_MOST_EXTREMES = 64                               ///< that are remembered
};

/// The reversals that the memory holds, as parts of the range: a minimum, a maximum, a minimum ...
typedef struct {
    double input_min, input_max;
    double extreme[EVERETT_MOST_EXTREMES];
    size_t count;
    double present;
} everett_past_t;

/// Negative saturation.
everett_past_t everett_start(const model_t* model);
/// Moves to `input`, limited to the range; row[EVERETT_FREE]: the difference's derivatives by the nodes'
/// values and the constant.
void everett_step(everett_past_t* past, double input, double* row);

/// The difference itself.
typedef struct {
    double input_min, input_max;
    double value[EVERETT_FREE];
} everett_t;

/// Adds it over an input[num_samples] from negative saturation, ahead of which the input turned at
/// turn[num_turns], to output[num_samples].
void everett_add(const everett_t* everett, const double* turn, size_t num_turns, const double* input,
                 size_t num_samples, double* output);

/// Fits value[EVERETT_FREE] to difference[num_samples], output units, over an input from negative saturation:
/// as smooth as predicts stretches best that the fit has not seen. precision[EVERETT_FREE][EVERETT_FREE]:
/// upper triangle of the values' inverse covariance for errors of variance 1 of which `correlation` count as
/// one independent, where values beyond `largest` [output] are not expected. Returns the RMS that is left of
/// unseen stretches.
double everett_fit(const model_t* model, const double* input, const double* difference, size_t num_samples,
                   double correlation, double largest, double* value, double* precision);

#endif
