/// What the single-precision files share. Every operation is written out one by one: the order is part of the
/// result, and floating-point addition, subtraction and multiplication by a weight >= 0 are monotone also
/// after rounding, so the computed output is a non-decreasing function of the input, bit for bit.
#ifndef HYST_F32_INTERNAL_H
#define HYST_F32_INTERNAL_H

#include "hyst/hyst_f32.h"
#include <float.h>

#ifdef __FAST_MATH__
#error "hyst needs IEEE 754 arithmetic: compile it without -ffast-math"
#endif
#if FLT_EVAL_METHOD != 0
#error "hyst needs float evaluated as float: on 32-bit x86 compile with -msse2 -mfpmath=sse"
#endif

static inline bool hyst_f32_is_nan(const float x)
{
    return !(x <= FLT_MAX) && !(x > FLT_MAX);
}

static inline bool hyst_f32_is_finite(const float x)
{
    return x >= -FLT_MAX && x <= FLT_MAX;
}

static inline float hyst_f32_magnitude(const float x)
{
    return x < 0.0f ? -x : x;
}

static inline float hyst_f32_larger(const float a, const float b)
{
    return a > b ? a : b;
}

/// x limited to [low, high]; NaN gives low.
static inline float hyst_f32_limit(const float x, const float low, const float high)
{
    if (!(x > low)) {
        return low;
    }
    return x < high ? x : high;
}

/// An envelope at v. Slopes are rounded so that no line ends above the next knot's value (init checks it):
/// the envelope does not fall from one cell to the next.
static inline float hyst_f32_envelope(const hyst_f32_model_t* model, const uint32_t cell, const float v,
                                      const bool rising)
{
    if (model->num_knots == 0) {
        return v;
    }
    const hyst_f32_knot_t* knot = &model->knot[cell];
    return rising ? knot->ascending + knot->ascending_slope * (v - knot->input)
                  : knot->descending + knot->descending_slope * (v - knot->input);
}

/// The constant and D at v, likewise.
static inline float hyst_f32_offset(const hyst_f32_model_t* model, const uint32_t cell, const float v)
{
    if (model->num_knots == 0) {
        return model->constant + model->nonhysteretic_slope * v;
    }
    const hyst_f32_knot_t* knot = &model->knot[cell];
    return model->constant + (knot->nonhysteretic + knot->nonhysteretic_slope * (v - knot->input));
}

/// Where a play goes that `envelope` pushes.
static inline float hyst_f32_pushed(const float envelope, const float radius, const bool rising)
{
    return rising ? envelope - radius : envelope + radius;
}

/// The largest magnitude of either envelope over the range.
static inline float hyst_f32_envelope_bound(const hyst_f32_model_t* model)
{
    if (model->num_knots == 0) {
        return hyst_f32_larger(hyst_f32_magnitude(model->input_min), hyst_f32_magnitude(model->input_max));
    }
    const hyst_f32_knot_t* first = &model->knot[0];
    const hyst_f32_knot_t* last = &model->knot[model->num_knots - 1];
    return hyst_f32_larger(
        hyst_f32_larger(hyst_f32_magnitude(first->ascending), hyst_f32_magnitude(last->ascending)),
        hyst_f32_larger(hyst_f32_magnitude(first->descending), hyst_f32_magnitude(last->descending)));
}

/// The middle of the input's range.
static inline float hyst_f32_middle(const hyst_f32_model_t* model)
{
    return model->input_min + 0.5f * (model->input_max - model->input_min);
}

/// The cell k with knot[k].input <= v < knot[k + 1].input, the last one for input_max, of cells low ... high,
/// which hold v. 0 for a model without knots.
uint32_t hyst_f32_find_cell(const hyst_f32_model_t* model, uint32_t low, uint32_t high, float v);

/// The cell of input_max.
static inline uint32_t hyst_f32_last_cell(const hyst_f32_model_t* model)
{
    return model->num_knots == 0 ? 0 : model->num_knots - 2;
}

/// Puts the state at `input` (within the range) with the memory and the plays' part of the output as they
/// are.
void hyst_f32_place(const hyst_f32_model_t* model, hyst_f32_state_t* state, float input);

/// Positive saturation at input_max, or negative at input_min.
void hyst_f32_saturate(const hyst_f32_model_t* model, hyst_f32_state_t* state, bool rising);

#endif
