#include "hyst_f32_segments.h"

uint32_t hyst_f32_find_cell(const hyst_f32_model_t* model, uint32_t low, uint32_t high, const float v)
{
    while (low < high) {
        const uint32_t middle = high - (high - low) / 2;
        if (v < model->knot[middle].input) {
            high = middle - 1;
        } else {
            low = middle;
        }
    }
    return low;
}

uint32_t hyst_f32_last_moved(const hyst_f32_play_t* play, uint32_t low, uint32_t high, const float x)
{
    // A smooth input finds it next to where it was.
    if (low >= high || !(x > play[low + 1].opening)) {
        return low;
    }
    ++low;
    while (low < high) {
        const uint32_t middle = high - (high - low) / 2;
        if (x > play[middle].opening) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

float hyst_f32_end_of(const hyst_f32_model_t* model, const hyst_f32_segment_t* memory, const uint32_t index,
                      const bool rising)
{
    const hyst_f32_play_t* play = model->play;
    const uint32_t last = memory[index].last;
    const float ahead = play[last].opening - memory[index].level;
    if (index == 0) {
        return hyst_f32_over_none(model, ahead);
    }
    const hyst_f32_segment_t* kept = &memory[index - 1];
    const bool along = hyst_f32_is_along(kept, rising);
    const float x = hyst_f32_beyond(kept, along, ahead);
    // Rounding may take x beyond the stretch that ends there.
    const float stretch = along ? 0.0f : play[last + 1].opening;
    return hyst_f32_over(play, kept, along, kept->sum[rising], last, x < stretch ? x : stretch);
}

/// How many segments the move keeps when it takes segment `taken`.
static uint32_t count_kept(const hyst_f32_play_t* play, const hyst_f32_segment_t* memory,
                           const uint32_t taken, const bool rising, const float ahead)
{
    uint32_t low = 0;
    uint32_t high = taken;
    uint32_t middle = taken;
    while (low < high) {
        const hyst_f32_segment_t* segment = &memory[middle - 1];
        const bool along = hyst_f32_is_along(segment, rising);
        if (hyst_f32_is_taken(play, segment, along, hyst_f32_beyond(segment, along, ahead))) {
            high = middle - 1;
        } else {
            low = middle;
        }
        middle = high - (high - low) / 2;
    }
    return low;
}

bool hyst_f32_meet(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const bool rising,
                   const float ahead, hyst_f32_front_t* front)
{
    const hyst_f32_play_t* play = model->play;
    const hyst_f32_segment_t* memory = state->memory;
    const hyst_f32_segment_t* kept = &memory[state->front];
    bool along = hyst_f32_is_along(kept, rising);
    float x = hyst_f32_beyond(kept, along, ahead);
    float end;
    uint32_t low = 0;
    if (!hyst_f32_is_taken(play, kept, along, x)) {
        if (along || !(x > play[0].opening)) {
            return false;
        }
        front->index = state->front + 1;
        end = hyst_f32_end_of(model, memory, state->front, rising);
        front->end = end;
    } else {
        front->index = count_kept(play, memory, state->front, rising, ahead);
        if (front->index == 0) {
            front->last = model->num_plays - 1;
            front->sum = hyst_f32_over_none(model, ahead);
            return true;
        }
        kept = &memory[front->index - 1];
        along = hyst_f32_is_along(kept, rising);
        x = hyst_f32_beyond(kept, along, ahead);
        low = kept[1].last;
        end = kept->sum[rising];
    }
    front->last = along ? low : hyst_f32_last_moved(play, low, kept->last - 1u, x);
    front->sum = hyst_f32_over(play, kept, along, end, front->last, x);
    return true;
}

void hyst_f32_sum_up(const hyst_f32_model_t* model, hyst_f32_segment_t* memory, const uint32_t front)
{
    for (uint32_t i = 0; i <= front; ++i) {
        hyst_f32_segment_t* segment = &memory[i];
        const bool rising = segment->rising != 0;
        float sum;
        if (i == 0) {
            sum = hyst_f32_over_none(model, segment->level);
        } else {
            const hyst_f32_segment_t* kept = &memory[i - 1];
            const bool along = hyst_f32_is_along(kept, rising);
            sum = hyst_f32_over(model->play, kept, along, kept->sum[rising], segment->last,
                                hyst_f32_beyond(kept, along, segment->level));
        }
        segment->sum[rising] = sum;
        segment->sum[!rising] = hyst_f32_end_of(model, memory, i, !rising);
    }
}
