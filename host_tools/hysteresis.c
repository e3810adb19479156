#include "hysteresis.h"

#include "extremes.h"
#include "lag_step.h"
#include "reference.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

hysteresis_t hysteresis_neutral(void)
{
    return (hysteresis_t){0};
}

void hysteresis_free(hysteresis_t* hysteresis)
{
    free(hysteresis->width);
    free(hysteresis->coercive);
    *hysteresis = hysteresis_neutral();
}

static bool differs(double value)
{
    return fabs(value) > 0.0;
}

bool hysteresis_has_past(const hysteresis_t* hysteresis)
{
    return hysteresis->start_fraction != NULL || hysteresis->turn != NULL;
}

void hysteresis_forget_past(hysteresis_t* hysteresis)
{
    hysteresis->start_fraction = NULL;
    hysteresis->turn = NULL;
    hysteresis->num_turns = 0;
}

bool hysteresis_is_stiffened(const hysteresis_t* hysteresis)
{
    return differs(hysteresis->stiffness.by_level) || differs(hysteresis->stiffness.even) ||
           differs(hysteresis->stiffness.odd);
}

bool hysteresis_sees_alone(const hysteresis_t* hysteresis)
{
    return !differs(hysteresis->play_lag) && !differs(hysteresis->widening) &&
           !differs(hysteresis->level_gain) && !differs(hysteresis->level_product) &&
           !differs(hysteresis->moving) && !differs(hysteresis->wear) && !differs(hysteresis->fade) &&
           !differs(hysteresis->remanence_field) && !hysteresis_is_stiffened(hysteresis) &&
           hysteresis->width == NULL && !hysteresis_has_past(hysteresis);
}

bool hysteresis_is_neutral(const hysteresis_t* hysteresis)
{
    return hysteresis_sees_alone(hysteresis) && field_is_neutral(&hysteresis->field) &&
           hysteresis->coercive == NULL && hysteresis->shift == NULL;
}

/// The input's place in the model's range, -1 ... 1; beyond the range its end's.
static double level(const model_t* model, double v)
{
    const double half = 0.5 * (model->input_max - model->input_min);
    return smaller(larger((v - model->input_min) / half - 1.0, -1.0), 1.0);
}

/// The middle and half of what the plays' sum spans between the saturations.
static void set_sum_range(hysteresis_state_t* state)
{
    const model_t* model = state->model;
    const double low = curve_value(&model->descending, model->input_min);
    const double high = curve_value(&model->ascending, model->input_max);
    for (size_t j = 0; j < model->num_plays; ++j) {
        state->sum_middle += model->weight[j] * 0.5 * (low + high);
        state->sum_half += model->weight[j] * fmax(0.5 * (high - low) - model->radius[j], 0.0);
    }
}

static double weighted_sum(const model_t* model, const double* memory)
{
    double sum = 0.0;
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j] * memory[j];
    }
    return sum;
}

/// Both envelopes at one end of a step, and what the radii grow by there.
typedef struct {
    double ascending, descending, extra;
} strip_t;

static strip_t strip_at(const model_t* model, double v, double extra)
{
    return (strip_t){curve_value(&model->ascending, v), curve_value(&model->descending, v), extra};
}

static double lower_end(const strip_t* strip, double radius)
{
    return strip->ascending - larger(radius + strip->extra, 0.0);
}

static double upper_end(const strip_t* strip, double radius)
{
    return strip->descending + larger(radius + strip->extra, 0.0);
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
    const double low[2] = {lower_end(from, radius), lower_end(to, radius)};
    const double high[2] = {upper_end(from, radius), upper_end(to, radius)};
    if (direction < 0) {
        w = pulled_up(w, low[0], low[1], step, lag);
        return pulled_down(w, high[0], high[1], step, lag);
    }
    w = pulled_down(w, high[0], high[1], step, lag);
    return pulled_up(w, low[0], low[1], step, lag);
}

