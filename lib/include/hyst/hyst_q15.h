/// Fixed-point GPI model in 16-bit integers, for cores without a long multiply: as hyst/hyst_q31.h, where
/// every function is described, with 16 for 32, 2^15 for 2^31 and no product beyond 32 bits.
#ifndef HYST_HYST_Q15_H
#define HYST_HYST_Q15_H

#include "hyst/hyst.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HYST_Q15_STATE_MAX  UINT32_C(0xFFFF)
#define HYST_Q15_RADIUS_MAX UINT32_C(0xFFFF)

typedef struct {
    int16_t input;
    uint16_t ascending;
    uint16_t descending;
    uint16_t nonhysteretic;
    uint16_t ascending_slope;
    uint16_t descending_slope;
    uint16_t nonhysteretic_slope;
    uint16_t shift; ///< brings the cell's width to 2^15 ... 2^16 - 1
} hyst_q15_knot_t;

typedef struct {
    uint32_t format;
    uint32_t num_plays;
    uint32_t num_knots;
    int16_t input_min;
    int16_t input_max;
    int32_t constant;
    const uint16_t* radius;
    const uint16_t* cumulative_weight; ///< output units per state unit times 2^16
    const uint32_t* cumulative_moment;
    const hyst_q15_knot_t* knot;
} hyst_q15_model_t;

typedef struct {
    uint32_t rest;
    uint32_t level;
    uint16_t end;
    uint16_t falling;
} hyst_q15_segment_t;

typedef struct {
    uint32_t sum;
    hyst_q15_segment_t* segment;
    uint32_t num_segments;
    uint32_t cell;
    uint32_t clamped_inputs;
    int16_t input;
    int16_t output;
} hyst_q15_state_t;

typedef struct {
    int16_t input;
    bool clamped;
} hyst_q15_inverse_t;

typedef struct {
    int16_t reachable_min;
    int16_t reachable_max;
} hyst_q15_reach_t;

typedef struct {
    uint32_t num_steps;
    const int16_t* input;
    const int16_t* output;
    const int16_t* wanted;
    const int16_t* inverse;
} hyst_q15_golden_t;

HYST_NODISCARD hyst_status_t hyst_q15_init(const hyst_q15_model_t* model, hyst_q15_state_t* state,
                                           hyst_q15_segment_t* memory, size_t memory_length);
int16_t hyst_q15_reset(const hyst_q15_model_t* model, hyst_q15_state_t* state, hyst_start_t start,
                       int16_t input);
int16_t hyst_q15_step(const hyst_q15_model_t* model, hyst_q15_state_t* state, int16_t input);
hyst_q15_inverse_t hyst_q15_inverse(const hyst_q15_model_t* model, const hyst_q15_state_t* state,
                                    int16_t wanted);
hyst_q15_reach_t hyst_q15_reachable(const hyst_q15_model_t* model, const hyst_q15_state_t* state);

#define HYST_Q15_SNAPSHOT_LENGTH(num_plays) ((num_plays) + 1)
HYST_NODISCARD hyst_status_t hyst_q15_save(const hyst_q15_model_t* model, const hyst_q15_state_t* state,
                                           uint16_t* snapshot, size_t length);
HYST_NODISCARD hyst_status_t hyst_q15_restore(const hyst_q15_model_t* model, hyst_q15_state_t* state,
                                              const uint16_t* snapshot, size_t length);
HYST_NODISCARD hyst_status_t hyst_q15_self_test(const hyst_q15_model_t* model, hyst_q15_state_t* state,
                                                const hyst_q15_golden_t* golden);

#ifdef __cplusplus
}
#endif

#endif
