/// What both fixed-point types' scalar.h hold alike.
#ifndef HYST_COST_FIXED_H
#define HYST_COST_FIXED_H

/// A value a part of the way from low to high, to 1/65536 of the way: float stays out of the counted work.
static inline sample_t sample_between(const sample_t low, const sample_t high, const float part)
{
    const int32_t steps = (int32_t)(part * 65536.0f);
    const int64_t way = (int64_t)high - (int64_t)low;
    const int64_t x = low + way / 65536 * steps + way % 65536 * steps / 65536;
    return (sample_t)(x < high ? x : high);
}

static inline reach_t reach_of(const SCALAR(model_t) * model, const SCALAR(state_t) * state)
{
    return SCALAR(reachable)(model, state);
}

static inline void step_channels(const SCALAR(model_t) * model, SCALAR(state_t) * states,
                                 const sample_t* inputs, sample_t* outputs, const size_t count)
{
    SCALAR(bank_step_shared)(model, states, inputs, outputs, count);
}

#endif
