#include "hyst_f32_segments.h"

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
    uint32_t cell; ///< the table's cell that holds both ends, after search_cells
    point_t near;  ///< the end on the side of the present input
    point_t far;
} search_t;

/// The curves of a cell as lines through its first knot.
typedef struct {
    float input, envelope, envelope_slope, offset, offset_slope;
} lines_t;

static lines_t lines_of(const hyst_f32_model_t* model, const uint32_t cell, const bool rising)
{
    if (model->num_knots == 0) {
        const lines_t identity = {0.0f, 0.0f, 1.0f, model->constant, model->nonhysteretic_slope};
        return identity;
    }
    const hyst_f32_knot_t* knot = &model->knot[cell];
    const lines_t lines = {knot->input, rising ? knot->ascending : knot->descending,
                           rising ? knot->ascending_slope : knot->descending_slope,
                           model->constant + knot->nonhysteretic, knot->nonhysteretic_slope};
    return lines;
}

/// The output after `input`, which lies in `cell`: the very arithmetic of a step, without storing.
static float look(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const uint32_t cell,
                  const float input, const bool rising)
{
    const float envelope = hyst_f32_envelope(model, cell, input, rising);
    hyst_f32_front_t front;
    float plays = hyst_f32_forward(state->plays, rising);
    if (hyst_f32_meet(model, state, rising, envelope, &front)) {
        plays = hyst_f32_larger(front.sum, plays);
    }
    return hyst_f32_offset(model, cell, input) + hyst_f32_forward(plays, rising);
}

/// Narrows the stretch to one side of the point; true when it falls short.
static bool narrow(search_t* search, const point_t point)
{
    const bool is_short = search->rising ? point.output < search->wanted : point.output > search->wanted;
    point_t* end = is_short ? &search->near : &search->far;
    *end = point;
    return is_short;
}

static bool probe(search_t* search, const uint32_t cell, const float input)
{
    const point_t point = {input, look(search->model, search->state, cell, input, search->rising)};
    return narrow(search, point);
}

/// Narrows the stretch to one cell. Counts knots from the present input on, doubling the stride while they
/// fall short (a tracked output is mostly near by), then halves: at most 2 log2(num_knots) probes.
static void search_cells(search_t* search)
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

/// Narrows the stretch by the point in the cell where the envelope reaches `ahead` and the plays' part `sum`,
/// both in the direction of the move; true when the wanted output lies beyond.
static bool probe_kink(search_t* search, const lines_t* lines, const float ahead, const float sum)
{
    const bool rising = search->rising;
    const float along = (hyst_f32_forward(ahead, rising) - lines->envelope) / lines->envelope_slope;
    const float input = lines->input + along;
    const float near = hyst_f32_forward(search->near.input, rising);
    const float far = hyst_f32_forward(search->far.input, rising);
    // A flat envelope gives no number where all of the cell is on one side.
    if (!(hyst_f32_forward(input, rising) > near)) {
        return true;
    }
    if (!(hyst_f32_forward(input, rising) < far)) {
        return false;
    }
    const point_t point = {input, lines->offset + lines->offset_slope * (input - lines->input) +
                                      hyst_f32_forward(sum, rising)};
    return narrow(search, point);
}

/// How many segments are kept: the first one out whose end is not short of the wanted output. `top` is the
/// front with its sum in the search's direction.
static uint32_t search_segments(search_t* search, const lines_t* lines, const hyst_f32_segment_t* top)
{
    const hyst_f32_play_t* play = search->model->play;
    const bool rising = search->rising;
    uint32_t low = 0;
    uint32_t high = search->state->front + 1;
    uint32_t middle = high;
    while (low < high) {
        const hyst_f32_segment_t* segment =
            middle == search->state->front + 1 ? top : &search->state->memory[middle - 1];
        const float opening = (segment->rising != 0) == rising ? 0.0f : play[segment->last].opening;
        if (probe_kink(search, lines, hyst_f32_forward(segment->level, rising) + opening,
                       hyst_f32_forward(segment->sum[rising], rising))) {
            high = middle - 1;
        } else {
            low = middle;
        }
        middle = high - (high - low) / 2;
    }
    return low;
}

/// Narrows the stretch over a segment left in the other direction to one between two openings.
static void search_openings(search_t* search, const lines_t* lines, const hyst_f32_segment_t* kept,
                            uint32_t low)
{
    const hyst_f32_play_t* play = search->model->play;
    const float level = hyst_f32_forward(kept->level, search->rising);
    const float end = hyst_f32_forward(kept->sum[search->rising], search->rising);
    uint32_t high = kept->last;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const float sum = end - (play[kept->last].loading - play[middle].loading);
        if (probe_kink(search, lines, level + play[middle].opening, sum)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
}

/// Narrows the stretch in its cell until the output is linear there.
static void search_kinks(search_t* search)
{
    const uint32_t front = search->state->front;
    const hyst_f32_segment_t* memory = search->state->memory;
    const lines_t lines = lines_of(search->model, search->cell, search->rising);
    hyst_f32_segment_t top = memory[front];
    if ((top.rising != 0) != search->rising) {
        top.sum[search->rising] = hyst_f32_end_of(search->model, memory, front, search->rising);
    }
    const uint32_t num_kept = search_segments(search, &lines, &top);
    const hyst_f32_segment_t* kept = num_kept == front + 1 ? &top : &memory[num_kept - 1];
    if (num_kept != 0 && (kept->rising != 0) != search->rising) {
        search_openings(search, &lines, kept, num_kept == front + 1 ? 0 : memory[num_kept].last + 1u);
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
    const float input = after < before ? near.input + after * width : far.input - before * width;
    return search->rising ? hyst_f32_limit(input, near.input, far.input)
                          : hyst_f32_limit(input, far.input, near.input);
}

hyst_f32_inverse_t hyst_f32_inverse(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                    const float wanted)
{
    hyst_f32_inverse_t result = {state->input, hyst_f32_is_nan(wanted)};
    search_t search;
    search.rising = wanted > state->output;
    if (!search.rising && !(wanted < state->output)) {
        return result;
    }
    search.model = model;
    search.state = state;
    search.wanted = wanted;
    search.cell = state->cell;
    search.near.input = state->input;
    search.near.output = state->output;
    search.far.input = search.rising ? model->input_max : model->input_min;
    search.far.output =
        look(model, state, search.rising ? hyst_f32_last_cell(model) : 0, search.far.input, search.rising);
    if (search.rising ? search.far.output < wanted : search.far.output > wanted) {
        result.clamped = true;
        search.wanted = search.far.output;
        if (!(search.far.output > state->output) && !(search.far.output < state->output)) {
            return result;
        }
    }
    if (model->num_knots != 0) {
        search_cells(&search);
    }
    search_kinks(&search);
    result.input = solve(&search);
    return result;
}

hyst_f32_reach_t hyst_f32_reachable(const hyst_f32_model_t* model, const hyst_f32_state_t* state)
{
    hyst_f32_reach_t reach = {state->output, state->output};
    if (state->input > model->input_min) {
        reach.reachable_min = look(model, state, 0, model->input_min, false);
    }
    if (state->input < model->input_max) {
        reach.reachable_max = look(model, state, hyst_f32_last_cell(model), model->input_max, true);
    }
    return reach;
}
