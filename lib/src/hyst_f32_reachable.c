#include "hyst_f32_segments.h"

/// What hyst_f32_step to an end of the range gives, in its arithmetic.
static float end_of_range(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const bool rising)
{
    const float sign = hyst_f32_sign(rising);
    const float input = rising ? model->input_max : model->input_min;
    const uint32_t cell = rising ? hyst_f32_last_cell(model) : 0;
    hyst_f32_front_t front;
    float plays = sign * state->plays;
    if (hyst_f32_meet(model, state, rising, sign * hyst_f32_envelope(model, cell, input, rising), &front)) {
        plays = hyst_f32_larger(front.sum, plays);
    }
    return hyst_f32_offset(model, cell, input) + sign * plays;
}

hyst_f32_reach_t hyst_f32_reachable(const hyst_f32_model_t* model, const hyst_f32_state_t* state)
{
    const hyst_f32_reach_t here = {state->output, state->output};
    hyst_f32_reach_t reach = here;
    if (state->input > model->input_min) {
        reach.reachable_min = end_of_range(model, state, false);
    }
    if (state->input < model->input_max) {
        reach.reachable_max = end_of_range(model, state, true);
    }
    return reach;
}
