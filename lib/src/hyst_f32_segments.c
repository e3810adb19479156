#include "hyst_f32_segments.h"

float hyst_f32_end_of(const hyst_f32_model_t* model, const hyst_f32_segment_t* memory, const uint32_t index,
                      const bool rising)
{
    const hyst_f32_play_t* play = model->play;
    const uint32_t last = memory[index].last;
    const float ahead = hyst_f32_forward(memory[index].level, rising) + play[last].opening;
    if (index == 0) {
        return hyst_f32_forward(hyst_f32_over_none(model, ahead), rising);
    }
    const hyst_f32_segment_t* kept = &memory[index - 1];
    const float x = hyst_f32_beyond(kept, rising, ahead);
    // Rounding may take x beyond the stretch that ends there.
    const float stretch = (kept->rising != 0) == rising ? 0.0f : play[last + 1].opening;
    return hyst_f32_forward(hyst_f32_over(play, kept, rising, last, x < stretch ? x : stretch), rising);
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
        if (hyst_f32_is_taken(play, segment, rising, hyst_f32_beyond(segment, rising, ahead))) {
            high = middle - 1;
        } else {
            low = middle;
        }
        middle = high - (high - low) / 2;
    }
    return low;
}

bool hyst_f32_meet(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const bool rising,
                   const float envelope, hyst_f32_front_t* front)
{
    const hyst_f32_play_t* play = model->play;
    const hyst_f32_segment_t* memory = state->memory;
    const hyst_f32_segment_t* top = &memory[state->front];
    const float ahead = hyst_f32_forward(envelope, rising);
    float x = hyst_f32_beyond(top, rising, ahead);
    if (!hyst_f32_is_taken(play, top, rising, x)) {
        if ((top->rising != 0) == rising || !(x > play[0].opening)) {
            return false;
        }
        hyst_f32_segment_t turned = *top;
        turned.sum[rising] = hyst_f32_end_of(model, memory, state->front, rising);
        front->index = state->front + 1;
        front->end = turned.sum[rising];
        front->last = hyst_f32_last_moved(play, 0, turned.last - 1u, x);
        front->sum = hyst_f32_over(play, &turned, rising, front->last, x);
        return true;
    }
    const uint32_t index = count_kept(play, memory, state->front, rising, ahead);
    front->index = index;
    if (index == 0) {
        front->last = model->num_plays - 1;
        front->sum = hyst_f32_over_none(model, ahead);
        return true;
    }
    const hyst_f32_segment_t* kept = &memory[index - 1];
    x = hyst_f32_beyond(kept, rising, ahead);
    front->last = memory[index].last;
    if ((kept->rising != 0) != rising) {
        front->last = hyst_f32_last_moved(play, front->last, kept->last - 1u, x);
    }
    front->sum = hyst_f32_over(play, kept, rising, front->last, x);
    return true;
}

void hyst_f32_sum_up(const hyst_f32_model_t* model, hyst_f32_segment_t* memory, const uint32_t front)
{
    for (uint32_t i = 0; i <= front; ++i) {
        hyst_f32_segment_t* segment = &memory[i];
        const bool rising = segment->rising != 0;
        const float ahead = hyst_f32_forward(segment->level, rising);
        const float sum = i == 0 ? hyst_f32_over_none(model, ahead)
                                 : hyst_f32_over(model->play, &memory[i - 1], rising, segment->last,
                                                 hyst_f32_beyond(&memory[i - 1], rising, ahead));
        segment->sum[rising] = hyst_f32_forward(sum, rising);
        segment->sum[!rising] = hyst_f32_end_of(model, memory, i, !rising);
    }
}
