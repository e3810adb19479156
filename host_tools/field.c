#include "field.h"

#include <math.h>
#include <stddef.h>

bool field_is_neutral(const field_t* field)
{
    return !(field->diffusion > 0) && !(field->excess > 0);
}

field_state_t field_start(double input)
{
    field_state_t state = {.input = input, .diffused = input, .seen = input};
    for (size_t k = 0; k < FIELD_MODES; k++) {
        state.mode[k] = input;
    }
    return state;
}

/// The modes' lags: set up once for an even clock.
static void set_step(const field_t* field, const field_state_t* from, field_state_t* to, double step)
{
    const bool is_set = lag_is_same_step(step, from->step);
    to->step = is_set ? from->step : step;
    for (size_t k = 0; k < FIELD_MODES; k++) {
        const double odd = 2 * (double)k + 1;
        to->lag[k] = is_set ? from->lag[k] : lag_step_held(step, field->diffusion / (odd * odd), field->hold);
    }
}

static void diffuse(const field_t* field, const field_state_t* from, field_state_t* to, double step)
{
    static const double pi = 3.14159265358979323846;
    to->diffused = to->input;
    set_step(field, from, to, step);
    for (size_t k = 0; k < FIELD_MODES; k++) {
        const double odd = 2 * (double)k + 1;
        to->mode[k] = lag_next(to->lag[k], from->mode[k], from->input, to->input);
        to->diffused += 8 / (pi * pi * odd * odd) * (to->mode[k] - to->input);
    }
}

static const double quarter_turn = 1.57079632679489662;

/// Where a gap g ends that opens evenly at `speed` and closes by (g / excess)^2: dg/dt = speed - (g /
/// excess)^2, a tangent of time where g has the other sign than the speed, a hyperbolic one where it has the
/// same.
static double gap_after(double gap, double speed, double excess, double step)
{
    if (speed < 0) {
        return -gap_after(-gap, -speed, excess, step);
    }
    const double steady = excess * sqrt(speed);
    if (!(steady > 0)) {
        return gap / (1 + fabs(gap) * step / (excess * excess));
    }
    const double rate = sqrt(speed) / excess;
    double left = step;
    if (gap < 0) {
        // As a sum of angles: far behind a slow input atan would be a right angle to the last digit.
        const double turned = tan(fmin(rate * step, quarter_turn));
        if (rate * step < quarter_turn && gap + steady * turned < 0) {
            return steady * (gap + steady * turned) / (steady - gap * turned);
        }
        left += atan(gap / steady) / rate;
        gap = 0;
    }
    const double part = tanh(rate * left);
    return steady * (gap + steady * part) / (steady + gap * part);
}

field_state_t field_next(const field_t* field, const field_state_t* state, double input, double step)
{
    field_state_t next = {.input = input, .diffused = input};
    if (field->diffusion > 0) {
        diffuse(field, state, &next, step);
    }
    next.seen = next.diffused;
    // Below this its square is no normal number, and the gap is none.
    if (field->excess > 1e-150) {
        const double move = next.diffused - state->diffused;
        const double jump = field->diffusion > 0 ? 0 : field->hold * move;
        const double gap = state->diffused + jump - state->seen;
        next.seen -= gap_after(gap, (move - jump) / step, field->excess, step);
    }
    return next;
}
