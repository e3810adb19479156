#include "hyst_f32_segments.h"

void hyst_f32_place(const hyst_f32_model_t* model, hyst_f32_state_t* state, const float input)
{
    state->input = input;
    state->cell = hyst_f32_find_cell(model, 0, hyst_f32_last_cell(model), input);
    state->output = hyst_f32_offset(model, state->cell, input) + state->plays;
}

void hyst_f32_saturate(const hyst_f32_model_t* model, hyst_f32_state_t* state, const bool rising)
{
    hyst_f32_segment_t* outermost = state->memory;
    const float input = rising ? model->input_max : model->input_min;
    const uint32_t cell = rising ? hyst_f32_last_cell(model) : 0;
    outermost->level = hyst_f32_sign(rising) * hyst_f32_envelope(model, cell, input, rising);
    outermost->last = (uint16_t)(model->num_plays - 1);
    outermost->rising = rising ? 1 : 0;
    hyst_f32_sum_up(model, state->memory, 0);
    state->front = 0;
    state->plays = hyst_f32_sign(rising) * outermost->sum[rising];
    hyst_f32_place(model, state, input);
}

/// Whether the input is in the cell, or in the next one in the move's direction, which *cell then is.
static inline bool is_near(const hyst_f32_model_t* model, uint32_t* cell, const bool rising,
                           const float input)
{
    const hyst_f32_knot_t* knot = &model->knot[*cell];
    if (rising) {
        if (input < knot[1].input) {
            return true;
        }
        ++*cell;
        return *cell + 1 < model->num_knots && input < knot[2].input;
    }
    if (input >= knot->input) {
        return true;
    }
    --*cell;
    return *cell + 1 > 0 && input >= knot[-1].input;
}

enum { MOST_OPENINGS = 9 };

/// The move that goes on: the front's plays move along, perhaps with the next few, and no segment is taken,
/// or no play moves at all. Returns the plays' part in the direction of the move, `present` where none moves;
/// false otherwise.
static inline bool extend(const hyst_f32_model_t* model, hyst_f32_state_t* state, const bool rising,
                          const float ahead, float* plays)
{
    hyst_f32_segment_t* top = &state->memory[state->front];
    if (!hyst_f32_is_along(top, rising)) {
        return !(ahead + top->level > model->play[0].opening);
    }
    if (ahead < top->level) {
        return true;
    }
    float sum;
    if (state->front == 0) {
        sum = hyst_f32_over_none(model, ahead);
    } else {
        const hyst_f32_segment_t* kept = top - 1;
        const bool along = hyst_f32_is_along(kept, rising);
        const float x = hyst_f32_beyond(kept, along, ahead);
        uint32_t last = top->last;
        if (hyst_f32_is_taken(model->play, kept, along, x)) {
            return false;
        }
        if (!along && x > model->play[last + 1].opening) {
            // No segment is taken, so that the next opening is there.
            uint32_t left = MOST_OPENINGS;
            const hyst_f32_play_t* next = &model->play[last + 1];
            do {
                if (--left == 0) {
                    return false;
                }
                ++next;
            } while (x > next->opening);
            last += MOST_OPENINGS - left;
            top->last = (uint16_t)last;
        }
        sum = hyst_f32_over(model->play, kept, along, kept->sum[rising], last, x);
    }
    top->level = ahead;
    top->sum[rising] = sum;
    // Rounding does not move the plays' part against the input.
    *plays = hyst_f32_larger(sum, *plays);
    return true;
}

/// The short way for what a sample mostly is; hyst_f32_move gives the same bits. It calls nothing that
/// returns here, so that it saves no registers.
float hyst_f32_step(const hyst_f32_model_t* model, hyst_f32_state_t* state, const float input)
{
    uint32_t cell = state->cell;
    const bool rising = input > state->input;
    if (model->num_knots == 0 || !is_near(model, &cell, rising, input)) {
        return hyst_f32_step_anywhere(model, state, input);
    }
    const hyst_f32_knot_t* knot = &model->knot[cell];
    const float along = input - knot->input;
    const float ahead = rising ? knot->ascending + knot->ascending_slope * along
                               : -(knot->descending + knot->descending_slope * along);
    float plays = rising ? state->plays : -state->plays;
    if (!extend(model, state, rising, ahead, &plays)) {
        return hyst_f32_move(model, state, cell, input);
    }
    plays = rising ? plays : -plays;
    const float output = model->constant + (knot->nonhysteretic + knot->nonhysteretic_slope * along) + plays;
    state->plays = plays;
    state->input = input;
    state->cell = cell;
    state->output = output;
    return output;
}
