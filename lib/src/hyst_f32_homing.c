#include "hyst/hyst_f32_homing.h"
#include "hyst_f32_internal.h"

hyst_status_t hyst_f32_homing_init(hyst_f32_homing_t* homing, const hyst_f32_model_t* model,
                                   const uint32_t cycles)
{
    if (homing == NULL || model == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    if (cycles == 0 || cycles > HYST_MAX_HOMING_CYCLES) {
        return HYST_STATUS_CYCLES;
    }
    homing->input_min = model->input_min;
    homing->input_max = model->input_max;
    homing->middle = hyst_f32_middle(model);
    homing->num_samples = 2 * cycles + 2;
    homing->next = 0;
    return HYST_STATUS_OK;
}

/// The first two samples have full amplitude: together they set every play that the range moves. The others
/// fall short of it by at least one part in 2^21; the three roundings before the sum add at most 3 in 2^24,
/// and the sum's is monotone: none leaves the range.
bool hyst_f32_homing_next(hyst_f32_homing_t* homing, float* input)
{
    if (homing->next >= homing->num_samples) {
        *input = homing->middle;
        return false;
    }
    const uint32_t decaying = homing->num_samples - 2;
    const uint32_t left = homing->num_samples - 1 - homing->next;
    const bool up = homing->next % 2 == 0;
    ++homing->next;
    if (left >= decaying) {
        *input = up ? homing->input_max : homing->input_min;
        return true;
    }
    const float part = (float)left / (float)decaying;
    *input = up ? homing->middle + part * (homing->input_max - homing->middle)
                : homing->middle - part * (homing->middle - homing->input_min);
    return true;
}
