/// The inverse's two halves: following the line of the present point, and the search for a line further away.
#ifndef HYST_F32_INVERSE_H
#define HYST_F32_INVERSE_H

#include "hyst_f32_segments.h"

/// Where a line of the output over the input begins: a cell of the table in which the same plays move along.
/// Input, output and envelope are in the direction of the move, so that all increase.
typedef struct {
    float input;
    float output; ///< short of the wanted one
    float ahead;  ///< the envelope
    uint32_t cell;
    uint32_t kept;       ///< segments that are not taken, at least one where no play moves
    uint32_t num_moving; ///< plays 0 ... num_moving - 1 move
} line_t;

/// The curves' slopes in a cell, and where it ends in the direction of the move.
typedef struct {
    float envelope_slope, offset_slope, end;
} curves_t;

static inline curves_t hyst_f32_curves(const hyst_f32_model_t* model, const uint32_t cell, const bool rising)
{
    curves_t curves;
    if (model->num_knots == 0) {
        curves.envelope_slope = 1.0f;
        curves.offset_slope = model->nonhysteretic_slope;
        curves.end = rising ? model->input_max : -model->input_min;
        return curves;
    }
    const hyst_f32_knot_t* knot = &model->knot[cell];
    curves.envelope_slope = rising ? knot->ascending_slope : knot->descending_slope;
    curves.offset_slope = knot->nonhysteretic_slope;
    curves.end = rising ? knot[1].input : -knot->input;
    return curves;
}

/// Moves the line's beginning to the line that crosses `wanted`, which is further away. When it is out of
/// reach, the end of the reach takes its place, and *clamped is set.
void hyst_f32_locate(const hyst_f32_model_t* model, const hyst_f32_state_t* state, bool rising, float* wanted,
                     line_t* line, bool* clamped);

#endif
