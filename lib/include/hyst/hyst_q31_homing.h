/// Homing in 32-bit fixed point: the sequence of inputs that erases the memory of the actuator and of its
/// model alike, one input a call, so that an interrupt can play it. It visits input_max and input_min, then
/// alternates about the middle of the range with an amplitude that shrinks evenly to 0, `cycles` times up and
/// down, and ends at the middle.
///
/// Afterwards every play that an input_max - 1 and input_min move both ways, 2 radius <=
/// ascending(input_max - 1) - descending(input_min), is where HYST_START_DEMAGNETISED puts it to within the
/// most that either envelope rises over
///   (input_max - input_min) / (4 cycles) + 3                       [input units],
/// whatever came before, and the output to within as much times the sum of the weights and one unit. Wider
/// plays stay where they were: no input in the range can move them. An actuator that lags needs each input
/// held until it has settled: call hyst_q31_homing_next at that rate.
#ifndef HYST_HYST_Q31_HOMING_H
#define HYST_HYST_Q31_HOMING_H

#include "hyst/hyst_q31.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How far a sequence has come; the caller's. Fields may be read; only the functions below write them.
typedef struct {
    int32_t input_min;
    int32_t input_max;
    int32_t middle;       ///< of the input's range, half a unit lower where that is between two integers
    uint32_t num_samples; ///< in the whole sequence: 2 cycles + 2
    uint32_t next;        ///< samples given out so far
} hyst_q31_homing_t;

/// Starts a sequence of 2 cycles + 2 inputs for a model that hyst_q31_init has accepted. cycles: 1 ...
/// HYST_MAX_HOMING_CYCLES. Returns NULL_POINTER or CYCLES, writing nothing. The model need not outlive the
/// call.
HYST_NODISCARD hyst_status_t hyst_q31_homing_init(hyst_q31_homing_t* homing, const hyst_q31_model_t* model,
                                                  uint32_t cycles);

/// The next input, always within [input_min, input_max]: to be applied to the actuator and to hyst_q31_step.
/// false when the sequence is over; *input is then the middle of the range, where it ended. Constant time.
bool hyst_q31_homing_next(hyst_q31_homing_t* homing, int32_t* input);

#ifdef __cplusplus
}
#endif

#endif
