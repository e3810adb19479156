/// A first-order lag's step, exact for an input that is linear between the samples.
#ifndef HYST_HOST_LAG_STEP_H
#define HYST_HOST_LAG_STEP_H

#include <stdbool.h>

/// What a step of a lag does: next = decay * state + (1 - decay) * u0 + ramp * (u1 - u0).
typedef struct {
    double decay, ramp;
} lag_step_t;
/// Whether two steps are an even clock's, whose rounding changes the last digits only: times of 1e5 s are
/// rounded to 1.5e-10 of a step of 0.1 s.
bool lag_is_same_step(double a, double b);
/// tau 0: the input itself.
lag_step_t lag_step(double step, double tau);
/// The same where the input does not go straight between the samples: hold 1, it is at once where the next
/// sample has it; -1, it stays until then; 0, straight.
lag_step_t lag_step_held(double step, double tau, double hold);
/// A lag's step, set up once for an even clock; starts as {0}.
typedef struct {
    double step; ///< [s] that `lag` is for
    lag_step_t lag;
} lag_kept_t;
/// lag_step_held for a tau and a hold that are the same at each call.
lag_step_t lag_step_kept(lag_kept_t* kept, double step, double tau, double hold);
double lag_next(lag_step_t lag, double state, double from, double to);

#endif
