#include "element.h"

#include "extremes.h"
#include <math.h>
#include <stdbool.h>

enum { INTERVALS = ELEMENT_CURVE - 3 };

/// Of the input's range, the largest move that is one step.
static const double longest_step = 0.01;
/// Of the input's range, how far beyond it an element goes on: an effect may let it see more than the
/// command.
static const double most_beyond = 0.5;
/// Of the pinning, what the denominator of the wall's slope may not fall below: the walls then jump.
static const double least_pinning = 0.02;

static double bouc_wen_slope(const element_t* e, double z, bool rising)
{
    double pull = 1;
    if (z > 0) {
        pull = rising ? 1 : e->shape[BOUC_WEN_FALLING_BACK];
    } else {
        pull = rising ? e->shape[BOUC_WEN_RISING_BACK] : e->shape[BOUC_WEN_FALLING];
    }
    // The force never falls while the way it opposes grows.
    return e->shape[BOUC_WEN_STEEPNESS] * larger(1 - pow(fabs(z), e->shape[BOUC_WEN_ORDER]) * pull, 0);
}

/// Where in a step its slope is taken, in parts of the step.
static double moment(const element_t* e, size_t ahead)
{
    return 0.5 * (1 + e->shape[ahead]);
}

static void bouc_wen_move(element_state_t* s, double move)
{
    const bool rising = move > 0;
    const double slope = bouc_wen_slope(s->element, s->inner, rising);
    const double then = s->inner + moment(s->element, ELEMENT_STATE_AHEAD) * move * slope;
    s->inner += move * bouc_wen_slope(s->element, then, rising);
    s->state = s->inner;
}

/// coth x - 1/x; by exp, which takes half of tanh's time: in a search with such a body, most of it goes here.
static double langevin(double x)
{
    if (fabs(x) < 1e-2) {
        return x / 3 - x * x * x / 45;
    }
    const double decay = exp(-2 * fabs(x));
    return copysign((1 + decay) / (1 - decay), x) - 1 / x;
}

static double ideal_at(const element_t* e, double part, double magnetisation)
{
    const double field = 2 * part - 1 - e->shape[ATHERTON_CENTRE];
    return langevin((field + e->shape[ATHERTON_COUPLING] * magnetisation) / e->shape[ATHERTON_SHAPE]);
}

static double magnetisation(const element_t* e, double ideal, double wall)
{
    return e->shape[ATHERTON_BOWING] * ideal + (1 - e->shape[ATHERTON_BOWING]) * wall;
}

static double wall_slope(const element_t* e, double ideal, double wall, bool rising)
{
    const double lack = rising ? ideal - wall : wall - ideal;
    const double pinning = e->shape[ATHERTON_PINNING];
    const double stiff = larger(pinning - e->shape[ATHERTON_COUPLING] * lack, least_pinning * pinning);
    return lack > 0 ? 2 * lack / stiff : 0;
}

static void atherton_move(element_state_t* s, double move)
{
    const element_t* e = s->element;
    const bool rising = move > 0;
    const double of_state = moment(e, ELEMENT_STATE_AHEAD);
    const double part = s->part + moment(e, ELEMENT_INPUT_AHEAD) * move;
    const double walls = move * wall_slope(e, s->ideal, s->inner, rising);
    const double change =
        magnetisation(e, ideal_at(e, s->part + move, s->state), s->inner + walls) - s->state;
    const double ideal = ideal_at(e, part, s->state + of_state * change);
    s->inner += move * wall_slope(e, ideal, s->inner + of_state * walls, rising);
    s->ideal = ideal_at(e, s->part + move, s->state + smaller(2 * of_state, 1) * change);
    s->state = magnetisation(e, s->ideal, s->inner);
}

