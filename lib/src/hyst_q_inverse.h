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
    bool clamped; ///< the output asked for is out of reach: `wanted` is the last one within
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

static bool falls_short(const search_t* search, const hyst_q_value_t output)
{
    return search->rising ? output < search->wanted : output > search->wanted;
}

/// Takes the point as the stretch's near or far end; true: the near one.
static bool narrow(search_t* search, const uint32_t distance, const hyst_q_value_t output)
{
    const point_t point = {distance, output};
    const bool short_of = falls_short(search, output);
    if (short_of) {
        search->near = point;
    } else {
        search->far = point;
    }
    return short_of;
}

/// Whether the answer lies in the present cell, which is then the stretch.
static bool is_in_present_cell(search_t* search)
{
    const uint32_t cell = search->state->cell;
    const hyst_q_value_t v = search->model->knot[search->rising ? cell + 1 : cell].input;
    search->cell = cell;
    return !narrow(search, distance_of(search, v),
                   look(search->model, search->state, cell, v, search->rising));
}

/// Takes the rest of the range as the stretch; what is beyond its last output is clamped to that.
static void take_range(search_t* search)
{
    const hyst_q_model_t* model = search->model;
    const hyst_q_value_t end = search->rising ? model->input_max : model->input_min;
    search->far.distance = distance_of(search, end);
    search->far.output =
        look(model, search->state, search->rising ? model->num_knots - 2 : 0, end, search->rising);
    if (falls_short(search, search->far.output)) {
        search->clamped = true;
        search->wanted = search->far.output;
        search->near.distance = 0;
        search->near.output = search->state->output;
    }
}

/// Narrows the stretch to one cell of the table.
static void search_cells(search_t* search)
{
    const hyst_q_model_t* model = search->model;
    const uint32_t first = search->state->cell;
    uint32_t low = search->rising ? first : 0;
    uint32_t high = search->rising ? model->num_knots - 2 : first;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const hyst_q_value_t v = model->knot[middle + 1].input;
        const bool short_of =
            narrow(search, distance_of(search, v), look(model, search->state, middle, v, search->rising));
        if (short_of == search->rising) {
            low = middle + 1;
        } else {
            high = middle;
        }
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

/// Narrows the stretch until no play starts to move between its ends. Returns which plays move in there.
static hyst_q_front_t search_kinks(search_t* search)
{
    hyst_q_front_t front = front_at(search, search->near.distance);
    uint32_t high = front_at(search, search->far.distance).end;
    // The next kink first: a small correction does not reach it.
    uint32_t middle = front.end;
    while (front.end < high) {
        const uint32_t distance = kink(search, middle);
        const hyst_q_value_t v = input_at(search, distance);
        const hyst_q_value_t output = look(search->model, search->state, search->cell, v, search->rising);
        if (narrow(search, distance, output)) {
            front = front_at(search, distance);
        } else {
            high = middle;
        }
        middle = front.end + (high - front.end) / 2;
    }
    return front;
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
    const hyst_q_sum_t rise = apart(search->far.output, search->near.output);
    const hyst_q_sum_t part = apart(search->wanted, search->near.output);
    const uint32_t ahead = (uint32_t)(part * width / rise);
    return search->near.distance + (ahead == 0 ? 1U : ahead == width ? width - 1 : ahead);
}

/// Finds the answer in a stretch without kinks. Rounding takes the outputs off a straight line by a few
/// units: from where that line says, steps that double enclose the answer, and halvings find it.
static void search_stretch(search_t* search, const hyst_q_front_t* front)
{
    if (search->far.distance - search->near.distance < 2) {
        return;
    }
    uint32_t distance = straight(search);
    uint32_t step = 1;
    bool outward = narrow(search, distance, output_within(search, front, distance));
    bool enclosed = false;
    while (search->far.distance - search->near.distance > 1) {
        const uint32_t room = search->far.distance - search->near.distance;
        if (enclosed || step >= room) {
            distance = search->near.distance + room / 2;
        } else {
            distance = outward ? search->near.distance + step : search->far.distance - step;
            step *= 2;
        }
        const bool short_of = narrow(search, distance, output_within(search, front, distance));
        enclosed = enclosed || short_of != outward;
    }
}

/// Finds the nearest input whose output reaches `wanted`, as the far end of a stretch of one unit; or, where
/// nothing within reach is nearer to it than the present output, the present input.
static void find_reaching(search_t* search)
{
    search->near.distance = 0;
    search->near.output = search->state->output;
    if (!is_in_present_cell(search)) {
        take_range(search);
        if (search->wanted == search->state->output) {
            search->far = search->near;
            return;
        }
        search_cells(search);
    }
    const hyst_q_front_t front = search_kinks(search);
    search_stretch(search, &front);
}

/// Whether the next input nearer than `near` gives another output.
static bool is_first_of_its_output(const search_t* search)
{
    const hyst_q_value_t v = input_at(search, search->near.distance - 1);
    const uint32_t cell = HYST_Q(find_cell)(search->model, search->cell, v);
    return look(search->model, search->state, cell, v, search->rising) != search->near.output;
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
    search_t search;
    HYST_Q(inverse_t) result;
    result.input = state->input;
    result.clamped = false;
    if (wanted == state->output) {
        return result;
    }
    search.model = model;
    search.state = state;
    search.wanted = wanted;
    search.rising = wanted > state->output;
    search.clamped = false;
    find_reaching(&search);
    result.clamped = search.clamped;
    if (apart(search.wanted, search.near.output) <= apart(search.far.output, search.wanted)) {
        if (search.near.output == state->output) {
            return result;
        }
        if (is_first_of_its_output(&search)) {
            search.far = search.near;
        } else {
            search.wanted = search.near.output;
            find_reaching(&search);
        }
    }
    result.input = input_at(&search, search.far.distance);
    return result;
}
