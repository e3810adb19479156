#include "golden_q.h"
#include <math.h>
#include <stdlib.h>

/// `part` of the way from low to high, within what the type holds.
static int32_t between(double low, double high, double part, double least, double most)
{
    return (int32_t)fmin(fmax(floor(low + part * (high - low)), least), most);
}

/// The run is the same for both types: this writes it once for each.
#define DEFINE_RUN(type, value_type, least, most)                                                            \
    static hyst_status_t run_##type(const hyst_##type##_model_t* model, golden_q_t* golden)                  \
    {                                                                                                        \
        hyst_##type##_segment_t* memory = xcalloc(model->num_plays, sizeof *memory);                         \
        hyst_##type##_state_t state;                                                                         \
        const hyst_status_t status = hyst_##type##_init(model, &state, memory, model->num_plays);            \
        for (size_t i = 0; status == HYST_STATUS_OK && i < GOLDEN_STEPS; ++i) {                              \
            const int32_t input = between(model->input_min, model->input_max, golden_input(i), least, most); \
            golden->input[i] = input;                                                                        \
            golden->output[i] = hyst_##type##_step(model, &state, (value_type)input);                        \
            const hyst_##type##_reach_t here = hyst_##type##_reachable(model, &state);                       \
            const int32_t wanted =                                                                           \
                between(here.reachable_min, here.reachable_max, golden_wanted(i), least, most);              \
            golden->wanted[i] = wanted;                                                                      \
            golden->inverse[i] = hyst_##type##_inverse(model, &state, (value_type)wanted).input;             \
        }                                                                                                    \
        free(memory);                                                                                        \
        return status;                                                                                       \
    }

DEFINE_RUN(q31, int32_t, INT32_MIN, INT32_MAX)
DEFINE_RUN(q15, int16_t, INT16_MIN, INT16_MAX)

hyst_status_t golden_q_make(const quantized_t* quantized, golden_q_t* golden)
{
    if (quantized->bits == QUANTIZED_Q31) {
        return run_q31(&quantized->model, golden);
    }
    narrowed_t narrowed = narrowed_new(quantized);
    const hyst_status_t status = run_q15(&narrowed.model, golden);
    narrowed_free(&narrowed);
    return status;
}
