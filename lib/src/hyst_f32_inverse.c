#include "hyst_f32_inverse.h"

/// The line of the present point, where the curves are `curves`.
static inline hyst_f32_line_t present_line(const hyst_f32_state_t* state, const bool rising,
                                           const hyst_f32_curves_t* curves)
{
    const hyst_f32_segment_t* top = &state->memory[state->front];
    hyst_f32_line_t line = {hyst_f32_toward(state->input, rising), hyst_f32_toward(state->output, rising),
                            state->cell, state->front + 1, 0};
    if (hyst_f32_is_along(top, rising) && curves->ahead >= top->level) {
        line.kept = state->front;
        line.num_moving = top->last + 1u;
    }
    return line;
}

/// Slope of the output over the input.
static inline float slope_of(const hyst_f32_model_t* model, const hyst_f32_line_t* line,
                             const hyst_f32_curves_t* curves)
{
    if (line->num_moving == 0) {
        return curves->offset_slope;
    }
    return curves->offset_slope + model->play[line->num_moving - 1].slope * curves->envelope_slope;
}

/// How far the envelope is from where more plays move.
static inline float push_to_kink(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                 const bool rising, const hyst_f32_line_t* line, const float ahead)
{
    if (line->kept == 0) {
        return FLT_MAX;
    }
    const hyst_f32_segment_t* kept = &state->memory[line->kept - 1];
    return hyst_f32_is_along(kept, rising) ? kept->level - ahead
                                           : model->play[line->num_moving].opening - (ahead + kept->level);
}

/// Whether even all plays together would take more than a cell for `rest`.
static inline bool is_far(const hyst_f32_model_t* model, const uint32_t cell, const hyst_f32_curves_t* curves,
                          const float rest)
{
    if (model->num_knots == 0) {
        return false;
    }
    const float steepest =
        curves->offset_slope + model->play[model->num_plays - 1].slope * curves->envelope_slope;
    return rest > (model->knot[cell + 1].input - model->knot[cell].input) * steepest;
}

/// The next line, where more plays move.
static inline void pass_kink(const hyst_f32_state_t* state, const bool rising, hyst_f32_line_t* line)
{
    const hyst_f32_segment_t* kept = &state->memory[line->kept - 1];
    if (hyst_f32_is_along(kept, rising) || line->num_moving >= kept->last) {
        --line->kept;
        line->num_moving = kept->last;
    }
    ++line->num_moving;
}

/// Goes on to the next line: past the kink at the input `kink`, or to the next cell. False where there is
/// none.
static inline bool pass(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const bool rising,
                        const float kink, const float push, hyst_f32_line_t* line, hyst_f32_curves_t* curves)
{
    const float slope = slope_of(model, line, curves);
    if (kink < curves->end) {
        if (!(kink >= line->input)) {
            return false;
        }
        line->output += slope * (kink - line->input);
        line->input = kink;
        curves->ahead += push;
        pass_kink(state, rising, line);
        return true;
    }
    if (line->cell == (rising ? hyst_f32_last_cell(model) : 0)) {
        return false;
    }
    line->output += slope * (curves->end - line->input);
    line->input = curves->end;
    line->cell = rising ? line->cell + 1 : line->cell - 1;
    *curves = hyst_f32_curves(model, line->cell, rising, line->input);
    return true;
}

/// An input beyond the line, by rounding alone, brought back to it. A flat envelope gives no number for a
/// kink that does not limit it.
static inline float limited(const hyst_f32_line_t* line, const float end, const float kink, const float input)
{
    const float x = hyst_f32_larger(kink < input ? kink : input, line->input);
    return x < end ? x : end;
}

static inline hyst_f32_inverse_t answer(const float input, const bool rising, const bool clamped)
{
    const hyst_f32_inverse_t found = {hyst_f32_toward(input, rising), clamped};
    return found;
}

/// Lines that are followed beyond the first before the search.
enum { MOST_LINES = 4 };

hyst_f32_inverse_t hyst_f32_inverse(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                    const float wanted)
{
    const bool rising = wanted > state->output;
    if (!rising && !(wanted < state->output)) {
        return answer(state->input, true, hyst_f32_is_nan(wanted));
    }
    float goal = hyst_f32_toward(wanted, rising);
    bool clamped = false;
    hyst_f32_curves_t curves =
        hyst_f32_curves(model, state->cell, rising, hyst_f32_toward(state->input, rising));
    hyst_f32_line_t line = present_line(state, rising, &curves);
    const uint32_t kept = line.kept;
    const uint32_t num_moving = line.num_moving;
    for (int left = MOST_LINES;; --left) {
        const float push = push_to_kink(model, state, rising, &line, curves.ahead);
        const float rest = goal - line.output;
        const float step = rest / slope_of(model, &line, &curves);
        const float input = line.input + step;
        if (step > 0.0f && input < curves.end && curves.envelope_slope * step <= push) {
            return answer(input, rising, clamped);
        }
        if (!(rest > 0.0f)) {
            return answer(line.input, rising, clamped);
        }
        // + 0: a slope of -0 has no direction.
        const float kink = line.input + push / (curves.envelope_slope + 0.0f);
        if (left < 0) {
            return answer(limited(&line, curves.end, kink, input), rising, clamped);
        }
        if (left == MOST_LINES && is_far(model, line.cell, &curves, rest)) {
            left = 0;
        }
        if (left > 0 && pass(model, state, rising, kink, push, &line, &curves)) {
            continue;
        }
        // From the present point: where the output is flat, what the lines gathered in rounding would count.
        hyst_f32_found_t found = {{hyst_f32_toward(state->input, rising),
                                   hyst_f32_toward(state->output, rising), state->cell, kept, num_moving},
                                  curves,
                                  goal,
                                  false};
        hyst_f32_locate(model, state, rising, &found);
        line = found.line;
        curves = found.curves;
        goal = found.wanted;
        clamped = found.clamped;
        left = 0;
    }
}
