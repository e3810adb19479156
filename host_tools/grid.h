/// The knots of a table of chords.
#ifndef HYST_HOST_GRID_H
#define HYST_HOST_GRID_H

#include "model.h"

/// Which inputs there are, and so where knots may lie.
typedef enum { GRID_OF_FLOATS, GRID_OF_INTEGERS } grid_inputs_t;

typedef struct {
    size_t num_knots;
    double* input; ///< [num_knots] strictly increasing, owned
    double error;  ///< what the chords can put on the output: sum p max(|ascending|, |descending|) + |D|
} grid_t;

/// Knots from `low` to `high` (low < high, both of these inputs) with an error of at most `tolerance`: every
/// cell as long as it may be, with the division of the tolerance between envelopes and non-hysteretic part,
/// of 17, that needs the fewest. Between neighbouring integers there is no input to be off at, so that a cell
/// of one is always allowed. num_knots is 0 when there is no such grid with HYST_MAX_KNOTS knots.
grid_t grid_find(const model_t* model, grid_inputs_t inputs, double low, double high, double tolerance);
void grid_free(grid_t* grid);

#endif
