#include "hyst_q_far.h"

/// The boundary in one cell.
typedef struct {
    uint32_t cell;
    hyst_q_boundary_t at;
} found_t;

/// How many pieces and cells are followed, and the part of all outputs (2^-NEAR_BITS) that is near enough.
enum { MOST_PIECES = 6, NEAR_BITS = 7 };

/// The output that v, in `cell`, would give.
static hyst_q_value_t look(const hyst_q_model_t* model, const hyst_q_state_t* state, const uint32_t cell,
                           const hyst_q_value_t v, const bool rising)
{
    const uint32_t level = hyst_q_envelope(model, cell, v, rising);
    const hyst_q_front_t front = HYST_Q(find_front)(model, state, level, rising);
    return hyst_q_output(model, cell, v, front.below + hyst_q_front_part(model, front.end, level, !rising));
}

static uint32_t apart(const hyst_q_value_t a, const hyst_q_value_t b)
{
    return a < b ? (uint32_t)b - (uint32_t)a : (uint32_t)a - (uint32_t)b;
}

/// The least output that does not fall short of a rising search, or does of a falling one.
static inline uint32_t goal_of(const search_t* search)
{
    return (uint32_t)search->wanted + (search->rising ? 0U : 1U);
}

/// The cell as a line, as if the piece's plays, and no others, moved over the whole of it.
static inline hyst_q_line_t line_of(const search_t* search, const uint32_t cell, const piece_t* piece)
{
    const hyst_q_knot_t* knot = &search->model->knot[cell];
    const uint32_t level = search->rising ? knot->ascending : knot->descending;
    const uint32_t above = (uint32_t)search->model->constant + knot->nonhysteretic - goal_of(search);
    hyst_q_line_t line;
    line.at_knot = piece->rest + hyst_q_product(piece->weight, level) + HYST_Q_HALF +
                   ((hyst_q_sum_t)above << HYST_Q_BITS);
    line.weight = piece->weight;
    line.level_slope = search->rising ? knot->ascending_slope : knot->descending_slope;
    line.nonhysteretic_slope = knot->nonhysteretic_slope;
    line.shift = knot->shift;
    line.width = (uint32_t)knot[1].input - (uint32_t)knot->input;
    return line;
}

/// The envelope's level at the distance x from the cell's lower knot.
static inline uint32_t level_at(const search_t* search, const uint32_t cell, const uint32_t x)
{
    const hyst_q_knot_t* knot = &search->model->knot[cell];
    return hyst_q_level(knot, x << knot->shift, search->rising);
}

/// Of the two inputs at the boundary the one that falls short, and the one that does not.
static inline uint32_t short_end(const search_t* search, const found_t* found)
{
    return search->rising ? found->at.low : found->at.high;
}

static inline uint32_t reaching_end(const search_t* search, const found_t* found)
{
    return search->rising ? found->at.high : found->at.low;
}

/// Whether the output at the distance x is what the line says: neither curve is limited by its next value.
static inline bool is_on_line(const hyst_q_knot_t* knot, const bool rising, const uint32_t x)
{
    const uint32_t offset = x << knot->shift;
    const uint32_t level = rising ? knot->ascending + hyst_q_scaled(knot->ascending_slope, offset)
                                  : knot->descending + hyst_q_scaled(knot->descending_slope, offset);
    return level <= (rising ? knot[1].ascending : knot[1].descending) &&
           knot->nonhysteretic + hyst_q_scaled(knot->nonhysteretic_slope, offset) <= knot[1].nonhysteretic;
}

static hyst_q_value_t input_at(const search_t* search, const uint32_t cell, const uint32_t x)
{
    return (hyst_q_value_t)((int64_t)search->model->knot[cell].input + (int64_t)x);
}

/// The output at the distance x from the cell's lower knot.
static hyst_q_value_t output_at(const search_t* search, const piece_t* piece, const uint32_t cell,
                                const uint32_t x)
{
    const hyst_q_knot_t* knot = &search->model->knot[cell];
    const uint32_t level = level_at(search, cell, x);
    if (is_beyond(search, level, piece->limit) || is_beyond(search, piece->start, level)) {
        return look(search->model, search->state, cell, input_at(search, cell, x), search->rising);
    }
    return hyst_q_total(search->model, hyst_q_nonhysteretic(knot, x << knot->shift),
                        piece->rest + hyst_q_product(piece->weight, level));
}

