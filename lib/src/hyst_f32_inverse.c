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

/// The envelope at which other plays move.
static inline float limit_of(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const bool rising,
                             const line_t* line)
{
    if (line->kept == 0) {
        return FLT_MAX;
    }
    const hyst_f32_segment_t* kept = &state->memory[line->kept - 1];
    return hyst_f32_is_along(kept, rising) ? kept->level
                                           : model->play[line->num_moving].opening - kept->level;
}

/// The end of the line, which `input` is beyond, or its beginning.
static float limited(const line_t* line, const curves_t* curves, const float limit, const float input)
{
    const float kink = line->input + (limit - line->ahead) / curves->envelope_slope;
    // A flat envelope gives no number where nothing limits it.
    float x = kink < input ? kink : input;
    x = x > line->input ? x : line->input;
    return x < curves->end ? x : curves->end;
}

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
    for (bool is_located = false;; is_located = true) {
        const curves_t curves = hyst_f32_curves(model, line.cell, rising);
        const float limit = limit_of(model, state, rising, &line);
        const float slope =
            curves.offset_slope + hyst_f32_slope(model->play, line.num_moving) * curves.envelope_slope;
        const float step = (wanted - line.output) / slope;
        const float input = line.input + step;
        if (step > 0.0f && input < curves.end && line.ahead + curves.envelope_slope * step <= limit) {
            result.input = sign * input;
            return result;
        }
        if (is_located) {
            result.input = sign * limited(&line, &curves, limit, input);
            return result;
        }
        hyst_f32_locate(model, state, rising, &wanted, &line, &result.clamped);
    }
}
