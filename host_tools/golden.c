#include "golden.h"
#include "model.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/// Where in the range (0 ... 1) step i goes: up and beyond, down and beyond, then 32 reversals that shrink,
/// each with a step on the way, the last sample held, and reversals that grow beyond the range and wipe them
/// out.
double golden_input(size_t i)
{
    enum { SWEEP = 16, NESTED = 64, HELD = SWEEP + NESTED };
    if (i < SWEEP) {
        return i < SWEEP / 2 ? (double)i * 1.1 / 7.0 : 1.1 - (double)(i - 7) * 1.2 / 8.0;
    }
    if (i <= HELD) {
        const size_t step = (i < HELD ? i : HELD - 1) - SWEEP;
        const double extent = 0.5 * pow(0.88, (double)(step / 2)) * (step % 2 == 0 ? 0.3 : 1.0);
        return step / 2 % 2 == 0 ? 0.5 + extent : 0.5 - extent;
    }
    const double extent = 0.55 * pow(0.8, (double)(GOLDEN_STEPS - 1 - i));
    return i % 2 == 0 ? 0.5 + extent : 0.5 - extent;
}

static float input_at(const hyst_f32_model_t* model, size_t i)
{
    const double low = (double)model->input_min;
    const double high = (double)model->input_max;
    return (float)(low + golden_input(i) * (high - low));
}

/// Through the reachable outputs in steps of 0.15, and a little beyond at both ends.
double golden_wanted(size_t i)
{
    return -0.2 + 0.15 * (double)(i * 7 % 10);
}

static float wanted_at(const hyst_f32_model_t* model, const hyst_f32_state_t* state, size_t i)
{
    const hyst_f32_reach_t reach = hyst_f32_reachable(model, state);
    const double low = (double)reach.reachable_min;
    const double high = (double)reach.reachable_max;
    return (float)(low + golden_wanted(i) * (high - low));
}

hyst_status_t golden_make(const hyst_f32_model_t* model, golden_t* golden)
{
    hyst_f32_segment_t* memory = xcalloc(model->num_plays, sizeof *memory);
    hyst_f32_state_t state;
    const hyst_status_t status = hyst_f32_init(model, &state, memory, model->num_plays);
    for (size_t i = 0; status == HYST_STATUS_OK && i < GOLDEN_STEPS; ++i) {
        const float input = input_at(model, i);
        golden->input[i] = bits_of(input);
        golden->output[i] = bits_of(hyst_f32_step(model, &state, input));
        const float wanted = wanted_at(model, &state, i);
        golden->wanted[i] = bits_of(wanted);
        golden->inverse[i] = bits_of(hyst_f32_inverse(model, &state, wanted).input);
    }
    free(memory);
    return status;
}
