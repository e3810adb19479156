/// The float interface under the names that cost_main.c and size_main.c use.
#ifndef HYST_COST_SCALAR_H
#define HYST_COST_SCALAR_H

#include "hyst/hyst_f32.h"
#include "hyst/hyst_f32_bank.h"

#define SCALAR(name) hyst_f32_##name

typedef float sample_t;
typedef hyst_f32_segment_t memory_t;
typedef float saved_t;
typedef hyst_f32_reach_t reach_t;

/// A value a part of the way from low to high.
static inline sample_t sample_between(const sample_t low, const sample_t high, const float part)
{
    const float x = low + part * (high - low);
    return x < high ? x : high;
}

static inline reach_t reach_of(const SCALAR(model_t) * model, const SCALAR(state_t) * state)
{
    return hyst_f32_reachable(model, state);
}

static inline void step_channels(const SCALAR(model_t) * model, SCALAR(state_t) * states,
                                 const sample_t* inputs, sample_t* outputs, const size_t count)
{
    hyst_f32_bank_step_shared(model, states, inputs, outputs, count);
}

#endif
