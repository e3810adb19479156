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

/// The mean across the lamination when the input has moved.
static double diffuse(const field_t* field, field_state_t* state, double input, double step)
{
    static const double pi = 3.14159265358979323846;
    double diffused = input;
    for (size_t k = 0; k < FIELD_MODES; k++) {
        const double odd = 2 * (double)k + 1;
        const lag_step_t lag =
            lag_step_kept(&state->lag[k], step, field->diffusion / (odd * odd), field->hold);
        state->mode[k] = lag_next(lag, state->mode[k], state->input, input);
        diffused += 8 / (pi * pi * odd * odd) * (state->mode[k] - input);
    }
    return diffused;
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
    // tanh by one exponential, which takes half the time.
    const double decay = exp(-2 * rate * left);
    const double part = (1 - decay) / (1 + decay);
    return steady * (gap + steady * part) / (steady + gap * part);
}

void field_move(const field_t* field, field_state_t* state, double input, double step)
{
    const double before = state->diffused;
    state->diffused = field->diffusion > 0 ? diffuse(field, state, input, step) : input;
    state->input = input;
    // Below this its square is no normal number, and the gap is none.
    if (!(field->excess > 1e-150)) {
        state->seen = state->diffused;
        return;
    }
    const double move = state->diffused - before;
    const double jump = field->diffusion > 0 ? 0 : field->hold * move;
    const double gap = before + jump - state->seen;
    state->seen = state->diffused - gap_after(gap, (move - jump) / step, field->excess, step);
}