/// Where radii change, a play may also be pushed while the input holds or by the strip's other side.
static double moved_between(double w, double radius, const strip_t* to, int direction)
{
    const double low = lower_end(to, radius);
    const double high = upper_end(to, radius);
    return direction < 0 ? smaller(high, larger(low, w)) : larger(low, smaller(high, w));
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

/// Returns the strip there where the plays have a lag: the next step's begin.
static strip_t move_plays(const hysteresis_state_t* state, double v, double step, double* memory)
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
    for (size_t j = 0; j < model->num_plays; ++j) {
        memory[j] = moved_between(state->memory[j], model->radius[j], &to, direction);
    }
    return (strip_t){0};
}

/// The input's new place, and the strip there.
static void come_to(hysteresis_state_t* state, double input, const strip_t* strip)
{
    state->input = input;
    state->ascending = strip->ascending;
    state->descending = strip->descending;
}

/// A command on its way to the plays.
typedef struct {
    double command;
    double field; ///< inside
    double seen;  ///< before the mean fields
} arrival_t;

/// The nonhysteretic part where the plays see `seen`.
static double nonhysteretic_at(const hysteresis_state_t* state, const arrival_t* to, double seen)
{
    const curve_t* nonhysteretic = &state->model->nonhysteretic;
    const double shift = state->hysteresis->shift_share * (seen - to->seen);
    const double direct = curve_value(nonhysteretic, to->command + shift);
    return differs(to->command - to->field)
               ? direct +
                     state->hysteresis->field.share * (curve_value(nonhysteretic, to->field + shift) - direct)
               : direct;
}

double hysteresis_seen(const hysteresis_t* hysteresis, const model_t* model, size_t sample, double field)
{
    const double middle = 0.5 * (model->input_min + model->input_max);
    return hysteresis->coercive != NULL ? field - hysteresis->coercive[sample] * (field - middle) : field;
}

double hysteresis_remanent_shift(const hysteresis_t* hysteresis, const model_t* model, double v, double y)
{
    const double half_range = 0.5 * (model->input_max - model->input_min);
    return half_range * hysteresis->remanence_field * loop_middle_remanence(hysteresis->middle, v, y);
}

/// What the plays see when they have seen that much and their sum is `sum`.
static double shift(const hysteresis_state_t* state, const arrival_t* to, double has_seen, double sum)
{
    const hysteresis_t* hysteresis = state->hysteresis;
    double seen = to->seen;
    if (differs(hysteresis->moving) && state->sum_half > 0.0) {
        const double half_range = 0.5 * (state->model->input_max - state->model->input_min);
        const double part = smaller(larger((sum - state->sum_middle) / state->sum_half, -1.0), 1.0);
        seen += hysteresis->moving * half_range * part;
    }
    if (differs(hysteresis->remanence_field)) {
        seen += hysteresis_remanent_shift(hysteresis, state->model, to->command,
                                          nonhysteretic_at(state, to, has_seen) + sum);
    }
    return seen;
}

/// The input within a mean field: shifted by what the plays give at that very input. A secant search of the
/// fixed point; between the plays' kinks the sum is nearly linear, so few steps do. It is unique where
/// the field's factor times the loop's relative steepness is below 1.
static double shifted(const hysteresis_state_t* state, const arrival_t* to, double step)
{
    enum { ITERATIONS = 30 };
    const model_t* model = state->model;
    if (!differs(state->hysteresis->moving) && !differs(state->hysteresis->remanence_field)) {
        return to->seen;
    }
    const double tolerance = 1e-13 * (model->input_max - model->input_min);
    double* scratch = state->memory + model->num_plays;
    double seen = shift(state, to, to->seen, state->sum);
    double before = seen;
    double image_before = seen;
    for (int i = 0; i < ITERATIONS; ++i) {
        (void)move_plays(state, seen, step, scratch);
        const double image = shift(state, to, seen, weighted_sum(model, scratch));
        if (fabs(image - seen) <= tolerance) {
            return image;
        }
        const double run = seen - before;
        const double slope = differs(run) ? (image - image_before) / run : 0.0;
        before = seen;
        image_before = image;
        seen = fabs(slope) < 0.95 ? (image - slope * seen) / (1.0 - slope) : image;
    }
    return seen;
}

