#include "hyst_f32_internal.h"

typedef union {
    float value;
    uint32_t bits;
} word_t;

static float from_bits(const uint32_t bits)
{
    const word_t word = {.bits = bits};
    return word.value;
}

static uint32_t to_bits(const float value)
{
    const word_t word = {.value = value};
    return word.bits;
}

static void start_over(const hyst_f32_model_t* model, hyst_f32_state_t* state)
{
    hyst_f32_saturate(model, state, false);
    state->invalid_inputs = 0;
    state->clamped_inputs = 0;
}

hyst_status_t hyst_f32_self_test(const hyst_f32_model_t* model, hyst_f32_state_t* state,
                                 const hyst_f32_golden_t* golden)
{
    if (model == NULL || state == NULL || golden == NULL || golden->input_bits == NULL ||
        golden->output_bits == NULL || golden->wanted_bits == NULL || golden->inverse_bits == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    start_over(model, state);
    bool same = true;
    for (uint32_t i = 0; same && i < golden->num_steps; ++i) {
        const float output = hyst_f32_step(model, state, from_bits(golden->input_bits[i]));
        const hyst_f32_inverse_t found = hyst_f32_inverse(model, state, from_bits(golden->wanted_bits[i]));
        same = to_bits(output) == golden->output_bits[i] && to_bits(found.input) == golden->inverse_bits[i];
    }
    start_over(model, state);
    return same ? HYST_STATUS_OK : HYST_STATUS_SELF_TEST;
}
