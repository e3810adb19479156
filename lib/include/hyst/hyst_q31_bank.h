/// Many channels of 32-bit fixed-point models in one call, for instance the actuators of a deformable mirror.
/// Each channel does what hyst_q31_step and hyst_q31_inverse do; channels share nothing but models. Time: the
/// sum of the channels'.
#ifndef HYST_HYST_Q31_BANK_H
#define HYST_HYST_Q31_BANK_H

#include "hyst/hyst_q31.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Steps channel i = 0 ... count - 1 with its own model: outputs[i] = hyst_q31_step(models[i], &states[i],
/// inputs[i]). models: [count] pointers, which may repeat; states: [count], each tied by hyst_q31_init to the
/// model of its channel and to a memory of its own. inputs, outputs: [count], may be the same array,
/// otherwise must not overlap. count may be 0.
void hyst_q31_bank_step(const hyst_q31_model_t* const* models, hyst_q31_state_t* states,
                        const int32_t* inputs, int32_t* outputs, size_t count);

/// The same with one model for all channels.
void hyst_q31_bank_step_shared(const hyst_q31_model_t* model, hyst_q31_state_t* states, const int32_t* inputs,
                               int32_t* outputs, size_t count);

/// Looks, and changes no state: results[i] = hyst_q31_inverse(models[i], &states[i], wanted[i]).
void hyst_q31_bank_inverse(const hyst_q31_model_t* const* models, const hyst_q31_state_t* states,
                           const int32_t* wanted, hyst_q31_inverse_t* results, size_t count);

/// The same with one model for all channels.
void hyst_q31_bank_inverse_shared(const hyst_q31_model_t* model, const hyst_q31_state_t* states,
                                  const int32_t* wanted, hyst_q31_inverse_t* results, size_t count);

#ifdef __cplusplus
}
#endif

#endif
