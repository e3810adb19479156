/// The inverse's two halves: following the line of the present point, and the search for a line further away.
#ifndef HYST_F32_INVERSE_H
#define HYST_F32_INVERSE_H

#include "hyst_f32_segments.h"

/// Where a line of the output over the input begins: a cell of the table in which the same plays move along.
/// Input and output are in the direction of the move, so that both increase.
typedef struct {
    float input;
    float output; ///< short of the wanted one
    uint32_t cell;
    uint32_t kept;       ///< segments that are not taken, at least one where no play moves
    uint32_t num_moving; ///< plays 0 ... num_moving - 1 move
} hyst_f32_line_t;

/// The curves in a cell, in the direction of the move: their slopes, the envelope at an input, the cell's
/// end.
typedef struct {
    float envelope_slope, offset_slope;
    float ahead;
    float end;
} hyst_f32_curves_t;

static inline hyst_f32_curves_t hyst_f32_curves(const hyst_f32_model_t* model, const uint32_t cell,
                                                const bool rising, const float input)
{
    hyst_f32_curves_t curves;
    if (model->num_knots == 0) {
        curves.envelope_slope = 1.0f;
        curves.offset_slope = model->nonhysteretic_slope;
        curves.ahead = input;
        curves.end = (rising ? model->input_max : -model->input_min);
        return curves;
    }
    const hyst_f32_knot_t* knot = &model->knot[cell];
    curves.envelope_slope = rising ? knot->ascending_slope : knot->descending_slope;
    curves.offset_slope = knot->nonhysteretic_slope;
    curves.ahead = (rising ? knot->ascending : -knot->descending) +
                   curves.envelope_slope * (input - hyst_f32_toward(knot->input, rising));
    curves.end = (rising ? knot[1].input : -knot->input);
    return curves;
}

/// The line that crosses a wanted output.
typedef struct {
    hyst_f32_line_t line;     ///< before the search: the one of the present point
    hyst_f32_curves_t curves; ///< where it begins
    float wanted; ///< in the direction of the move; where that is out of reach, the end of the reach
    bool clamped; ///< it was out of reach
} hyst_f32_found_t;

/// Finds it wherever it is. Changes nothing but `wanted` and `clamped` where the present input is the answer.
void hyst_f32_locate(const hyst_f32_model_t* model, const hyst_f32_state_t* state, bool rising,
                     hyst_f32_found_t* found);

#endif
