#include "hyst_f32_internal.h"

/// An input within reach of one monotone move, and the output it would give.
typedef struct {
    float input;
    float output;
} point_t;

/// The stretch in which the wanted output is looked for. Invariant: `near` falls short of it, `far` does not.
typedef struct {
    const hyst_f32_model_t* model;
    const hyst_f32_state_t* state;
    float wanted;
    bool rising;
    uint32_t cell; ///< the table's cell that holds both ends, after search_knots
    point_t near;  ///< the end on the side of the present input
    point_t far;
} search_t;

/// The output after `input`, which lies in `cell`: the very arithmetic of a step, without storing.
static float look(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const uint32_t cell,
                  const float input, const bool rising)
{
    const float offset = model->constant + hyst_f32_nonhysteretic(model, cell, input);
    const float envelope = hyst_f32_envelope(model, cell, input, rising);
    return rising ? hyst_f32_respond(model, state->memory, NULL, envelope, true, offset)
                  : hyst_f32_respond(model, state->memory, NULL, envelope, false, offset);
}

/// Narrows the stretch to one side of `input`; true when that input falls short.
static bool probe(search_t* search, const uint32_t cell, const float input)
{
    const float output = look(search->model, search->state, cell, input, search->rising);
    const bool is_short = search->rising ? output < search->wanted : output > search->wanted;
    point_t* end = is_short ? &search->near : &search->far;
    end->input = input;
    end->output = output;
    return is_short;
}

/// Narrows the stretch to one cell. Counts knots from the present input on, doubling the stride while they
/// fall short (a tracked output is mostly near by), then halves: at most 2 log2(num_knots) probes.
static void search_knots(search_t* search)
{
    const uint32_t present = search->state->cell;
    uint32_t low = 0;
    uint32_t high = search->rising ? search->model->num_knots - 1 - present : present + 1;
    uint32_t stride = 1;
    while (high - low > 1) {
        const uint32_t half = (high - low) / 2;
        const uint32_t middle = low + (stride < half ? stride : half);
        const uint32_t knot = search->rising ? present + middle : present + 1 - middle;
        if (probe(search, knot, search->model->knot[knot].input)) {
            low = middle;
            stride *= 2;
        } else {
            high = middle;
        }
    }
    search->cell = search->rising ? present + low : present - low;
}

/// How many plays an input in the search's cell moves: the memory is 1-Lipschitz in the radius, so they are a
/// prefix.
static uint32_t count_moved(const search_t* search, const float input)
{
    const hyst_f32_model_t* model = search->model;
    const float envelope = hyst_f32_envelope(model, search->cell, input, search->rising);
    uint32_t low = 0;
    uint32_t high = model->num_plays;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const float pushed = hyst_f32_pushed(envelope, model->radius[middle], search->rising);
        if (hyst_f32_moves(pushed, search->state->memory[middle], search->rising)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/// x limited to the stretch, also where it is not a number.
static float limit_to_stretch(const search_t* search, const float x)
{
    return search->rising ? hyst_f32_limit(x, search->near.input, search->far.input)
                          : hyst_f32_limit(x, search->far.input, search->near.input);
}

/// The input at which the envelope reaches play j and starts to move it.
static float kink(const search_t* search, const uint32_t j)
{
    const float radius = search->model->radius[j];
    const float reached = hyst_f32_pushed(search->state->memory[j], radius, !search->rising);
    if (search->model->num_knots == 0) {
        return limit_to_stretch(search, reached);
    }
    const hyst_f32_knot_t* knot = &search->model->knot[search->cell];
    const float value = search->rising ? knot->ascending : knot->descending;
    const float slope = search->rising ? knot->ascending_slope : knot->descending_slope;
    return limit_to_stretch(search, knot->input + (reached - value) / slope);
}

/// Narrows the stretch until no play starts to move within it, so that the output is linear there.
static void search_kinks(search_t* search)
{
    uint32_t low = count_moved(search, search->near.input);
    uint32_t high = count_moved(search, search->far.input);
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (probe(search, search->cell, kink(search, middle))) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
}

/// Solves the one linear equation, from the end that is closer. The ends' outputs differ: one falls short.
static float solve(const search_t* search)
{
    const point_t near = search->near;
    const point_t far = search->far;
    const float rise = far.output - near.output;
    const float width = far.input - near.input;
    const float after = (search->wanted - near.output) / rise;
    const float before = (far.output - search->wanted) / rise;
    return limit_to_stretch(search, after < before ? near.input + after * width : far.input - before * width);
}

hyst_f32_inverse_t hyst_f32_inverse(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                    const float wanted)
{
    const uint32_t last_cell = model->num_knots == 0 ? 0 : model->num_knots - 2;
    hyst_f32_inverse_t result;
    result.input = state->input;
    result.reachable_min = look(model, state, 0, model->input_min, false);
    result.reachable_max = look(model, state, last_cell, model->input_max, true);
    result.clamped = !(wanted >= result.reachable_min && wanted <= result.reachable_max);
    if (hyst_f32_is_nan(wanted)) {
        return result;
    }
    search_t search;
    search.wanted = hyst_f32_limit(wanted, result.reachable_min, result.reachable_max);
    search.rising = search.wanted > state->output;
    if (!search.rising && !(search.wanted < state->output)) {
        return result;
    }
    search.model = model;
    search.state = state;
    search.cell = state->cell;
    search.near.input = state->input;
    search.near.output = state->output;
    search.far.input = search.rising ? model->input_max : model->input_min;
    search.far.output = search.rising ? result.reachable_max : result.reachable_min;
    if (model->num_knots != 0) {
        search_knots(&search);
    }
    search_kinks(&search);
    result.input = solve(&search);
    return result;
}
