/// Single-precision models for tests, each with the double model that it is exactly, and what rounding may do
/// to it.
#ifndef HYST_TESTS_F32_MODEL_H
#define HYST_TESTS_F32_MODEL_H

#include "hyst/hyst_f32.h"
#include "model.h"
#include "random.h"

typedef struct {
    hyst_f32_model_t model;
    float* radius;
    float* weight;
    hyst_f32_play_t* play;
    hyst_f32_knot_t* knot;
    hyst_f32_segment_t* memory; ///< [num_plays], for a state
    model_t exact;              ///< the same numbers in double
} f32_model_t;

/// What rounding may do, in output or envelope units, derived in f32_model.c.
typedef struct {
    double output;      ///< |step - exact step| for the same inputs
    double round_trip;  ///< |step(inverse(y)) - y| for y within reach
    double demagnetise; ///< the part of the output's error that the demagnetised start adds
} f32_bound_t;

/// Identity envelopes, no table.
f32_model_t f32_classical(const float* radius, const float* weight, size_t num_plays, float slope,
                          float input_min, float input_max);
/// From a table: fills in the slopes and takes input_min and input_max from it.
f32_model_t f32_tabulated(const float* radius, const float* weight, size_t num_plays,
                          const hyst_f32_knot_t* knot, size_t num_knots, float constant);
/// Any kind: classical or tabulated, steep, flat and saturated stretches, 1 to 128 plays, some of them alike,
/// some without weight, some that cannot move.
f32_model_t f32_random(random_t* random);
void f32_free(f32_model_t* made);

/// A state at negative saturation in made->memory; ends the program when the model is refused.
hyst_f32_state_t f32_state(f32_model_t* made);
f32_bound_t f32_bound(const f32_model_t* made);

/// The plays' states w_j, [num_plays].
void f32_plays(const f32_model_t* made, const hyst_f32_state_t* state, double* w);

/// The table of plays anew, after a test changed `radius` or `weight`.
void f32_update_plays(f32_model_t* made);

/// An input within range: noise, a small step from the last one, an end, or a knot.
float f32_random_input(random_t* random, const f32_model_t* made, float last);

uint32_t f32_bits(float value);
float f32_from_bits(uint32_t bits);

#endif