/// Finds the boundary in the cell by looking at one output after the other: from the distance `high` on by
/// steps that double until it is enclosed, and then by halving. False where it is not in the cell.
static bool narrow(const search_t* search, const piece_t* piece, found_t* found)
{
    const hyst_q_knot_t* knot = &search->model->knot[found->cell];
    const uint32_t width = (uint32_t)knot[1].input - (uint32_t)knot->input;
    hyst_q_boundary_t* at = &found->at;
    uint32_t x = at->high;
    uint32_t step = 1;
    bool has_low = false;
    bool has_high = false;
    while (!has_low || !has_high || at->high - at->low > 1) {
        const hyst_q_value_t output = output_at(search, piece, found->cell, x);
        const uint32_t excess = ((uint32_t)output - goal_of(search)) & HYST_Q_WORD_MAX;
        const bool is_low = falls_short(search, output) == search->rising;
        if (is_low) {
            at->low = x;
            at->low_excess = excess;
            has_low = true;
        } else {
            at->high = x;
            at->high_excess = excess;
            has_high = true;
        }
        if (has_low && has_high) {
            x = at->low + (at->high - at->low) / 2;
        } else if (x == (is_low ? width : 0)) {
            return false;
        } else {
            const uint32_t room = is_low ? width - x : x;
            x = is_low ? x + (step < room ? step : room) : x - (step < room ? step : room);
            step |= step << 1;
        }
    }
    return true;
}

/// The same in the cell beyond the knot, which holds the boundary.
static void narrow_cell(const search_t* search, const piece_t* piece, const uint32_t near, found_t* found)
{
    const hyst_q_boundary_t start = {0, 0, 0, 0};
    found->cell = cell_from(search, near);
    found->at = start;
    (void)narrow(search, piece, found);
}

/// Goes on to the next cell, or to another piece where this one does not reach so far. False at the end of
/// the range.
static bool go_on(const search_t* search, uint32_t* near, piece_t* piece)
{
    const uint32_t far = search->rising ? *near + 1 : *near - 1;
    const uint32_t level = level_at_knot(search, far);
    if (is_beyond(search, level, piece->limit)) {
        take_next(search, piece);
    } else if (is_beyond(search, piece->start, level)) {
        *piece = piece_before(search, piece);
    } else {
        *near = far;
        return far != (search->rising ? search->model->num_knots - 1 : 0);
    }
    return true;
}

/// Follows the output piece by piece and cell by cell from the knot `near` on. Where it finds a boundary,
/// both its ends lie in the piece and the cell in whose line it was found: this proves it, however it was
/// come upon.
static inline bool follow(const search_t* search, uint32_t near, piece_t* piece, found_t* found)
{
    for (uint32_t i = 0; i < MOST_PIECES; ++i) {
        const uint32_t cell = cell_from(search, near);
        const hyst_q_line_t line = line_of(search, cell, piece);
        found->cell = cell;
        if (hyst_q_is_negative(line.at_knot) && hyst_q_solve(&line, &found->at)) {
            if (is_beyond(search, level_at(search, cell, reaching_end(search, found)), piece->limit)) {
                take_next(search, piece);
                continue;
            }
            if (is_beyond(search, piece->start, level_at(search, cell, short_end(search, found)))) {
                *piece = piece_before(search, piece);
                continue;
            }
            if (is_on_line(&search->model->knot[cell], search->rising, found->at.high) ||
                narrow(search, piece, found)) {
                return true;
            }
        }
        if (!go_on(search, &near, piece)) {
            return false;
        }
    }
    return false;
}

/// The output that is so much above the goal, modulo the word.
static hyst_q_value_t output_of(const search_t* search, const uint32_t excess)
{
    const int64_t above =
        excess <= HYST_Q_WORD_MAX / 2 ? (int64_t)excess : (int64_t)excess - (int64_t)HYST_Q_WORD_MAX - 1;
    return (hyst_q_value_t)((int64_t)search->wanted + (search->rising ? 0 : 1) + above);
}

