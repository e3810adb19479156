/// Fixed-point models for tests, of either type behind one interface, and the integer reference: Eqs. (6) and
/// (8) as a plain loop over the plays.
#ifndef HYST_TESTS_Q_MODEL_H
#define HYST_TESTS_Q_MODEL_H

#include "quantize.h"
#include "random.h"

typedef struct {
    quantized_t quantized;
    narrowed_t narrowed; ///< q15 only
    hyst_q31_segment_t* memory31;
    hyst_q15_segment_t* memory15;
    hyst_q31_state_t state31;
    hyst_q15_state_t state15;
    uint64_t* reference;     ///< [num_plays] the integer reference's plays ...
    int64_t reference_input; ///< ... and its last input
} q_model_t;

/// What hyst_q31_inverse or hyst_q15_inverse answers.
typedef struct {
    int32_t input;
    bool clamped;
} q_inverse_t;

typedef struct {
    int32_t reachable_min, reachable_max;
} q_reach_t;

/// Quantizes the model and initialises state and reference at negative saturation; ends the program when that
/// fails.
q_model_t q_new(const model_t* model, quantized_bits_t bits, double table_error);
void q_free(q_model_t* q);
/// A random model's quantized form: an even table error of 1e-3 ... 1e-1 of its output's range.
double q_random_table_error(random_t* random, const model_t* model);

hyst_status_t q_init(q_model_t* q, size_t memory_length);
int32_t q_step(q_model_t* q, int32_t input);
int32_t q_reset(q_model_t* q, hyst_start_t start, int32_t input);
q_inverse_t q_inverse(const q_model_t* q, int32_t wanted);
q_reach_t q_reachable(const q_model_t* q);
/// snapshot: [num_plays + 1].
hyst_status_t q_save(const q_model_t* q, uint32_t* snapshot, size_t length);
hyst_status_t q_restore(q_model_t* q, const uint32_t* snapshot, size_t length);
int32_t q_present_input(const q_model_t* q);
uint32_t q_clamped_inputs(const q_model_t* q);
/// The largest and least integer of the type.
int32_t q_value_max(const q_model_t* q);
int32_t q_value_min(const q_model_t* q);

/// An input: noise, a small step, an end, a knot or beside one, now and then out of range.
int32_t q_random_input(random_t* random, const q_model_t* q, int32_t last);
/// The nearest integer input, and an output in output units.
int32_t q_from_units(const q_model_t* q, double input);
double q_to_units(const q_model_t* q, int32_t output);

/// The integer reference. Starts: only q15's demagnetised one, for it runs the whole alternation.
void q_reference_start(q_model_t* q, hyst_start_t start);
int32_t q_reference_step(q_model_t* q, int32_t input);
/// The output that `input` would give.
int32_t q_reference_look(const q_model_t* q, int32_t input);

#endif
