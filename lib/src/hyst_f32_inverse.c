#include "hyst_f32_inverse.h"

/// The line of the present point.
static inline line_t present_line(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                  const bool rising)
{
    const hyst_f32_segment_t* top = &state->memory[state->front];
    const float sign = hyst_f32_sign(rising);
    line_t line;
    line.input = sign * state->input;
    line.output = sign * state->output;
    line.ahead = sign * hyst_f32_envelope(model, state->cell, state->input, rising);
    line.cell = state->cell;
    line.kept = state->front + 1;
    line.num_moving = 0;
    if (hyst_f32_is_along(top, rising) && line.ahead >= top->level) {
        line.kept = state->front;
        line.num_moving = top->last + 1u;
    }
    return line;
}

/// How far the envelope is from where other plays move as well.
static inline float play_room(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                              const bool rising, const line_t* line)
{
    if (line->kept == 0) {
        return FLT_MAX;
    }
    const hyst_f32_segment_t* kept = &state->memory[line->kept - 1];
    return hyst_f32_is_along(kept, rising)
               ? kept->level - line->ahead
               : model->play[line->num_moving].opening - (line->ahead + kept->level);
}

/// The next plays move as well.
static inline void pass_kink(const hyst_f32_state_t* state, const bool rising, line_t* line)
{
    const hyst_f32_segment_t* kept = &state->memory[line->kept - 1];
    if (hyst_f32_is_along(kept, rising) || line->num_moving >= kept->last) {
        --line->kept;
        line->num_moving = kept->last;
    }
    ++line->num_moving;
}

#ifndef TRIES
#define TRIES 2
#endif

hyst_f32_inverse_t hyst_f32_inverse(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                    float wanted)
{
    hyst_f32_inverse_t result = {state->input, hyst_f32_is_nan(wanted)};
    const bool rising = wanted > state->output;
    if (!rising && !(wanted < state->output)) {
        return result;
    }
    const float sign = hyst_f32_sign(rising);
    wanted = sign * wanted;
    line_t line = present_line(model, state, rising);
    for (int tries = TRIES;; --tries) {
        const curves_t curves = hyst_f32_curves(model, line.cell, rising);
        const float play = play_room(model, state, rising, &line);
        float slope = curves.offset_slope;
        if (line.num_moving != 0) {
            slope += model->play[line.num_moving - 1].slope * curves.envelope_slope;
        }
        const float step = hyst_f32_larger((wanted - line.output) / slope, 0.0f);
        float input = line.input + step;
        if (input < curves.end && curves.envelope_slope * step <= play) {
            result.input = sign * input;
            return result;
        }
        float room = play / curves.envelope_slope;
        const float kink = line.input + room;
        if (tries < 0) {
            // A flat envelope gives no number where nothing limits it.
            input = kink < input ? kink : input;
            input = input > line.input ? input : line.input;
            result.input = sign * (input < curves.end ? input : curves.end);
            return result;
        }
        const bool is_kink = kink < curves.end;
        if (tries == 0 || room < 0.0f || (!is_kink && line.cell == (rising ? hyst_f32_last_cell(model) : 0))) {
            tries = 0;
            hyst_f32_locate(model, state, rising, &wanted, &line, &result.clamped);
            continue;
        }
        if (is_kink) {
            line.input = kink;
            line.ahead += play;
            pass_kink(state, rising, &line);
        } else {
            room = curves.end - line.input;
            line.input = curves.end;
            line.cell = rising ? line.cell + 1 : line.cell - 1;
            line.ahead = sign * hyst_f32_envelope(model, line.cell, sign * line.input, rising);
        }
        line.output += slope * room;
    }
}
