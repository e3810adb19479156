/// Many channels of single-precision models in one call, for instance the actuators of a deformable mirror.
/// Each channel does what hyst_f32_step and hyst_f32_inverse do, to the last bit; channels share nothing but
/// models. Time: the sum of the channels'.
#ifndef HYST_HYST_F32_BANK_H
#define HYST_HYST_F32_BANK_H

#include "hyst/hyst_f32.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Steps channel i = 0 ... count - 1 with its own model: outputs[i] = hyst_f32_step(models[i], &states[i],
/// inputs[i]). models: [count] pointers, which may repeat; states: [count], each tied by hyst_f32_init to the
/// model of its channel and to a memory of its own. inputs, outputs: [count], may be the same array,
/// otherwise must not overlap. count may be 0.
void hyst_f32_bank_step(const hyst_f32_model_t* const* models, hyst_f32_state_t* states, const float* inputs,
                        float* outputs, size_t count);

/// The same with one model for all channels.
void hyst_f32_bank_step_shared(const hyst_f32_model_t* model, hyst_f32_state_t* states, const float* inputs,
                               float* outputs, size_t count);

/// Looks, and changes no state: results[i] = hyst_f32_inverse(models[i], &states[i], wanted[i]).
void hyst_f32_bank_inverse(const hyst_f32_model_t* const* models, const hyst_f32_state_t* states,
                           const float* wanted, hyst_f32_inverse_t* results, size_t count);

/// The same with one model for all channels.
void hyst_f32_bank_inverse_shared(const hyst_f32_model_t* model, const hyst_f32_state_t* states,
                                  const float* wanted, hyst_f32_inverse_t* results, size_t count);

#ifdef __cplusplus
}
#endif

#endif
