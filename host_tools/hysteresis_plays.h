/// How the plays of a run with effects move (hysteresis.h): at once, with radii that change, or with a lag.
#ifndef HYST_HOST_HYSTERESIS_PLAYS_H
#define HYST_HOST_HYSTERESIS_PLAYS_H

#include "extremes.h"
#include "hysteresis.h"
#include <math.h>
#include <stdbool.h>

/// Whether a number that an effect sets is another than where that does nothing.
static inline bool differs(double value)
{
    return fabs(value) > 0.0;
}

/// Both envelopes at one end of a step, and what the radii grow by there.
typedef struct {
    double ascending, descending, extra;
} strip_t;

strip_t strip_at(const model_t* model, double v, double extra);

static inline double strip_low(const strip_t* strip, double radius)
{
    return strip->ascending - larger(radius + strip->extra, 0.0);
}

static inline double strip_high(const strip_t* strip, double radius)
{
    return strip->descending + larger(radius + strip->extra, 0.0);
}

/// The plays' states behind a step to v in `step` seconds: memory[num_plays]. Returns the strip there where
/// the plays have a lag: the next step's begin.
strip_t plays_move(const hysteresis_state_t* state, double v, double step, double* memory);
/// Where radii change, a play may also be pushed while the input holds (direction 0) or by the strip's other
/// side.
void plays_move_between(const hysteresis_state_t* state, const strip_t* to, int direction, double* memory);
/// The input's new place, and the strip there.
void plays_come_to(hysteresis_state_t* state, double input, const strip_t* strip);

double plays_sum(const model_t* model, const double* memory);
/// The middle and half of what the plays' sum spans between the saturations.
void plays_set_sum_range(hysteresis_state_t* state);

/// Whether a part of what a lag holds back comes at once.
bool plays_have_direct(const hysteresis_t* hysteresis);
/// The plays' part of the major loop's middle.
double plays_middle(const hysteresis_state_t* state, double seen);
/// The same, now at `middle`, as a play of no radius lags behind it, `step` seconds on.
double plays_next_middle(const hysteresis_state_t* state, double middle, double step);

#endif
