#include "hyst_f32_inverse.h"

/// How far the envelope is from where other plays move as well.
static inline float play_room(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                              const bool rising, const hyst_f32_line_t* line, const float ahead)
{
    if (line->kept == 0) {
        return FLT_MAX;
    }
    const hyst_f32_segment_t* kept = &state->memory[line->kept - 1];
    return hyst_f32_is_along(kept, rising)
               ? kept->level - ahead
               : model->play[line->num_moving].opening - (ahead + kept->level);
}

/// The next plays move as well.
static inline void pass_kink(const hyst_f32_state_t* state, const bool rising, hyst_f32_line_t* line)
{
    const hyst_f32_segment_t* kept = &state->memory[line->kept - 1];
    if (hyst_f32_is_along(kept, rising) || line->num_moving >= kept->last) {
        --line->kept;
        line->num_moving = kept->last;
    }
    ++line->num_moving;
}

/// Whether all plays together would take cells for it.
static inline bool is_far(const hyst_f32_model_t* model, const uint32_t cell, const hyst_f32_curves_t* curves,
                          const float rest)
{
    if (model->num_knots == 0) {
        return false;
    }
    const float steepest = curves->offset_slope + model->play[model->num_plays - 1].slope * curves->envelope_slope;
    return rest > (model->knot[cell + 1].input - model->knot[cell].input) * steepest;
}

/// Lines that are followed before the search.
enum { MOST_LINES = 4 };

hyst_f32_inverse_t hyst_f32_inverse(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                    float wanted)
{
    const bool rising = wanted > state->output;
    if (!rising && !(wanted < state->output)) {
        const hyst_f32_inverse_t held = {state->input, hyst_f32_is_nan(wanted)};
        return held;
    }
    const float sign = hyst_f32_sign(rising);
    wanted = sign * wanted;
    bool clamped = false;
    hyst_f32_line_t line = {sign * state->input, sign * state->output, state->cell, state->front + 1, 0};
    hyst_f32_curves_t curves = hyst_f32_curves(model, line.cell, rising, line.input);
    const hyst_f32_segment_t* top = &state->memory[state->front];
    if (hyst_f32_is_along(top, rising) && curves.ahead >= top->level) {
        line.kept = state->front;
        line.num_moving = top->last + 1u;
    }
    int left = MOST_LINES;
    for (;;) {
        const float play = play_room(model, state, rising, &line, curves.ahead);
        float slope = curves.offset_slope;
        if (line.num_moving != 0) {
            slope += model->play[line.num_moving - 1].slope * curves.envelope_slope;
        }
        const float rest = wanted - line.output;
        const float step = hyst_f32_larger(rest / slope, 0.0f);
        float input = line.input + step;
        if (input < curves.end && curves.envelope_slope * step <= play) {
            const hyst_f32_inverse_t near = {sign * input, clamped};
            return near;
        }
        const float room = play / curves.envelope_slope;
        const float kink = line.input + room;
        if (left < 0) {
            // A flat envelope gives no number where nothing limits it.
            input = kink < input ? kink : input;
            input = input > line.input ? input : line.input;
            const hyst_f32_inverse_t far = {sign * (input < curves.end ? input : curves.end), clamped};
            return far;
        }
        if (left == MOST_LINES && is_far(model, line.cell, &curves, rest)) {
            left = 0;
        }
        const bool is_kink = kink < curves.end;
        --left;
        if (is_kink && left >= 0 && room >= 0.0f) {
            line.input = kink;
            line.output += slope * room;
            curves.ahead += play;
            pass_kink(state, rising, &line);
            continue;
        }
        if (is_kink || left < 0 || line.cell == (rising ? hyst_f32_last_cell(model) : 0)) {
            left = -1;
            hyst_f32_search_t search = {line, wanted, false};
            hyst_f32_locate(model, state, rising, &search);
            line = search.line;
            wanted = search.wanted;
            clamped = search.clamped;
        } else {
            line.output += slope * (curves.end - line.input);
            line.input = curves.end;
            line.cell = rising ? line.cell + 1 : line.cell - 1;
        }
        curves = hyst_f32_curves(model, line.cell, rising, line.input);
    }
}
