/// The inner problem of identification: for given curves the weights, the non-hysteretic coefficients and the
/// constant are one non-negative least-squares problem; the curves are searched around it (variable
/// projection, Golub and Pereyra 1973, with Kaufman's Jacobian, by MINPACK's Levenberg-Marquardt).
#ifndef HYST_HOST_IDENTIFY_FIT_H
#define HYST_HOST_IDENTIFY_FIT_H

#include "identify_shape.h"
#include "message.h"

/// What is fitted: samples over the scaled input, and the memory they start from.
typedef struct {
    size_t num_samples;
    const double* u;  ///< [num_samples] scaled inputs, -1 ... 1
    const double* y;  ///< [num_samples] outputs
    const bool* used; ///< [num_samples] whether a sample enters the fit; all of them move the plays
    start_t start;    ///< START_NEGATIVE_SATURATION, START_POSITIVE_SATURATION or START_MODEL: `fraction`
    const double*
        fraction;      ///< [num_plays] of START_MODEL: where in its strip at u[0] each play begins, -1 ... 1
    double smoothness; ///< weight of the second differences of p over r against the fit; 0: none
} fit_samples_t;

typedef struct {
    const shape_t* shape; ///< borrowed
    double* theta;        ///< [shape->num_parameters]
    size_t num_plays;
    double* radius;      ///< [num_plays] in the envelopes' scaled units, follow from theta
    double* weight;      ///< [num_plays] >= 0
    double* coefficient; ///< [shape_num_nonhysteretic] >= 0
    double constant;
    bool* passive; ///< [num_plays + coefficients] warm start of the next fit
    bool* moved;   ///< [num_plays] whether the used samples see the play move at all
    double rmse;   ///< over the used samples
    double kkt;    ///< of the last non-negative least squares
} fit_t;

fit_t fit_new(const shape_t* shape, size_t num_plays);
/// A fit of the same size with the same values, for trying something else.
void fit_assign(fit_t* to, const fit_t* from);
void fit_free(fit_t* fit);

/// Radii, weights, coefficients and constant for the present theta.
outcome_t fit_weights(fit_t* fit, const fit_samples_t* samples);
/// Searches theta for the least rmse from the present one; at most max_evaluations of the curves.
outcome_t fit_search(fit_t* fit, const fit_samples_t* samples, int max_evaluations);
/// The fitted model's output at every sample, used or not: output[num_samples].
void fit_output(const fit_t* fit, const fit_samples_t* samples, double* output);

#endif
