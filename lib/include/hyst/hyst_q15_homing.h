/// Homing in 16-bit fixed point: as hyst/hyst_q31_homing.h, where every function is described.
#ifndef HYST_HYST_Q15_HOMING_H
#define HYST_HYST_Q15_HOMING_H

#include "hyst/hyst_q15.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    int16_t input_min;
    int16_t input_max;
    int16_t middle;
    uint32_t num_samples;
    uint32_t next;
} hyst_q15_homing_t;

HYST_NODISCARD hyst_status_t hyst_q15_homing_init(hyst_q15_homing_t* homing, const hyst_q15_model_t* model,
                                                  uint32_t cycles);
bool hyst_q15_homing_next(hyst_q15_homing_t* homing, int16_t* input);

#ifdef __cplusplus
}
#endif

#endif