static double move_to(element_state_t* s, double part)
{
    const double way = part - s->part;
    const size_t pieces = 1 + (size_t)(fabs(way) / longest_step);
    const double move = way / (double)pieces;
    for (size_t k = 0; (way > 0 || way < 0) && k < pieces; k++) {
        if (s->element->kind == ELEMENT_BOUC_WEN) {
            bouc_wen_move(s, move);
        } else {
            atherton_move(s, move);
        }
        s->part += move;
    }
    s->part = part;
    return s->state;
}

element_state_t element_saturated(const element_t* element)
{
    element_state_t s = {.element = element,
                         .ideal = element->kind == ELEMENT_JILES_ATHERTON ? ideal_at(element, 0, 0) : 0};
    (void)move_to(&s, 1);
    (void)move_to(&s, 0);
    return s;
}

double element_part(const element_t* e, double input)
{
    const double part = (input - e->input_min) / (e->input_max - e->input_min);
    return smaller(larger(part, -most_beyond), 1 + most_beyond);
}

double element_step(element_state_t* s, double input)
{
    return move_to(s, element_part(s->element, input));
}

static double within_range(double part)
{
    return smaller(larger(part, 0), 1);
}

/// The four splines that are not 0 at a part of the range, within it; returns the first one's number.
static size_t splines_at(double part, double* value)
{
    const double place = within_range(part) * INTERVALS;
    const size_t i = place < INTERVALS - 1 ? (size_t)place : INTERVALS - 1;
    const double b = place - (double)i;
    const double a = 1 - b;
    value[0] = a * a * a / 6;
    value[1] = (1 + 3 * a * (1 + a * b)) / 6;
    value[2] = (1 + 3 * b * (1 + a * b)) / 6;
    value[3] = b * b * b / 6;
    return i;
}

void element_splines(double part, double* spline)
{
    for (size_t k = 0; k < ELEMENT_CURVE; k++) {
        spline[k] = 0;
    }
    double value[4];
    const size_t first = splines_at(part, value);
    for (size_t k = 0; k < 4; k++) {
        spline[first + k] = value[k];
    }
}

static double curve_within(const element_t* e, double part)
{
    double value[4];
    const double* curve = &e->curve[splines_at(part, value)];
    return value[0] * curve[0] + value[1] * curve[1] + value[2] * curve[2] + value[3] * curve[3];
}

/// Beyond the range it goes on straight, as steep as over the last two splines there.
static double curve_at(const element_t* e, double part)
{
    const double within = within_range(part);
    const double value = curve_within(e, within);
    if (!(part < 0 || part > 1)) {
        return value;
    }
    const double back = within + (part > 1 ? -1 : 1) * 2.0 / INTERVALS;
    return value + (value - curve_within(e, back)) / (within - back) * (part - within);
}

double element_nonhysteretic(const element_t* element, double input)
{
    return curve_at(element, element_part(element, input));
}

/// Where the state gives this output at the present input, or as near as an element gets there.
static void place(element_state_t* s, double output)
{
    const element_t* e = s->element;
    s->state = (output - curve_at(e, s->part)) / e->gain;
    if (e->kind == ELEMENT_BOUC_WEN) {
        const double fallen = -pow(e->shape[BOUC_WEN_FALLING], -1 / e->shape[BOUC_WEN_ORDER]);
        s->state = fmin(fmax(s->state, fallen), 1);
        s->inner = s->state;
    } else {
        s->state = fmin(fmax(s->state, -1), 1);
        s->ideal = ideal_at(e, s->part, s->state);
        s->inner = (s->state - e->shape[ATHERTON_BOWING] * s->ideal) / (1 - e->shape[ATHERTON_BOWING]);
    }
}

static double output_of(const element_state_t* s)
{
    return s->element->gain * s->state + curve_at(s->element, s->part);
}

void element_run(const element_t* element, double shift, const double* input, size_t num_samples,
                 double* output)
{
    element_state_t s = element_saturated(element);
    for (size_t t = 0; t < num_samples; t++) {
        (void)element_step(&s, input[t]);
        if (t == 0 && (shift > 0 || shift < 0)) {
            place(&s, output_of(&s) + shift);
        }
        output[t] = output_of(&s);
    }
}
