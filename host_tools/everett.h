/// What a plant of Preisach's kind does beside a GPI model. Both wipe out and are congruent, so their
/// difference follows from one function of two reversals, the Everett function E(alpha, beta), and is linear
/// in its coefficients. A model of few plays is stepped where a plant's function is smooth; what is fitted is
/// therefore a smooth function and a share of the model, which may take some of the model itself away.
/// Source: I. D. Mayergoyz, Mathematical Models of Hysteresis (1991), ch. 1.
#ifndef HYST_HOST_EVERETT_H
#define HYST_HOST_EVERETT_H

#include "model.h"

enum {
    EVERETT_CELLS = 16,                                      ///< over the input's range
    EVERETT_BASIS = EVERETT_CELLS + 3,                       ///< cubic B-splines over them
    EVERETT_NODES = EVERETT_BASIS * (EVERETT_BASIS - 1) / 2, ///< products of two; E(beta, alpha) = -E
    EVERETT_CONSTANT = EVERETT_NODES,
    EVERETT_SHARE,             ///< of the model's output about its middle, as a part of what that spans
    EVERETT_FREE,              ///< coefficients
    EVERETT_MOST_EXTREMES = 64 ///< that are remembered
};

/// The model's ranges.
typedef struct {
    double input_min, input_max;
    double output_middle, output_span;
} everett_range_t;

/// The reversals that the memory holds, as parts of the range: a minimum, a maximum, a minimum ...
typedef struct {
    everett_range_t range;
    double extreme[EVERETT_MOST_EXTREMES];
    size_t count;
    double present;
} everett_past_t;

/// Negative saturation.
everett_past_t everett_start(const model_t* model);
/// Moves to `input`, limited to the range, where the model gives model_output; row[EVERETT_FREE]: the
/// difference's derivatives by the coefficients.
void everett_step(everett_past_t* past, double input, double model_output, double* row);

/// The difference itself.
typedef struct {
    everett_range_t range;
    double value[EVERETT_FREE]; ///< coefficients [output]
} everett_t;

everett_t everett_none(const model_t* model);
/// The coefficient of the product of the splines alpha > beta.
size_t everett_node(size_t alpha, size_t beta);
/// Adds it over an input[num_samples] from negative saturation, ahead of which the input turned at
/// turn[num_turns], to output[num_samples]. model_output[num_samples]: what the model gives there.
void everett_add(const everett_t* everett, const double* turn, size_t num_turns, const double* input,
                 const double* model_output, size_t num_samples, double* output);

#endif
