#include "hyst_q_internal.h"

/// An input on the way, by its distance from the present one, and the output there.
typedef struct {
    uint32_t distance;
    hyst_q_value_t output;
} point_t;

/// A search away from the present input for the nearest one whose output reaches `wanted`. It lies behind
/// `near`, whose output falls short, and not behind `far`, whose output does not.
typedef struct {
    const hyst_q_model_t* model;
    const hyst_q_state_t* state;
    hyst_q_value_t wanted;
    bool rising;
    uint32_t cell;
    point_t near;
    point_t far;
} search_t;

static hyst_q_value_t input_at(const search_t* search, const uint32_t distance)
{
    const int64_t from = search->state->input;
    return (hyst_q_value_t)(search->rising ? from + (int64_t)distance : from - (int64_t)distance);
}

static uint32_t distance_of(const search_t* search, const hyst_q_value_t v)
{
    const uint32_t up = (uint32_t)v - (uint32_t)search->state->input;
    return search->rising ? up : 0U - up;
}

/// The output that v, in `cell`, would give.
static hyst_q_value_t look(const hyst_q_model_t* model, const hyst_q_state_t* state, const uint32_t cell,
                           const hyst_q_value_t v, const bool rising)
{
    if (v == state->input) {
        return state->output;
    }
    const uint32_t level = hyst_q_envelope(model, cell, v, rising);
    const hyst_q_front_t front = HYST_Q(find_front)(model, state, level, rising);
    return hyst_q_output(model, cell, v, front.below + hyst_q_front_part(model, front.end, level, !rising));
}

/// Takes the point as the stretch's near or far end; true: the near one.
static bool narrow(search_t* search, const uint32_t distance, const hyst_q_value_t output)
{
    const point_t point = {distance, output};
    const bool short_of = search->rising ? output < search->wanted : output > search->wanted;
    if (short_of) {
        search->near = point;
    } else {
        search->far = point;
    }
    return short_of;
}

/// Narrows the stretch to one cell of the table.
static void search_cells(search_t* search)
{
    const hyst_q_model_t* model = search->model;
    const uint32_t first = search->state->cell;
    uint32_t low = search->rising ? first : 0;
    uint32_t high = search->rising ? model->num_knots - 2 : first;
    // The present cell first: a small correction stays in it.
    uint32_t middle = search->rising ? low : high - (high > low ? 1 : 0);
    while (low < high) {
        const hyst_q_value_t v = model->knot[middle + 1].input;
        const bool short_of =
            narrow(search, distance_of(search, v), look(model, search->state, middle, v, search->rising));
        if (short_of == search->rising) {
            low = middle + 1;
        } else {
            high = middle;
        }
        middle = low + (high - low) / 2;
    }
    search->cell = low;
}

/// How many plays an input at this distance in the cell moves.
static hyst_q_front_t front_at(const search_t* search, const uint32_t distance)
{
    const uint32_t level =
        hyst_q_envelope(search->model, search->cell, input_at(search, distance), search->rising);
    return HYST_Q(find_front)(search->model, search->state, level, search->rising);
}

/// The state of play j, found among the segments by halving.
static uint32_t play_state(const hyst_q_model_t* model, const hyst_q_state_t* state, const uint32_t j)
{
    uint32_t low = 0;
    uint32_t high = state->num_segments - 1;
    while (low < high) {
        const uint32_t middle = high - (high - low) / 2;
        if (state->segment[middle].end > j) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return hyst_q_play(model, &state->segment[low], j);
}

/// The least distance at which play j moves; it does at the far end of the stretch.
static uint32_t kink(const search_t* search, const uint32_t j)
{
    const hyst_q_knot_t* knot = &search->model->knot[search->cell];
    const uint32_t value = search->rising ? knot->ascending : knot->descending;
    const uint32_t slope = search->rising ? knot->ascending_slope : knot->descending_slope;
    const uint32_t w = play_state(search->model, search->state, j);
    const uint32_t radius = search->model->radius[j];
    // The first level that the line must reach: one above w + r when rising; falling, one below w - r is the
    // last level before it reaches w - r.
    const uint32_t level = search->rising ? w + radius + 1 : w - radius;
    uint32_t behind = 0; // of the knot, the least at which the line reaches the level
    if (level > value) {
        const hyst_q_sum_t needed = ((hyst_q_sum_t)(level - value) << HYST_Q_BITS) - HYST_Q_HALF;
        const hyst_q_sum_t unit = (hyst_q_sum_t)slope << knot->shift;
        behind = (uint32_t)((needed - 1) / unit + 1);
    }
    // How far the knot lies ahead of the present input; a knot behind it wraps and comes right with the sum.
    const uint32_t ahead = (uint32_t)knot->input - (uint32_t)search->state->input;
    return search->rising ? ahead + behind : 1U - (ahead + behind);
}

/// Narrows the stretch until no play starts to move between its ends.
static void search_kinks(search_t* search)
{
    uint32_t low = front_at(search, search->near.distance).end;
    uint32_t high = front_at(search, search->far.distance).end;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const uint32_t distance = kink(search, middle);
        const hyst_q_value_t v = input_at(search, distance);
        const hyst_q_value_t output = look(search->model, search->state, search->cell, v, search->rising);
        if (narrow(search, distance, output)) {
            low = front_at(search, distance).end;
        } else {
            high = middle;
        }
    }
}

