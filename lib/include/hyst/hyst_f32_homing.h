/// Homing: the sequence of inputs that erases the memory of the actuator and of its model alike, one input a
/// call, so that an interrupt can play it. It visits input_max and input_min, then alternates about the
/// middle of the range with an amplitude that shrinks evenly to 0, `cycles` times up and down, and ends at
/// the middle.
///
/// Afterwards every play that the range moves, radius < (ascending(input_max) - descending(input_min)) / 2,
/// is where HYST_START_DEMAGNETISED puts it to within the most that either envelope rises over
///   (input_max - input_min) / (4 cycles)                           [input units],
/// whatever came before, and the output to within as much times the sum of the weights. With linear envelopes
/// of slope 1 as many cycles as (input_max - input_min) / (2 d) therefore set every play to d / 2, half the
/// distance d of two radii. Wider plays stay where they were: no input in the range can move them. An
/// actuator that lags needs each input held until it has settled: call hyst_f32_homing_next at that rate.
#ifndef HYST_HYST_F32_HOMING_H
#define HYST_HYST_F32_HOMING_H

#include "hyst/hyst_f32.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How far a sequence has come; the caller's. Fields may be read; only the functions below write them.
typedef struct {
    float input_min;
    float input_max;
    float middle;         ///< of the input's range
    uint32_t num_samples; ///< in the whole sequence: 2 cycles + 2
    uint32_t next;        ///< samples given out so far
} hyst_f32_homing_t;

/// Starts a sequence of 2 cycles + 2 inputs for a model that hyst_f32_init has accepted. cycles: 1 ...
/// HYST_MAX_HOMING_CYCLES. Returns NULL_POINTER or CYCLES, writing nothing. The model need not outlive the
/// call.
HYST_NODISCARD hyst_status_t hyst_f32_homing_init(hyst_f32_homing_t* homing, const hyst_f32_model_t* model,
                                                  uint32_t cycles);

/// The next input, always within [input_min, input_max]: to be applied to the actuator and to hyst_f32_step.
/// false when the sequence is over; *input is then the middle of the range, where it ended. Constant time.
bool hyst_f32_homing_next(hyst_f32_homing_t* homing, float* input);

#ifdef __cplusplus
}
#endif

#endif
