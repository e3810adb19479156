#include "hyst_q_internal.h"

uint32_t HYST_Q(find_cell)(const hyst_q_model_t* model, const uint32_t guess, const hyst_q_value_t v)
{
    const hyst_q_knot_t* knot = model->knot;
    uint32_t low = guess;
    uint32_t high = guess;
    if (v < knot[guess].input) {
        low = v < knot[guess - 1].input ? 0 : guess - 1;
        high = guess - 1;
    } else if (v > knot[guess + 1].input) {
        low = guess + 1;
        high = v > knot[guess + 2].input ? model->num_knots - 2 : guess + 1;
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

/// Where play 0 of a segment's plays begins: behind the segment above it.
static uint32_t first_play(const hyst_q_state_t* state, const uint32_t segment)
{
    return segment + 1 < state->num_segments ? state->segment[segment + 1].end : 0;
}

/// How many segments at the bottom of the stack do not move as a whole. The plays that move are the first
/// ones, so these are found by halving; the two topmost are tried first, which is all there is to do for a
/// smooth input.
static uint32_t count_kept(const hyst_q_model_t* model, const hyst_q_state_t* state, const uint32_t level,
                           const bool rising)
{
    uint32_t high = state->num_segments;
    uint32_t low = high > 2 ? high - 2 : 0;
    while (low < high) {
        const hyst_q_segment_t* segment = &state->segment[high - 1];
        if (!hyst_q_moves(model, segment, segment->end - 1U, level, rising)) {
            return high;
        }
        --high;
    }
    low = 0;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const hyst_q_segment_t* segment = &state->segment[middle];
        if (hyst_q_moves(model, segment, segment->end - 1U, level, rising)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

/// How many plays move, when those before `begin` do and the last of `segment` does not.
static uint32_t count_moved(const hyst_q_model_t* model, const hyst_q_segment_t* segment,
                            const uint32_t begin, const uint32_t level, const bool rising)
{
    if (!hyst_q_moves(model, segment, begin, level, rising)) {
        return begin;
    }
    uint32_t low = begin + 1;
    uint32_t high = segment->end - 1U;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (hyst_q_moves(model, segment, middle, level, rising)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

hyst_q_front_t HYST_Q(find_front)(const hyst_q_model_t* model, const hyst_q_state_t* state,
                                  const uint32_t level, const bool rising)
{
    hyst_q_front_t front = {model->num_plays, count_kept(model, state, level, rising), 0};
    if (front.num_kept == 0) {
        return front;
    }
    const hyst_q_segment_t* cut = &state->segment[front.num_kept - 1];
    const uint32_t begin = first_play(state, front.num_kept - 1);
    front.end = count_moved(model, cut, begin, level, rising);
    if (front.end == begin && front.num_kept < state->num_segments) {
        front.below = state->segment[front.num_kept].below;
    } else {
        front.below = cut->below + hyst_q_part(model, front.end, cut->end, cut->level, cut->falling);
    }
    return front;
}

/// Lets the envelope push the plays that it reaches.
static void push(const hyst_q_model_t* model, hyst_q_state_t* state, const uint32_t level, const bool rising)
{
    const hyst_q_segment_t* top = &state->segment[state->num_segments - 1];
    if (!hyst_q_moves(model, top, 0, level, rising)) {
        return;
    }
    const hyst_q_front_t front = HYST_Q(find_front)(model, state, level, rising);
    hyst_q_segment_t* segment = &state->segment[front.num_kept];
    segment->below = front.below;
    segment->level = level;
    segment->end = (uint16_t)front.end;
    segment->falling = rising ? 0 : 1;
    state->num_segments = front.num_kept + 1;
    state->sum = front.below + hyst_q_part(model, 0, front.end, level, !rising);
}

void HYST_Q(saturate)(const hyst_q_model_t* model, hyst_q_state_t* state, const uint32_t level,
                      const bool falling)
{
    hyst_q_segment_t* segment = &state->segment[0];
    segment->below = 0;
    segment->level = level;
    segment->end = (uint16_t)model->num_plays;
    segment->falling = falling ? 1 : 0;
    state->num_segments = 1;
    state->sum = hyst_q_part(model, 0, model->num_plays, level, falling);
}

void HYST_Q(stack_play)(const hyst_q_model_t* model, hyst_q_state_t* state, const uint32_t j,
                        const uint32_t w, const uint32_t inner_w)
{
    if (j + 1 == model->num_plays) {
        state->num_segments = 0;
        state->sum = 0;
    }
    const uint32_t radius = model->radius[j];
    const bool joins =
        state->num_segments > 0 && hyst_q_play(model, &state->segment[state->num_segments - 1], j) == w;
    if (!joins) {
        // A falling segment's level must not lie below 0; a rising one's may lie above every envelope.
        const bool falling = j > 0 && w >= radius && inner_w + radius == w + model->radius[j - 1];
        hyst_q_segment_t* segment = &state->segment[state->num_segments];
        segment->below = state->sum;
        segment->level = falling ? w - radius : w + radius;
        segment->end = (uint16_t)(j + 1);
        segment->falling = falling ? 1 : 0;
        ++state->num_segments;
    }
    const uint32_t weight = (uint32_t)(model->cumulative_weight[j + 1] - model->cumulative_weight[j]);
    state->sum += (hyst_q_sum_t)weight * w;
}

void HYST_Q(place)(const hyst_q_model_t* model, hyst_q_state_t* state, const hyst_q_value_t input)
{
    state->input = input;
    state->cell = HYST_Q(find_cell)(model, 0, input);
    state->output = hyst_q_output(model, state->cell, input, state->sum);
}

static hyst_q_value_t move(const hyst_q_model_t* model, hyst_q_state_t* state, const hyst_q_value_t v)
{
    if (v == state->input) {
        return state->output;
    }
    const bool rising = v > state->input;
    const uint32_t cell = HYST_Q(find_cell)(model, state->cell, v);
    push(model, state, hyst_q_envelope(model, cell, v, rising), rising);
    state->input = v;
    state->cell = cell;
    state->output = hyst_q_output(model, cell, v, state->sum);
    return state->output;
}

hyst_q_value_t HYST_Q(step)(const hyst_q_model_t* model, hyst_q_state_t* state, const hyst_q_value_t input)
{
    if (input >= model->input_min && input <= model->input_max) {
        return move(model, state, input);
    }
    if (state->clamped_inputs < UINT32_MAX) {
        ++state->clamped_inputs;
    }
    return move(model, state, input < model->input_min ? model->input_min : model->input_max);
}
