#include "hyst_q_internal.h"
#if HYST_Q_BITS == 32
#include "hyst/hyst_q31_homing.h"
#else
#include "hyst/hyst_q15_homing.h"
#endif

hyst_status_t HYST_Q(homing_init)(HYST_Q(homing_t) * homing, const hyst_q_model_t* model,
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
    homing->middle = hyst_q_input_above(model, hyst_q_half_range(model));
    homing->num_samples = 2 * cycles + 2;
    homing->next = 0;
    return HYST_STATUS_OK;
}

/// The first two samples are the range's ends: together they set every play that it moves. From the last one
/// on, which is the middle, the amplitude grows backwards by half the range over 2 cycles, rounded down.
bool HYST_Q(homing_next)(HYST_Q(homing_t) * homing, hyst_q_value_t* input)
{
    *input = homing->middle;
    if (homing->next >= homing->num_samples) {
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
    const uint32_t half = (uint32_t)homing->middle - (uint32_t)homing->input_min;
    const int64_t amplitude = (int64_t)((uint64_t)half * left / decaying);
    *input = (hyst_q_value_t)(up ? homing->middle + amplitude : homing->middle - amplitude);
    return true;
}
