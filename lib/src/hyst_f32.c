#include "hyst_f32_segments.h"

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
    state->output = hyst_f32_offset(model, state->cell, input) + state->plays;
}

void hyst_f32_saturate_negative(const hyst_f32_model_t* model, hyst_f32_state_t* state)
{
    hyst_f32_segment_t* outermost = state->memory;
    outermost->level = hyst_f32_envelope(model, 0, model->input_min, false);
    outermost->last = (uint16_t)(model->num_plays - 1);
    outermost->rising = 0;
    hyst_f32_sum_up(model, state->memory, 0);
    state->front = 0;
    state->plays = outermost->sum[0];
    hyst_f32_place(model, state, model->input_min);
}

/// The move that goes on: the front's plays and perhaps the next few move along, and no segment is taken.
/// False where it is not that.
static inline bool extend(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const bool rising,
                          const float ahead, hyst_f32_front_t* front)
{
    const hyst_f32_segment_t* top = &state->memory[state->front];
    if ((top->rising != 0) != rising || state->front == 0 || !(hyst_f32_beyond(top, rising, ahead) > 0.0f)) {
        return false;
    }
    const hyst_f32_segment_t* kept = top - 1;
    const float x = hyst_f32_beyond(kept, rising, ahead);
    if (hyst_f32_is_taken(model->play, kept, rising, x)) {
        return false;
    }
    front->index = state->front;
    front->last = (kept->rising != 0) == rising
                      ? top->last
                      : hyst_f32_last_moved(model->play, top->last, kept->last - 1u, x);
    front->sum = hyst_f32_over(model->play, kept, rising, front->last, x);
    return true;
}

/// Makes `front` the front, left by a move to `envelope`. Returns the plays' part of the output: rounding
/// does not move it against the input.
static float commit(hyst_f32_state_t* state, const bool rising, const float envelope,
                    const hyst_f32_front_t* front)
{
    hyst_f32_segment_t* segment = &state->memory[front->index];
    if (front->index > state->front) {
        segment[-1].sum[rising] = front->end;
    }
    const float sum = hyst_f32_forward(front->sum, rising);
    segment->level = envelope;
    segment->sum[rising] = sum;
    segment->last = (uint16_t)front->last;
    segment->rising = rising ? 1 : 0;
    state->front = front->index;
    if (rising ? sum > state->plays : sum < state->plays) {
        state->plays = sum;
    }
    return state->plays;
}

/// Moves the state to v, finite and in `cell`; returns the output.
static float move(const hyst_f32_model_t* model, hyst_f32_state_t* state, const uint32_t cell, const float v)
{
    const bool rising = v > state->input;
    if (!rising && !(v < state->input)) {
        return state->output;
    }
    const float envelope = hyst_f32_envelope(model, cell, v, rising);
    hyst_f32_front_t front;
    float plays = state->plays;
    if (extend(model, state, rising, hyst_f32_forward(envelope, rising), &front) ||
        hyst_f32_meet(model, state, rising, envelope, &front)) {
        plays = commit(state, rising, envelope, &front);
    }
    const float output = hyst_f32_offset(model, cell, v) + plays;
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
    float v = input;
    if (input < model->input_min || input > model->input_max) {
        count(&state->clamped_inputs);
        v = hyst_f32_limit(input, model->input_min, model->input_max);
    }
    return move(model, state, hyst_f32_find_cell(model, state->cell, v), v);
}
