#include "hysteresis.h"

#include "hysteresis_plays.h"
#include "reference.h"
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
    free(hysteresis->coercive_direct);
    *hysteresis = hysteresis_neutral();
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

/// A command on its way to the plays.
typedef struct {
    double command;
    double field;    ///< inside
    double seen;     ///< before the mean fields
    double set_back; ///< by which the nonhysteretic part sees less
} arrival_t;

/// The nonhysteretic part where the plays see `seen`.
static double nonhysteretic_at(const hysteresis_state_t* state, const arrival_t* to, double seen)
{
    const curve_t* nonhysteretic = &state->model->nonhysteretic;
    const double shift = state->hysteresis->shift_share * (seen - to->seen) - to->set_back;
    const double direct = curve_value(nonhysteretic, to->command + shift);
    return differs(to->command - to->field)
               ? direct +
                     state->hysteresis->field.share * (curve_value(nonhysteretic, to->field + shift) - direct)
               : direct;
}

/// What scaling by 1 - factor about the range's middle takes away.
static double taken(const model_t* model, const double* factor, size_t sample, double field)
{
    const double middle = 0.5 * (model->input_min + model->input_max);
    return factor != NULL ? factor[sample] * (field - middle) : 0.0;
}

double hysteresis_seen(const hysteresis_t* hysteresis, const model_t* model, size_t sample, double field)
{
    return field - taken(model, hysteresis->coercive, sample, field);
}

double hysteresis_set_back(const hysteresis_t* hysteresis, const model_t* model, size_t sample, double field)
{
    return taken(model, hysteresis->coercive_direct, sample, field);
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
        (void)plays_move(state, seen, step, scratch);
        const double image = shift(state, to, seen, plays_sum(model, scratch));
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
    const size_t sample = state->sample + 1;
    const arrival_t to = {v, inside, hysteresis_seen(hysteresis, state->model, sample, inside),
                          hysteresis_set_back(hysteresis, state->model, sample, inside)};
    next.seen = shifted(state, &to, step);
    next.nonhysteretic = nonhysteretic_at(state, &to, next.seen);
    next.strip = plays_move(state, next.seen, step, scratch);
    next.travel = state->travel + fabs(v - state->command);
    next.sum = plays_sum(state->model, scratch);
    next.correction = state->correction;
    if (plays_have_direct(hysteresis)) {
        next.middle = plays_middle(state, next.seen);
        next.lagged_middle = plays_next_middle(state, next.middle, step);
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
    plays_come_to(state, next.seen, &next.strip);
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
    plays_set_sum_range(&state);
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
