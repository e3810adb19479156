/// Golden vectors of a fixed-point model.
#ifndef HYST_HOST_GOLDEN_Q_H
#define HYST_HOST_GOLDEN_Q_H

#include "golden.h"
#include "quantize.h"

typedef struct {
    int32_t input[GOLDEN_STEPS], output[GOLDEN_STEPS], wanted[GOLDEN_STEPS], inverse[GOLDEN_STEPS];
} golden_q_t;

/// As golden_make, with the library's fixed-point functions.
hyst_status_t golden_q_make(const quantized_t* quantized, golden_q_t* golden);

#endif
