/// The plays at the first sample, by what came before it.
#include "hysteresis_plays.h"
#include "reference.h"
#include <string.h>

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
        const double end = fraction > 0.0 ? strip_high(&strip, radius) : strip_low(&strip, radius);
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
    plays_come_to(state, input, &strip);
    if (plays_have_direct(state->hysteresis)) {
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
        const strip_t strip = plays_move(state, next, step, state->memory + state->model->num_plays);
        memcpy(state->memory, state->memory + state->model->num_plays,
               state->model->num_plays * sizeof(double));
        if (plays_have_direct(state->hysteresis)) {
            const double middle = plays_middle(state, next);
            state->lagged_middle = plays_next_middle(state, middle, step);
            state->middle = middle;
        }
        plays_come_to(state, next, &strip);
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
        const double end = from_top ? strip_high(&strip, radius) : strip_low(&strip, radius);
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
        plays_move_between(&state, &strip, 0, state.memory);
    }
    if (plays_have_direct(hysteresis)) {
        state.ahead = hysteresis->lag_direct * (state.middle - state.lagged_middle);
    }
    state.sum = plays_sum(model, state.memory);
    state.nonhysteretic = curve_value(&model->nonhysteretic,
                                      first_input - hysteresis_set_back(hysteresis, model, 0, first_input));
    plays_set_sum_range(&state);
    return state;
}