/// What a step leads to, beside the plays' memory.
typedef struct {
    strip_t strip; ///< where the plays have a lag
    double seen, nonhysteretic, travel, sum, correction, middle, lagged_middle, ahead;
} outlook_t;

static bool has_direct(const hysteresis_t* hysteresis)
{
    return hysteresis->play_lag > 0.0 && hysteresis->lag_direct > 0.0;
}

/// The plays' part of the major loop's middle.
static double plays_middle(const hysteresis_state_t* state, double seen)
{
    return loop_middle_at(state->hysteresis->middle, seen) - curve_value(&state->model->nonhysteretic, seen);
}

/// The same, now at `middle`, as a play of no radius lags behind it, `step` seconds on.
static double next_middle(const hysteresis_state_t* state, double middle, double step)
{
    const lag_step_t lag = lag_step_held(step, state->hysteresis->play_lag, state->hysteresis->lag_hold);
    return lag_next(lag, state->lagged_middle, state->middle, middle);
}

/// How far increments (amplitude: the sum about its middle) scale at input v after `travel`.
static double increment_factor(const hysteresis_state_t* state, double v, double travel)
{
    const hysteresis_t* hysteresis = state->hysteresis;
    const double spans = travel / (state->model->input_max - state->model->input_min);
    return (1.0 + hysteresis->level_gain * level(state->model, v)) * exp(-hysteresis->wear * spans);
}

static double amplitude_factor(const hysteresis_state_t* state, double v, double travel)
{
    const hysteresis_t* hysteresis = state->hysteresis;
    const double spans = travel / (state->model->input_max - state->model->input_min);
    return (1.0 + hysteresis->level_product * level(state->model, v)) * exp(-hysteresis->fade * spans);
}

/// The next sample, its memory into scratch; its field where one lags.
static outlook_t look(const hysteresis_state_t* state, double v, double step, field_state_t* field)
{
    const hysteresis_t* hysteresis = state->hysteresis;
    double* scratch = state->memory + state->model->num_plays;
    outlook_t next = {0};
    double inside = v;
    if (!field_is_neutral(&hysteresis->field)) {
        *field = state->field;
        field_move(&hysteresis->field, field, v, step);
        inside = field->seen;
    }
    const arrival_t to = {v, inside, hysteresis_seen(hysteresis, state->model, state->sample + 1, inside)};
    next.seen = shifted(state, &to, step);
    next.nonhysteretic = nonhysteretic_at(state, &to, next.seen);
    next.strip = move_plays(state, next.seen, step, scratch);
    next.travel = state->travel + fabs(v - state->command);
    next.sum = weighted_sum(state->model, scratch);
    next.correction = state->correction;
    if (has_direct(hysteresis)) {
        next.middle = plays_middle(state, next.seen);
        next.lagged_middle = next_middle(state, next.middle, step);
        next.ahead = hysteresis->lag_direct * (next.middle - next.lagged_middle);
    }
    if (differs(hysteresis->level_gain) || differs(hysteresis->wear)) {
        const double factor =
            increment_factor(state, 0.5 * (v + state->command), 0.5 * (next.travel + state->travel));
        next.correction += (factor - 1.0) * (next.sum - state->sum);
    }
    return next;
}

double hysteresis_stiffened(const hysteresis_t* hysteresis, const model_t* model, double v, double y)
{
    if (!hysteresis_is_stiffened(hysteresis)) {
        return y;
    }
    const double at = level(model, v);
    const double factor = hysteresis->stiffness.by_level * at +
                          (at * at - 1.0) * (hysteresis->stiffness.even + at * hysteresis->stiffness.odd);
    return y + factor * (y - loop_middle_at(hysteresis->middle, v));
}

static double output_at(const hysteresis_state_t* state, double v, const outlook_t* at)
{
    const hysteresis_t* hysteresis = state->hysteresis;
    double output = at->nonhysteretic + at->sum + at->correction + at->ahead;
    if (differs(hysteresis->level_product) || differs(hysteresis->fade)) {
        output += (amplitude_factor(state, v, at->travel) - 1.0) * (at->sum - state->sum_middle);
    }
    return hysteresis_stiffened(hysteresis, state->model, v, output);
}

