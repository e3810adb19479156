#include "hysteresis_plays.h"

#include "lag_step.h"
#include <float.h>
#include <string.h>

void plays_set_sum_range(hysteresis_state_t* state)
{
    const model_t* model = state->model;
    const double low = curve_value(&model->descending, model->input_min);
    const double high = curve_value(&model->ascending, model->input_max);
    for (size_t j = 0; j < model->num_plays; ++j) {
        state->sum_middle += model->weight[j] * 0.5 * (low + high);
        state->sum_half += model->weight[j] * fmax(0.5 * (high - low) - model->radius[j], 0.0);
    }
}

double plays_sum(const model_t* model, const double* memory)
{
    double sum = 0.0;
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j] * memory[j];
    }
    return sum;
}

strip_t strip_at(const model_t* model, double v, double extra)
{
    return (strip_t){curve_value(&model->ascending, v), curve_value(&model->descending, v), extra};
}

/// A play's lag and what it leaves out of a whole step, 1 - exp(-step/lag).
typedef struct {
    double time, missing;
} play_lag_t;

/// Where a state ends that a bound, moving evenly from `from` to `to` in `step` seconds, pulls up: w' =
/// (bound - w)/lag below it, 0 above. With e = bound - w and the bound's speed s: e(t) = s lag + (e0 - s lag)
/// exp(-t/lag).
static double pulled_up(double w, double from, double to, double step, play_lag_t lag)
{
    const double speed = (to - from) / step;
    const double below = from - w;
    if (below > 0.0) {
        if (speed < 0.0) {
            const double meeting = lag.time * log1p(below / (-speed * lag.time));
            if (meeting < step) {
                return from + speed * meeting;
            }
        }
        return to - below * (1.0 - lag.missing) - speed * (lag.time * lag.missing);
    }
    if (to > w) {
        const double left = (to - w) / speed;
        return to + speed * (lag.time * expm1(-left / lag.time));
    }
    return w;
}

static double pulled_down(double w, double from, double to, double step, play_lag_t lag)
{
    return -pulled_up(-w, -from, -to, step, lag);
}

/// One play through one step; direction 1 rising, -1 falling, 0 held.
static double lagged(double w, double radius, const strip_t* from, const strip_t* to, int direction,
                     double step, play_lag_t lag)
{
    const double low[2] = {strip_low(from, radius), strip_low(to, radius)};
    const double high[2] = {strip_high(from, radius), strip_high(to, radius)};
    if (direction < 0) {
        w = pulled_up(w, low[0], low[1], step, lag);
        return pulled_down(w, high[0], high[1], step, lag);
    }
    w = pulled_down(w, high[0], high[1], step, lag);
    return pulled_up(w, low[0], low[1], step, lag);
}

void plays_move_between(const hysteresis_state_t* state, const strip_t* to, int direction, double* memory)
{
    for (size_t j = 0; j < state->model->num_plays; ++j) {
        const double w = state->memory[j];
        const double low = strip_low(to, state->model->radius[j]);
        const double high = strip_high(to, state->model->radius[j]);
        memory[j] = direction < 0 ? smaller(high, larger(low, w)) : larger(low, smaller(high, w));
    }
}

/// Eq. (6).
static void move_own_radii(const model_t* model, double v, int direction, const double* before,
                           double* memory)
{
    if (direction == 0) {
        memcpy(memory, before, model->num_plays * sizeof *memory);
        return;
    }
    const double envelope = curve_value(direction > 0 ? &model->ascending : &model->descending, v);
    for (size_t j = 0; direction > 0 && j < model->num_plays; ++j) {
        memory[j] = larger(before[j], envelope - model->radius[j]);
    }
    for (size_t j = 0; direction < 0 && j < model->num_plays; ++j) {
        memory[j] = smaller(before[j], envelope + model->radius[j]);
    }
}

static strip_t strip_between(const strip_t* from, const strip_t* to, double part)
{
    return (strip_t){from->ascending + part * (to->ascending - from->ascending),
                     from->descending + part * (to->descending - from->descending),
                     from->extra + part * (to->extra - from->extra)};
}

static double play_lag_time(const hysteresis_state_t* state, size_t play)
{
    const double* radius = state->model->radius;
    const double largest = larger(radius[state->model->num_plays - 1], DBL_MIN);
    return state->hysteresis->play_lag * (1.0 + state->hysteresis->lag_spread * radius[play] / largest);
}

/// 1 - exp(-step/lag) of every play; kept behind both memories, as steps seldom differ.
static const double* missing_of(const hysteresis_state_t* state, double step)
{
    const model_t* model = state->model;
    double* missing = state->memory + 2 * model->num_plays;
    double* kept_step = missing + model->num_plays;
    if (!lag_is_same_step(step, *kept_step)) {
        for (size_t j = 0; j < model->num_plays; ++j) {
            missing[j] = -expm1(-step / play_lag_time(state, j));
        }
        *kept_step = step;
    }
    return missing;
}

/// The plays with a lag; returns the strip there.
static strip_t trail(const hysteresis_state_t* state, double v, double from_extra, double to_extra,
                     double step, double* memory)
{
    const model_t* model = state->model;
    const int direction = (v > state->input ? 1 : 0) - (v < state->input ? 1 : 0);
    const strip_t from = {state->ascending, state->descending, from_extra};
    const strip_t to =
        direction == 0 ? (strip_t){from.ascending, from.descending, to_extra} : strip_at(model, v, to_extra);
    const strip_t held = strip_between(&from, &to, state->hysteresis->lag_hold);
    const double* missing = missing_of(state, step);
    for (size_t j = 0; j < model->num_plays; ++j) {
        const play_lag_t lag = {play_lag_time(state, j), missing[j]};
        memory[j] = lagged(state->memory[j], model->radius[j], &held, &to, direction, step, lag);
    }
    return to;
}

strip_t plays_move(const hysteresis_state_t* state, double v, double step, double* memory)
{
    const model_t* model = state->model;
    const hysteresis_t* hysteresis = state->hysteresis;
    const double* width = hysteresis->width;
    const double speed = hysteresis->widening * fabs(v - state->input) / step;
    const double from_extra = speed + (width != NULL ? width[state->sample] : 0.0);
    const double to_extra = speed + (width != NULL ? width[state->sample + 1] : 0.0);
    const int direction = (v > state->input ? 1 : 0) - (v < state->input ? 1 : 0);
    if (hysteresis->play_lag > 0.0) {
        return trail(state, v, from_extra, to_extra, step, memory);
    }
    if (width == NULL && !differs(hysteresis->widening)) {
        move_own_radii(model, v, direction, state->memory, memory);
        return (strip_t){0};
    }
    const strip_t to = strip_at(model, v, to_extra);
    plays_move_between(state, &to, direction, memory);
    return (strip_t){0};
}

void plays_come_to(hysteresis_state_t* state, double input, const strip_t* strip)
{
    state->input = input;
    state->ascending = strip->ascending;
    state->descending = strip->descending;
}

bool plays_have_direct(const hysteresis_t* hysteresis)
{
    return hysteresis->play_lag > 0.0 && hysteresis->lag_direct > 0.0;
}

double plays_middle(const hysteresis_state_t* state, double seen)
{
    return loop_middle_at(state->hysteresis->middle, seen) - curve_value(&state->model->nonhysteretic, seen);
}

double plays_next_middle(const hysteresis_state_t* state, double middle, double step)
{
    const lag_step_t lag = lag_step_held(step, state->hysteresis->play_lag, state->hysteresis->lag_hold);
    return lag_next(lag, state->lagged_middle, state->middle, middle);
}
