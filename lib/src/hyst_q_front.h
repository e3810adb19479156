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

static inline hyst_q_front_t front_at(const hyst_q_model_t* model, const hyst_q_state_t* state,
                                      const uint32_t num_kept, const uint32_t end)
{
    hyst_q_front_t front = {end, num_kept, 0};
    if (num_kept == 0) {
        return front;
    }
    const hyst_q_segment_t* cut = &state->segment[num_kept - 1];
    if (end == first_play(state, num_kept - 1) && num_kept < state->num_segments) {
        front.below = hyst_q_below(model, &state->segment[num_kept]);
    } else {
        front.below = hyst_q_below(model, cut) + hyst_q_part(model, end, cut->end, cut->level, cut->falling);
    }
    return front;
}

hyst_q_front_t HYST_Q(front_at)(const hyst_q_model_t* model, const hyst_q_state_t* state,
                                const uint32_t num_kept, const uint32_t end)
{
    return front_at(model, state, num_kept, end);
}

hyst_q_front_t HYST_Q(find_front)(const hyst_q_model_t* model, const hyst_q_state_t* state,
                                  const uint32_t level, const bool rising)
{
    const uint32_t num_kept = count_kept(model, state, level, rising);
    if (num_kept == 0) {
        return front_at(model, state, 0, model->num_plays);
    }
    const uint32_t begin = first_play(state, num_kept - 1);
    const uint32_t end = count_moved(model, &state->segment[num_kept - 1], begin, level, rising);
    return front_at(model, state, num_kept, end);
}

void HYST_Q(replace)(const hyst_q_model_t* model, hyst_q_state_t* state, const uint32_t level,
                     const bool rising)
{
    const hyst_q_front_t front = HYST_Q(find_front)(model, state, level, rising);
    hyst_q_segment_t* segment = &state->segment[front.num_kept];
    segment->rest = rising ? front.below - model->cumulative_moment[front.end]
                           : front.below + model->cumulative_moment[front.end];
    segment->level = level;
    segment->end = (uint16_t)front.end;
    segment->falling = rising ? 0 : 1;
    state->num_segments = front.num_kept + 1;
    state->sum = hyst_q_front_sum(model, segment, level);
}