/// The output at this distance, within a stretch whose plays before front->end move.
static hyst_q_value_t output_within(const search_t* search, const hyst_q_front_t* front,
                                    const uint32_t distance)
{
    const hyst_q_model_t* model = search->model;
    const hyst_q_value_t v = input_at(search, distance);
    const uint32_t level = hyst_q_envelope(model, search->cell, v, search->rising);
    return hyst_q_output(model, search->cell, v,
                         front->below + hyst_q_front_part(model, front->end, level, !search->rising));
}

static uint32_t apart(const hyst_q_value_t a, const hyst_q_value_t b)
{
    return a < b ? (uint32_t)b - (uint32_t)a : (uint32_t)a - (uint32_t)b;
}

/// Where the straight line between the stretch's ends reaches the wanted output: between the ends.
static uint32_t straight(const search_t* search)
{
    const uint32_t width = search->far.distance - search->near.distance;
    const uint64_t rise = apart(search->far.output, search->near.output);
    const uint64_t part = apart(search->wanted, search->near.output);
    const uint32_t ahead = (uint32_t)(part * width / rise);
    return search->near.distance + (ahead == 0 ? 1U : ahead == width ? width - 1 : ahead);
}

/// Finds the answer in a stretch without kinks. Rounding takes the outputs off a straight line by a few
/// units: from where that line says, steps that double enclose the answer, and halvings find it.
static void search_stretch(search_t* search)
{
    if (search->far.distance - search->near.distance < 2) {
        return;
    }
    const hyst_q_front_t front = front_at(search, search->near.distance);
    uint32_t distance = straight(search);
    uint32_t step = 1;
    bool outward = narrow(search, distance, output_within(search, &front, distance));
    bool enclosed = false;
    while (search->far.distance - search->near.distance > 1) {
        const uint32_t room = search->far.distance - search->near.distance;
        if (enclosed || step >= room) {
            distance = search->near.distance + room / 2;
        } else {
            distance = outward ? search->near.distance + step : search->far.distance - step;
            step *= 2;
        }
        const bool short_of = narrow(search, distance, output_within(search, &front, distance));
        enclosed = enclosed || short_of != outward;
    }
}

/// The nearest input whose output reaches `wanted`, which lies between the outputs at the present input
/// (excluded) and at the end of the range in its direction.
static search_t find_reaching(const hyst_q_model_t* model, const hyst_q_state_t* state,
                              const hyst_q_value_t wanted, const hyst_q_value_t end_output)
{
    search_t search;
    search.model = model;
    search.state = state;
    search.wanted = wanted;
    search.rising = wanted > state->output;
    search.near.distance = 0;
    search.near.output = state->output;
    search.far.distance = distance_of(&search, search.rising ? model->input_max : model->input_min);
    search.far.output = end_output;
    search_cells(&search);
    search_kinks(&search);
    search_stretch(&search);
    return search;
}

HYST_Q(reach_t) HYST_Q(reachable)(const hyst_q_model_t* model, const hyst_q_state_t* state)
{
    HYST_Q(reach_t) reach;
    reach.reachable_min = look(model, state, 0, model->input_min, false);
    reach.reachable_max = look(model, state, model->num_knots - 2, model->input_max, true);
    return reach;
}

HYST_Q(inverse_t)
HYST_Q(inverse)(const hyst_q_model_t* model, const hyst_q_state_t* state, const hyst_q_value_t wanted)
{
    HYST_Q(inverse_t) result;
    result.input = state->input;
    result.clamped = false;
    if (wanted == state->output) {
        return result;
    }
    const bool rising = wanted > state->output;
    const hyst_q_value_t end_output = rising
                                          ? look(model, state, model->num_knots - 2, model->input_max, true)
                                          : look(model, state, 0, model->input_min, false);
    result.clamped = rising ? wanted > end_output : wanted < end_output;
    const hyst_q_value_t goal = result.clamped ? end_output : wanted;
    if (goal == state->output) {
        return result;
    }
    search_t search = find_reaching(model, state, goal, end_output);
    if (apart(goal, search.near.output) <= apart(search.far.output, goal)) {
        if (search.near.output == state->output) {
            return result;
        }
        search = find_reaching(model, state, search.near.output, end_output);
    }
    result.input = input_at(&search, search.far.distance);
    return result;
}
