/// From the model in double precision to the one that firmware runs: float radii and weights, the curves as a
/// table of chords, and what that costs in accuracy.
#ifndef HYST_HOST_TABULATE_H
#define HYST_HOST_TABULATE_H

#include "hyst/hyst_f32.h"
#include "model.h"

typedef struct {
    hyst_f32_model_t model; ///< points into the arrays below
    float* radius;          ///< [num_plays], owned
    float* weight;          ///< [num_plays], owned
    hyst_f32_play_t* play;  ///< [num_plays], owned: the two as the library reads them
    hyst_f32_knot_t* knot;  ///< [num_knots], owned, or NULL for a classical model
    double table_error;     ///< what the chords can put on the output, output units
    double float_error;     ///< what storing and computing in float can put on it besides
} tabulated_t;

/// Tables on one grid for all three curves with few knots (grid.h) whose error is at most `table_error`
/// [output units, >= 0]. For every history of float inputs over the stored range, from negative saturation,
///   |float output - reference output| <= table_error + float_error   (those of the result).
/// A model that `prepare` finds classical gets no table. Returns NULL, or why there is no such table;
/// *tabulated is then empty. What lib/ thinks of the model is for hyst_f32_init to say.
const char* tabulate(const model_t* model, double table_error, tabulated_t* tabulated);
/// What `hyst emit` lets the tables change the output by unless told otherwise: 1e-4 of its range.
double tabulate_default_error(const model_t* model);
void tabulated_free(tabulated_t* tabulated);

#endif
