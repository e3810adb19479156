#include "hyst_q_internal.h"

static void start_over(const hyst_q_model_t* model, hyst_q_state_t* state)
{
    (void)HYST_Q(reset)(model, state, HYST_START_NEGATIVE_SATURATION, model->input_min);
    state->clamped_inputs = 0;
}

hyst_status_t HYST_Q(self_test)(const hyst_q_model_t* model, hyst_q_state_t* state,
                                const HYST_Q(golden_t) * golden)
{
    if (model == NULL || state == NULL || golden == NULL || golden->input == NULL || golden->output == NULL ||
        golden->wanted == NULL || golden->inverse == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    start_over(model, state);
    bool same = true;
    for (uint32_t i = 0; same && i < golden->num_steps; ++i) {
        const hyst_q_value_t output = HYST_Q(step)(model, state, golden->input[i]);
        same = output == golden->output[i] &&
               HYST_Q(inverse)(model, state, golden->wanted[i]).input == golden->inverse[i];
    }
    start_over(model, state);
    return same ? HYST_STATUS_OK : HYST_STATUS_SELF_TEST;
}
