#include "hyst_f32_segments.h"

static void count(uint32_t* counter)
{
    if (*counter < UINT32_MAX) {
        ++*counter;
    }
}

/// The memory after a move; returns the plays' part of the output in its direction.
static inline float turn(const hyst_f32_model_t* model, hyst_f32_state_t* state, const bool rising,
                         const float ahead, const float plays)
{
    hyst_f32_front_t front;
    if (!hyst_f32_meet(model, state, rising, ahead, &front)) {
        return plays;
    }
    hyst_f32_segment_t* segment = &state->memory[front.index];
    if (front.index > state->front) {
        segment[-1].sum[rising] = front.end;
    }
    segment->level = ahead;
    segment->sum[rising] = front.sum;
    segment->last = (uint16_t)front.last;
    segment->rising = rising ? 1 : 0;
    state->front = front.index;
    // Rounding does not move the plays' part against the input.
    return hyst_f32_larger(front.sum, plays);
}

float hyst_f32_move(const hyst_f32_model_t* model, hyst_f32_state_t* state, const uint32_t cell,
                    const float v)
{
    const bool rising = v > state->input;
    if (!rising && !(v < state->input)) {
        return state->output;
    }
    const float sign = hyst_f32_sign(rising);
    const float ahead = sign * hyst_f32_envelope(model, cell, v, rising);
    state->plays = sign * turn(model, state, rising, ahead, sign * state->plays);
    state->input = v;
    state->cell = cell;
    state->output = hyst_f32_offset(model, cell, v) + state->plays;
    return state->output;
}

float hyst_f32_step_anywhere(const hyst_f32_model_t* model, hyst_f32_state_t* state, const float input)
{
    if (hyst_f32_is_nan(input)) {
        count(&state->invalid_inputs);
        return state->output;
    }
    const float v = hyst_f32_limit(input, model->input_min, model->input_max);
    if (v < input || v > input) {
        count(&state->clamped_inputs);
    }
    const bool rising = v > state->input;
    const uint32_t cell = hyst_f32_find_cell(model, rising ? state->cell : 0,
                                             rising ? hyst_f32_last_cell(model) : state->cell, v);
    return hyst_f32_move(model, state, cell, v);
}