/// initial_state: each play between its strip's bottom, its own start and its strip's top by a fraction that
/// is linear over the radii; then 1-Lipschitz in the radius, as every memory is.
static void place_plays(const hysteresis_state_t* state)
{
    const model_t* model = state->model;
    const hysteresis_t* hysteresis = state->hysteresis;
    const double first = model->radius[0];
    const double span = model->radius[model->num_plays - 1] - first;
    const strip_t strip = strip_at(model, state->input, 0.0);
    for (size_t j = 0; j < model->num_plays; ++j) {
        const double radius = model->radius[j];
        const double last_node = (double)(hysteresis->num_nodes - 1);
        const double place = span > 0.0 ? (radius - first) / span * last_node : 0.0;
        const size_t node = (size_t)fmin(floor(place), last_node - 1.0);
        const double part = place - (double)node;
        const double fraction =
            (1.0 - part) * hysteresis->start_fraction[node] + part * hysteresis->start_fraction[node + 1];
        const double end = fraction > 0.0 ? upper_end(&strip, radius) : lower_end(&strip, radius);
        double* w = &state->memory[j];
        *w += fabs(fraction) * (end - *w);
        if (j > 0) {
            const double reach = radius - model->radius[j - 1];
            *w = fmin(fmax(*w, w[-1] - reach), w[-1] + reach);
        }
    }
}

/// The plays at the first sample, after the start's past and the turns since.
static reference_t past_of(const model_t* model, start_t start, const hysteresis_t* hysteresis,
                           double first_input)
{
    reference_t reference =
        reference_new(model, start, hysteresis->num_turns > 0 ? hysteresis->turn[0] : first_input);
    for (size_t k = 1; k < hysteresis->num_turns; ++k) {
        (void)reference_step(&reference, hysteresis->turn[k]);
    }
    (void)reference_step(&reference, first_input);
    return reference;
}

/// At rest at an input.
static void begin_at(hysteresis_state_t* state, double input)
{
    const strip_t strip = strip_at(state->model, input, 0.0);
    come_to(state, input, &strip);
    if (has_direct(state->hysteresis)) {
        state->middle = plays_middle(state, input);
        state->lagged_middle = state->middle;
    }
}

/// Plays with a lag on an even ramp from where they are, at the hysteresis' approach.
static void ramp_to(hysteresis_state_t* state, double to)
{
    enum { STEPS = 32 };
    const double from = state->input;
    const double step = fabs(to - from) / state->hysteresis->approach / STEPS;
    for (int k = 1; k <= STEPS && step > 0.0; ++k) {
        const double next = from + (to - from) * k / STEPS;
        const strip_t strip = move_plays(state, next, step, state->memory + state->model->num_plays);
        memcpy(state->memory, state->memory + state->model->num_plays,
               state->model->num_plays * sizeof(double));
        if (has_direct(state->hysteresis)) {
            const double middle = plays_middle(state, next);
            state->lagged_middle = next_middle(state, middle, step);
            state->middle = middle;
        }
        come_to(state, next, &strip);
    }
    state->input = to;
}

/// From where a way to this end of the range put the plays, towards where one from far beyond it had.
static void begin_beyond(hysteresis_state_t* state, bool from_top)
{
    const model_t* model = state->model;
    const strip_t strip = strip_at(model, state->input, 0.0);
    for (size_t j = 0; j < model->num_plays; ++j) {
        const double radius = model->radius[j];
        const double end = from_top ? upper_end(&strip, radius) : lower_end(&strip, radius);
        state->memory[j] += state->hysteresis->beyond * (end - state->memory[j]);
    }
}

