/// An image with as much of the library as PARTS says: its size less that of PARTS = 0 is what the part
/// costs. 1: forward. 2: forward and inverse. 3: all that a model can be asked.
#include "scalar.h"

static const SCALAR(model_t) * volatile model;
static SCALAR(state_t) state;
static volatile sample_t sample;

int main(void)
{
#if PARTS >= 1
    sample = SCALAR(step)(model, &state, sample);
#endif
#if PARTS >= 2
    sample = SCALAR(inverse)(model, &state, sample).input;
#endif
#if PARTS >= 3
    static memory_t memory[2];
    static saved_t saved[2];
    sample = SCALAR(reset)(model, &state, HYST_START_DEMAGNETISED, sample);
    if (SCALAR(init)(model, &state, memory, 2) != HYST_STATUS_OK ||
        SCALAR(save)(model, &state, saved, 2) != HYST_STATUS_OK ||
        SCALAR(restore)(model, &state, saved, 2) != HYST_STATUS_OK) {
        return 1;
    }
#endif
    return model == NULL && sample > 0 && state.input > 0 ? 1 : 0;
}
