/// Many channels of 16-bit fixed-point models in one call: as hyst/hyst_q31_bank.h, where every function is
/// described.
#ifndef HYST_HYST_Q15_BANK_H
#define HYST_HYST_Q15_BANK_H

#include "hyst/hyst_q15.h"

#ifdef __cplusplus
extern "C" {
#endif

void hyst_q15_bank_step(const hyst_q15_model_t* const* models, hyst_q15_state_t* states,
                        const int16_t* inputs, int16_t* outputs, size_t count);
void hyst_q15_bank_step_shared(const hyst_q15_model_t* model, hyst_q15_state_t* states, const int16_t* inputs,
                               int16_t* outputs, size_t count);
void hyst_q15_bank_inverse(const hyst_q15_model_t* const* models, const hyst_q15_state_t* states,
                           const int16_t* wanted, hyst_q15_inverse_t* results, size_t count);
void hyst_q15_bank_inverse_shared(const hyst_q15_model_t* model, const hyst_q15_state_t* states,
                                  const int16_t* wanted, hyst_q15_inverse_t* results, size_t count);

#ifdef __cplusplus
}
#endif

#endif