/// Whether the next input nearer than the boundary's short end gives another output than that.
static bool is_first(const search_t* search, const piece_t* piece, const found_t* found,
                     const hyst_q_value_t output)
{
    const uint32_t x = short_end(search, found);
    const hyst_q_knot_t* knot = &search->model->knot[found->cell];
    if (x != (search->rising ? 0 : (uint32_t)knot[1].input - (uint32_t)knot->input)) {
        return output_at(search, piece, found->cell, search->rising ? x - 1 : x + 1) != output;
    }
    const hyst_q_value_t v = input_at(search, found->cell, x);
    const uint32_t cell = search->rising ? found->cell - 1 : found->cell + 1;
    const hyst_q_value_t beside = (hyst_q_value_t)(search->rising ? v - 1 : v + 1);
    return look(search->model, search->state, cell, beside, search->rising) != output;
}

/// Answers with the nearer of the two outputs at the boundary, at its first input. False where that has to be
/// searched for: it is now the wanted output.
static bool answer_nearest(search_t* search, const piece_t* piece, const found_t* found,
                           hyst_q_value_t* input)
{
    const hyst_q_value_t above = output_of(search, found->at.high_excess);
    const hyst_q_value_t below = output_of(search, found->at.low_excess);
    const hyst_q_value_t reached = search->rising ? above : below;
    const hyst_q_value_t before = search->rising ? below : above;
    if (apart(search->wanted, before) > apart(reached, search->wanted)) {
        *input = input_at(search, found->cell, reaching_end(search, found));
    } else if (before == search->state->output) {
        *input = search->state->input;
    } else if (is_first(search, piece, found, before)) {
        *input = input_at(search, found->cell, short_end(search, found));
    } else {
        search->wanted = before;
        return false;
    }
    return true;
}

HYST_Q(reach_t) HYST_Q(reachable)(const hyst_q_model_t* model, const hyst_q_state_t* state)
{
    HYST_Q(reach_t) reach;
    const hyst_q_value_t low = model->input_min;
    const hyst_q_value_t high = model->input_max;
    reach.reachable_min = low == state->input ? state->output : look(model, state, 0, low, false);
    reach.reachable_max =
        high == state->input ? state->output : look(model, state, model->num_knots - 2, high, true);
    return reach;
}

/// Whether the boundary's reaching end gives the wanted output.
static inline bool is_exact(const search_t* search, const found_t* found)
{
    return search->rising ? found->at.high_excess == 0 : found->at.low_excess == HYST_Q_WORD_MAX;
}

/// Where the boundary is looked for: first by following, then all over the range. Where the nearest output is
/// given by more than one input, the last two look for the first of them.
typedef enum { NEAR, FAR, FIRST_NEAR, FIRST_FAR } phase_t;

/// Finds the answer for a wanted output other than the present one.
static inline hyst_q_value_t answer(search_t* search)
{
    hyst_q_value_t input;
    found_t found;
    piece_t piece = present_piece(search);
    uint32_t near = knot_behind(search);
    const uint32_t way = apart(search->wanted, search->state->output);
    phase_t phase = way >> (HYST_Q_BITS - NEAR_BITS) == 0 ? NEAR : FAR;
    for (;;) {
        if (phase == FAR || phase == FIRST_FAR) {
            near = search_far(search, &piece);
            if (search->wanted == search->state->output) {
                return search->state->input;
            }
        }
        if (!follow(search, near, &piece, &found)) {
            if (phase == NEAR || phase == FIRST_NEAR) {
                phase = phase == NEAR ? FAR : FIRST_FAR;
                continue;
            }
            narrow_cell(search, &piece, near, &found);
        }
        if (is_exact(search, &found) || phase >= FIRST_NEAR) {
            return input_at(search, found.cell, reaching_end(search, &found));
        }
        if (answer_nearest(search, &piece, &found, &input)) {
            return input;
        }
        near = search->rising ? found.cell : found.cell + 1;
        phase = FIRST_NEAR;
    }
}

HYST_Q(inverse_t)
HYST_Q(inverse)(const hyst_q_model_t* model, const hyst_q_state_t* state, const hyst_q_value_t wanted)
{
    HYST_Q(inverse_t) result;
    search_t search;
    search.model = model;
    search.state = state;
    search.wanted = wanted;
    search.rising = wanted > state->output;
    search.clamped = false;
    result.input = wanted == state->output ? state->input : answer(&search);
    result.clamped = search.clamped;
    return result;
}
