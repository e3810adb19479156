#include "hyst/hyst_f32_bank.h"

void hyst_f32_bank_step(const hyst_f32_model_t* const* models, hyst_f32_state_t* states, const float* inputs,
                        float* outputs, const size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        outputs[i] = hyst_f32_step(models[i], &states[i], inputs[i]);
    }
}

void hyst_f32_bank_step_shared(const hyst_f32_model_t* model, hyst_f32_state_t* states, const float* inputs,
                               float* outputs, const size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        outputs[i] = hyst_f32_step(model, &states[i], inputs[i]);
    }
}

void hyst_f32_bank_inverse(const hyst_f32_model_t* const* models, const hyst_f32_state_t* states,
                           const float* wanted, hyst_f32_inverse_t* results, const size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        results[i] = hyst_f32_inverse(models[i], &states[i], wanted[i]);
    }
}

void hyst_f32_bank_inverse_shared(const hyst_f32_model_t* model, const hyst_f32_state_t* states,
                                  const float* wanted, hyst_f32_inverse_t* results, const size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        results[i] = hyst_f32_inverse(model, &states[i], wanted[i]);
    }
}