/// The plays as a lag leaves them behind: what came before the last turn was at leisure, for a saturation
/// that was the other one. No column says how wide they were, and they may lie outside their strips.
static void approach_first(hysteresis_state_t* state, start_t start)
{
    const model_t* model = state->model;
    const hysteresis_t* hysteresis = state->hysteresis;
    hysteresis_t before_record = *hysteresis;
    before_record.width = NULL;
    state->hysteresis = &before_record;
    const double first = state->input;
    const bool from_top =
        start == START_NEGATIVE_SATURATION || (start == START_MODEL && model->initial == NULL);
    const bool is_saturated = hysteresis->num_turns == 0 && (from_top || start == START_POSITIVE_SATURATION);
    const start_t before = !is_saturated ? start
                           : from_top    ? START_POSITIVE_SATURATION
                                         : START_NEGATIVE_SATURATION;
    reference_t reference = hysteresis->num_turns > 0 ? past_of(model, start, hysteresis,
                                                                hysteresis->turn[hysteresis->num_turns - 1])
                                                      : reference_start(model, before);
    memcpy(state->memory, reference.memory, model->num_plays * sizeof(double));
    begin_at(state, reference.input);
    reference_free(&reference);
    if (is_saturated) {
        begin_beyond(state, from_top);
        ramp_to(state, from_top ? model->input_min : model->input_max);
    }
    ramp_to(state, first);
    state->hysteresis = hysteresis;
}

hysteresis_state_t hysteresis_start(const model_t* model, start_t start, const hysteresis_t* hysteresis,
                                    double first_input)
{
    const double seen = hysteresis_seen(hysteresis, model, 0, first_input);
    reference_t reference = past_of(model, start, hysteresis, seen);
    hysteresis_state_t state = {.model = model,
                                .hysteresis = hysteresis,
                                .command = first_input,
                                .field = field_start(first_input),
                                .memory = xcalloc(3 * model->num_plays + 1, sizeof(double))};
    memcpy(state.memory, reference.memory, model->num_plays * sizeof(double));
    reference_free(&reference);
    begin_at(&state, seen);
    const bool trails = differs(hysteresis->play_lag) && hysteresis->approach > 0.0;
    if (trails) {
        approach_first(&state, start);
    }
    if (hysteresis->start_fraction != NULL) {
        place_plays(&state);
    }
    if (hysteresis->width != NULL && !trails) {
        const strip_t strip = strip_at(model, seen, hysteresis->width[0]);
        for (size_t j = 0; j < model->num_plays; ++j) {
            state.memory[j] = moved_between(state.memory[j], model->radius[j], &strip, 0);
        }
    }
    if (has_direct(hysteresis)) {
        state.ahead = hysteresis->lag_direct * (state.middle - state.lagged_middle);
    }
    state.sum = weighted_sum(model, state.memory);
    state.nonhysteretic = curve_value(&model->nonhysteretic, first_input);
    set_sum_range(&state);
    return state;
}

void hysteresis_state_free(hysteresis_state_t* state)
{
    free(state->memory);
    *state = (hysteresis_state_t){0};
}

double hysteresis_output(const hysteresis_state_t* state)
{
    const outlook_t present = {
        .nonhysteretic = state->nonhysteretic,
        .travel = state->travel,
        .sum = state->sum,
        .correction = state->correction,
        .ahead = state->ahead,
    };
    return output_at(state, state->command, &present);
}

double hysteresis_step(hysteresis_state_t* state, double input, double step)
{
    field_state_t field;
    const outlook_t next = look(state, input, step, &field);
    memcpy(state->memory, state->memory + state->model->num_plays, state->model->num_plays * sizeof(double));
    state->sample += 1;
    come_to(state, next.seen, &next.strip);
    state->command = input;
    if (!field_is_neutral(&state->hysteresis->field)) {
        state->field = field;
    }
    state->travel = next.travel;
    state->sum = next.sum;
    state->nonhysteretic = next.nonhysteretic;
    state->correction = next.correction;
    state->middle = next.middle;
    state->lagged_middle = next.lagged_middle;
    state->ahead = next.ahead;
    return output_at(state, input, &next);
}

static double look_output(const hysteresis_state_t* state, double v, double step)
{
    field_state_t field;
    const outlook_t next = look(state, v, step, &field);
    return output_at(state, v, &next);
}

