/// What both fixed-point interfaces have alike. The including header says SCALAR, sample_t and saved_t.
#ifndef HYST_COST_FIXED_POINT_H
#define HYST_COST_FIXED_POINT_H

typedef SCALAR(segment_t) memory_t;
typedef SCALAR(inverse_t) reach_t;

/// A value a part of the way from low to high, to the 24 bits of a float: 64-bit numbers, since the width
/// has 32.
static inline sample_t sample_between(const sample_t low, const sample_t high, const float part)
{
    const int64_t x = low + (int64_t)(part * (float)((int64_t)high - low));
    return x < low ? low : x > high ? high : (sample_t)x;
}

static inline reach_t reach_of(const SCALAR(model_t) * model, const SCALAR(state_t) * state)
{
    return SCALAR(inverse)(model, state, state->output);
}

static inline void step_channels(const SCALAR(model_t) * model, SCALAR(state_t) * states,
                                 const sample_t* inputs, sample_t* outputs, const size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        outputs[i] = SCALAR(step)(model, &states[i], inputs[i]);
    }
}

#endif
