#include "hyst_q_internal.h"

/// Lets the topmost segment, pushed the way it went last, take up those plays of the next one that it reaches
/// now. False, and nothing changed, when these are more than a few or all of the next one.
static bool take_up(const hyst_q_model_t* model, hyst_q_segment_t* top, const uint32_t level,
                    const bool rising)
{
    enum { FEW = 4 };
    const hyst_q_segment_t* next = top - 1;
    uint32_t end = top->end;
    hyst_q_sum_t rest = top->rest;
    for (uint32_t taken = 0; taken <= FEW; ++taken) {
        if (!hyst_q_moves(model, next, end, level, rising)) {
            top->end = (uint16_t)end;
            top->rest = rest;
            return true;
        }
        const uint32_t weight = (uint32_t)(model->cumulative_weight[end + 1] - model->cumulative_weight[end]);
        rest -= hyst_q_product(weight, hyst_q_kink(model, next, end, rising));
        ++end;
        if (end == next->end) {
            return false;
        }
    }
    return false;
}

/// Lets the envelope push the plays that it reaches.
static inline void push(const hyst_q_model_t* model, hyst_q_state_t* state, const uint32_t level,
                        const bool rising)
{
    hyst_q_segment_t* top = &state->segment[state->num_segments - 1];
    if (!hyst_q_moves(model, top, 0, level, rising)) {
        return;
    }
    const bool turned = (top->falling == 0) != rising;
    if (turned || (state->num_segments > 1 && !take_up(model, top, level, rising))) {
        HYST_Q(replace)(model, state, level, rising);
        return;
    }
    top->level = level;
    state->sum = hyst_q_front_sum(model, top, level);
}

void HYST_Q(saturate)(const hyst_q_model_t* model, hyst_q_state_t* state, const uint32_t level,
                      const bool falling)
{
    hyst_q_segment_t* segment = &state->segment[0];
    const hyst_q_sum_t moment = model->cumulative_moment[model->num_plays];
    segment->rest = falling ? moment : 0 - moment;
    segment->level = level;
    segment->end = (uint16_t)model->num_plays;
    segment->falling = falling ? 1 : 0;
    state->num_segments = 1;
    state->sum = hyst_q_front_sum(model, segment, level);
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
        const hyst_q_sum_t moment = model->cumulative_moment[j + 1];
        segment->rest = falling ? state->sum + moment : state->sum - moment;
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

/// Clamps and counts an input out of range.
static hyst_q_value_t limit(const hyst_q_model_t* model, hyst_q_state_t* state, const hyst_q_value_t input)
{
    if (input >= model->input_min && input <= model->input_max) {
        return input;
    }
    if (state->clamped_inputs < UINT32_MAX) {
        ++state->clamped_inputs;
    }
    return input < model->input_min ? model->input_min : model->input_max;
}

hyst_q_value_t HYST_Q(step)(const hyst_q_model_t* model, hyst_q_state_t* state, const hyst_q_value_t input)
{
    hyst_q_value_t v = input;
    // What lies in the present cell lies in the range.
    if (v < model->knot[state->cell].input || v > model->knot[state->cell + 1].input) {
        v = limit(model, state, input);
        state->cell = HYST_Q(find_cell)(model, state->cell, v);
    }
    if (v == state->input) {
        return state->output;
    }
    const bool rising = v > state->input;
    state->input = v;
    const hyst_q_knot_t* knot = &model->knot[state->cell];
    const uint32_t offset = hyst_q_offset(knot, v);
    const uint32_t nonhysteretic = hyst_q_nonhysteretic(knot, offset);
    if (rising) {
        push(model, state, hyst_q_level(knot, offset, true), true);
    } else {
        push(model, state, hyst_q_level(knot, offset, false), false);
    }
    state->output = hyst_q_total(model, nonhysteretic, state->sum);
    return state->output;
}
