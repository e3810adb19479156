#include "hyst_f32_internal.h"

uint32_t hyst_f32_find_cell(const hyst_f32_model_t* model, const uint32_t guess, const float v)
{
    if (model->num_knots == 0) {
        return 0;
    }
    const hyst_f32_knot_t* knot = model->knot;
    uint32_t low = guess;
    uint32_t high = guess;
    if (v < knot[guess].input) {
        low = v < knot[guess - 1].input ? 0 : guess - 1;
        high = guess - 1;
    } else if (!(v < knot[guess + 1].input) && guess + 2 < model->num_knots) {
        low = guess + 1;
        high = v < knot[guess + 2].input ? guess + 1 : model->num_knots - 2;
    }
    while (low < high) {
        const uint32_t middle = high - (high - low) / 2;
        if (v < knot[middle].input) {
            high = middle - 1;
        } else {
            low = middle;
        }
    }
    return low;
}

void hyst_f32_place(const hyst_f32_model_t* model, hyst_f32_state_t* state, const float input)
{
    state->input = input;
    state->cell = hyst_f32_find_cell(model, 0, input);
    const float offset = model->constant + hyst_f32_nonhysteretic(model, state->cell, input);
    // An envelope below every reach moves no play.
    state->output = hyst_f32_respond(model, state->memory, NULL, -FLT_MAX, true, offset);
}

void hyst_f32_saturate_negative(const hyst_f32_model_t* model, hyst_f32_state_t* state)
{
    const float envelope = hyst_f32_envelope(model, 0, model->input_min, false);
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        state->memory[j] = hyst_f32_pushed(envelope, model->radius[j], false);
    }
    hyst_f32_place(model, state, model->input_min);
}

float hyst_f32_move(const hyst_f32_model_t* model, hyst_f32_state_t* state, const float v)
{
    const bool rising = v > state->input;
    if (!rising && !(v < state->input)) {
        return state->output;
    }
    const uint32_t cell = hyst_f32_find_cell(model, state->cell, v);
    const float offset = model->constant + hyst_f32_nonhysteretic(model, cell, v);
    const float envelope = hyst_f32_envelope(model, cell, v, rising);
    const float output = rising
                             ? hyst_f32_respond(model, state->memory, state->memory, envelope, true, offset)
                             : hyst_f32_respond(model, state->memory, state->memory, envelope, false, offset);
    state->input = v;
    state->output = output;
    state->cell = cell;
    return output;
}

static void count(uint32_t* counter)
{
    if (*counter < UINT32_MAX) {
        ++*counter;
    }
}

float hyst_f32_step(const hyst_f32_model_t* model, hyst_f32_state_t* state, const float input)
{
    if (hyst_f32_is_nan(input)) {
        count(&state->invalid_inputs);
        return state->output;
    }
    if (input < model->input_min || input > model->input_max) {
        count(&state->clamped_inputs);
        return hyst_f32_move(model, state, hyst_f32_limit(input, model->input_min, model->input_max));
    }
    return hyst_f32_move(model, state, input);
}
