/// A Duhem body: rate-independent hysteresis with one state, the output itself, whose slope over the input
/// depends on the point in the plane and on the direction, dy/du = g+-(u, y). Bouc-Wen, Dahl and
/// Jiles-Atherton elements are of this kind, and unlike plays they need not wipe out their past at a larger
/// extreme: small cycles ratchet. Where a plant's calibration shows that it is of this kind, this body stands
/// in for the plays, so that what the plant was from the start is not taken for an effect.
/// Source: B. D. Coleman, M. L. Hodgdon, Int. J. Eng. Sci. 24 (1986) 897.
#ifndef HYST_HOST_DUHEM_H
#define HYST_HOST_DUHEM_H

#include "model.h"

enum {
    DUHEM_COLUMNS = 15, ///< nodes over the input's range
    DUHEM_ROWS = 9,     ///< nodes from one branch of the model's major loop to the other
    DUHEM_NODES = DUHEM_COLUMNS * DUHEM_ROWS,
    DUHEM_FREE = 2 * DUHEM_NODES + 1 ///< numbers that a fit may choose: slopes and `saturated`
};

typedef struct {
    double input_min, input_max;
    double middle[DUHEM_COLUMNS]; ///< of the major loop, output units
    double width[DUHEM_COLUMNS];  ///< from there to the first and the last row
    double slope[2][DUHEM_NODES]; ///< [0] falling, [1] rising: output units for the whole input range, linear
                                  ///< between nodes, constant beyond the grid
    double saturated;             ///< the output at input_min after a descent to it
} duhem_t;

/// The grid over the model's major loop, every slope that of the loop's middle.
duhem_t duhem_new(const model_t* model);

/// Sample by sample.
typedef struct {
    const duhem_t* duhem;
    double input; ///< as a part of the range, within it
    double output;
    double* derivative;  ///< [DUHEM_FREE] of the output by the free numbers, or NULL
    const double* guide; ///< slopes are taken along the line to this output, not along its own; or NULL
} duhem_state_t;

/// Before the first sample `first`: negative saturation, or from another past the model's own output at
/// `first`. derivative: NULL or set to the start's.
duhem_state_t duhem_start(const duhem_t* duhem, const model_t* model, start_t start, double first,
                          double* derivative);
/// Moves to `input` [input units], limited to the range; the output there.
double duhem_step(duhem_state_t* state, double input);

/// output[num_samples] for input[num_samples]; the first one raised by `shift`, from where the rest follows.
void duhem_run(const duhem_t* duhem, const model_t* model, start_t start, double shift, const double* input,
               size_t num_samples, double* output);

#endif
