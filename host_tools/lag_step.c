#include "lag_step.h"

#include <math.h>

bool lag_is_same_step(double a, double b)
{
    return fabs(a - b) <= 1e-9 * b;
}

lag_step_t lag_step(double step, double tau)
{
    if (!(tau > 0.0)) {
        return (lag_step_t){0.0, 1.0};
    }
    const double z = step / tau;
    const double missing = -expm1(-z);
    // Below 1e-5 the series is right to the last bit, where the difference cancels.
    return (lag_step_t){1.0 - missing, z < 1e-5 ? z * (0.5 - z / 6.0) : 1.0 - missing / z};
}

lag_step_t lag_step_held(double step, double tau, double hold)
{
    lag_step_t lag = lag_step(step, tau);
    const double end = hold > 0.0 ? 1.0 - lag.decay : 0.0;
    lag.ramp += fabs(hold) * (end - lag.ramp);
    return lag;
}

lag_step_t lag_step_kept(lag_kept_t* kept, double step, double tau, double hold)
{
    if (!lag_is_same_step(step, kept->step)) {
        *kept = (lag_kept_t){step, lag_step_held(step, tau, hold)};
    }
    return kept->lag;
}

double lag_next(lag_step_t lag, double state, double from, double to)
{
    return lag.decay * state + (1.0 - lag.decay) * from + lag.ramp * (to - from);
}