double hysteresis_inverse(const hysteresis_state_t* state, double wanted, double step, bool* clamped)
{
    const model_t* model = state->model;
    double near = fmin(fmax(state->command, model->input_min), model->input_max);
    const double present = look_output(state, near, step);
    *clamped = false;
    if (!(wanted > present) && !(wanted < present)) {
        return near;
    }
    const bool rising = wanted > present;
    double far = rising ? model->input_max : model->input_min;
    const double reach = look_output(state, far, step);
    // An end of the reachable outputs that was written with 15 digits and read back is still reachable.
    const double rounding = 1e-14 * fmax(fabs(reach), fabs(present));
    if (rising ? wanted >= reach : wanted <= reach) {
        *clamped = fabs(wanted - reach) > rounding;
        return far;
    }
    // 200 halvings reach below the last bit of the interval even where it contains 0.
    for (int i = 0; i < 200; ++i) {
        const double middle = near + 0.5 * (far - near);
        if (!(rising ? middle > near && middle < far : middle < near && middle > far)) {
            break;
        }
        const double output = look_output(state, middle, step);
        if (rising ? output >= wanted : output <= wanted) {
            far = middle;
        } else {
            near = middle;
        }
    }
    return far;
}

bool hysteresis_keeps_plays(const hysteresis_t* hysteresis)
{
    return !differs(hysteresis->play_lag) && !differs(hysteresis->widening) && !differs(hysteresis->moving) &&
           !differs(hysteresis->remanence_field) && hysteresis->width == NULL &&
           hysteresis->start_fraction == NULL;
}

void hysteresis_field(const hysteresis_t* hysteresis, const double* time, const double* input,
                      size_t num_samples, double* field)
{
    if (field_is_neutral(&hysteresis->field)) {
        memcpy(field, input, num_samples * sizeof *field);
        return;
    }
    field_state_t state = field_start(num_samples > 0 ? input[0] : 0.0);
    for (size_t i = 0; i < num_samples; ++i) {
        if (i > 0) {
            field_move(&hysteresis->field, &state, input[i], time[i] - time[i - 1]);
        }
        field[i] = state.seen;
    }
}

void hysteresis_from_sums(const model_t* model, const hysteresis_t* hysteresis, const double* input,
                          const double* sum, size_t num_samples, double* nonhysteretic)
{
    const bool scales = differs(hysteresis->level_gain) || differs(hysteresis->level_product) ||
                        differs(hysteresis->wear) || differs(hysteresis->fade);
    for (size_t i = 0; !scales && i < num_samples; ++i) {
        nonhysteretic[i] = hysteresis_stiffened(hysteresis, model, input[i], nonhysteretic[i] + sum[i]);
    }
    if (!scales) {
        return;
    }
    hysteresis_state_t state = {.model = model, .hysteresis = hysteresis};
    set_sum_range(&state);
    double travel = 0.0;
    double correction = 0.0;
    for (size_t i = 0; i < num_samples; ++i) {
        if (i > 0) {
            const double move = fabs(input[i] - input[i - 1]);
            correction +=
                (increment_factor(&state, 0.5 * (input[i] + input[i - 1]), travel + 0.5 * move) - 1.0) *
                (sum[i] - sum[i - 1]);
            travel += move;
        }
        nonhysteretic[i] += sum[i] + correction +
                            (amplitude_factor(&state, input[i], travel) - 1.0) * (sum[i] - state.sum_middle);
        nonhysteretic[i] = hysteresis_stiffened(hysteresis, model, input[i], nonhysteretic[i]);
    }
}

void hysteresis_run(const model_t* model, start_t start, const hysteresis_t* hysteresis, const double* time,
                    const double* input, size_t num_samples, double* output)
{
    if (num_samples == 0) {
        return;
    }
    if (hysteresis_is_neutral(hysteresis)) {
        reference_run(model, start, input, num_samples, output);
        return;
    }
    hysteresis_state_t state = hysteresis_start(model, start, hysteresis, input[0]);
    output[0] = hysteresis_output(&state);
    for (size_t i = 1; i < num_samples; ++i) {
        output[i] = hysteresis_step(&state, input[i], time[i] - time[i - 1]);
    }
    hysteresis_state_free(&state);
}
