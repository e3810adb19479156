#include "hyst_q_internal.h"
#if HYST_Q_BITS == 32
#include "hyst/hyst_q31_bank.h"
#else
#include "hyst/hyst_q15_bank.h"
#endif

void HYST_Q(bank_step)(const hyst_q_model_t* const* models, hyst_q_state_t* states,
                       const hyst_q_value_t* inputs, hyst_q_value_t* outputs, const size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        outputs[i] = HYST_Q(step)(models[i], &states[i], inputs[i]);
    }
}

void HYST_Q(bank_step_shared)(const hyst_q_model_t* model, hyst_q_state_t* states,
                              const hyst_q_value_t* inputs, hyst_q_value_t* outputs, const size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        outputs[i] = HYST_Q(step)(model, &states[i], inputs[i]);
    }
}

void HYST_Q(bank_inverse)(const hyst_q_model_t* const* models, const hyst_q_state_t* states,
                          const hyst_q_value_t* wanted, HYST_Q(inverse_t) * results, const size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        results[i] = HYST_Q(inverse)(models[i], &states[i], wanted[i]);
    }
}

void HYST_Q(bank_inverse_shared)(const hyst_q_model_t* model, const hyst_q_state_t* states,
                                 const hyst_q_value_t* wanted, HYST_Q(inverse_t) * results,
                                 const size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        results[i] = HYST_Q(inverse)(model, &states[i], wanted[i]);
    }
}
