/// The knots of a table of chords.
#ifndef HYST_HOST_GRID_H
#define HYST_HOST_GRID_H

#include "model.h"

typedef struct {
    size_t num_knots;
    float* input; ///< [num_knots] strictly increasing, owned
    double error; ///< what the chords can put on the output: sum p max(|ascending|, |descending|) + |D|
} grid_t;

/// Knots from `low` to `high` (low < high) with an error of at most `tolerance`: every cell as long as it may
/// be, with the division of the tolerance between envelopes and non-hysteretic part, of 17, that needs the
/// fewest. num_knots is 0 when there is none with HYST_MAX_KNOTS knots at float inputs.
grid_t grid_find(const model_t* model, float low, float high, double tolerance);
void grid_free(grid_t* grid);

#endif
