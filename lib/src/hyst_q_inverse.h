#include "hyst_q_solve.h"

/// A search away from the present input for the nearest one whose output reaches `wanted`. Outputs do not
/// decrease with the input, so the answer lies at a boundary: between an input whose D + sum / 2^HYST_Q_BITS
/// is below `goal` and the next one, whose is not.
typedef struct {
    const hyst_q_model_t* model;
    const hyst_q_state_t* state;
    hyst_q_value_t wanted;
    bool rising;
    bool clamped; ///< the output asked for is out of reach: `wanted` is the last one within
} search_t;

/// The levels over which a push moves the plays before `end` and leaves `num_kept` segments at the stack's
/// bottom: from `start` to `limit`, away from the present. sum p_j w_j is rest + weight * level.
typedef struct {
    hyst_q_sum_t rest;
    uint32_t weight;
    uint32_t num_kept;
    uint32_t end;
    uint32_t start;
    uint32_t limit;
} piece_t;

/// Where a piece begins, and the plays' sum there.
typedef struct {
    uint32_t level;
    hyst_q_sum_t sum;
} kink_t;

/// What is known of the answer: its cell lies between two knots, the near one of which falls short, and not
/// the far one.
typedef struct {
    uint32_t near, far; ///< indices of knots
    uint32_t near_level, far_level;
} cells_t;

/// The boundary in one cell.
typedef struct {
    uint32_t cell;
    hyst_q_boundary_t at;
} found_t;

static inline bool is_beyond(const search_t* search, const uint32_t level, const uint32_t other)
{
    return search->rising ? level > other : level < other;
}

static inline bool falls_short(const search_t* search, const hyst_q_value_t output)
{
    return search->rising ? output < search->wanted : output > search->wanted;
}

static inline bool is_short(const search_t* search, const uint32_t nonhysteretic, const hyst_q_sum_t sum)
{
    return falls_short(search, hyst_q_total(search->model, nonhysteretic, sum));
}

static inline uint32_t level_at_knot(const search_t* search, const uint32_t k)
{
    const hyst_q_knot_t* knot = &search->model->knot[k];
    return search->rising ? knot->ascending : knot->descending;
}

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

/// The level beyond which play `end` moves, too.
static inline uint32_t limit_of(const search_t* search, const uint32_t num_kept, const uint32_t end)
{
    if (num_kept == 0) {
        return search->rising ? UINT32_MAX : 0;
    }
    const hyst_q_segment_t* segment = &search->state->segment[num_kept - 1];
    const uint32_t across = 2U * search->model->radius[end];
    if (search->rising) {
        return segment->falling ? segment->level + across : segment->level;
    }
    // Below 0 for a play that cannot be moved.
    return segment->falling ? segment->level : segment->level > across ? segment->level - across : 0;
}

/// The first piece: with it also the levels before its start, which move nothing.
static inline piece_t present_piece(const search_t* search)
{
    const hyst_q_state_t* state = search->state;
    const hyst_q_segment_t* top = &state->segment[state->num_segments - 1];
    piece_t piece;
    if ((top->falling == 0) == search->rising) {
        piece.rest = top->rest;
        piece.end = top->end;
        piece.num_kept = state->num_segments - 1;
        piece.start = top->level;
    } else {
        piece.rest = state->sum;
        piece.end = 0;
        piece.num_kept = state->num_segments;
        piece.start = search->rising ? 0 : UINT32_MAX;
    }
    piece.weight = search->model->cumulative_weight[piece.end];
    piece.limit = limit_of(search, piece.num_kept, piece.end);
    return piece;
}

/// Takes the next plays into the piece: those of a segment pushed in the direction of the search all at once,
/// others one by one.
static inline void take_next(const search_t* search, piece_t* piece)
{
    const hyst_q_segment_t* next = &search->state->segment[piece->num_kept - 1];
    const uint32_t end = (next->falling == 0) == search->rising ? next->end : piece->end + 1;
    const uint32_t weight = search->model->cumulative_weight[end];
    piece->rest -= hyst_q_product(weight - piece->weight, piece->limit);
    piece->weight = weight;
    piece->end = end;
    piece->num_kept -= end == next->end ? 1U : 0U;
    piece->start = piece->limit;
    piece->limit = limit_of(search, piece->num_kept, end);
}

static inline hyst_q_sum_t sum_at(const search_t* search, const piece_t* piece, const uint32_t level)
{
    const uint32_t reached = is_beyond(search, piece->start, level) ? piece->start : level;
    return piece->rest + hyst_q_product(piece->weight, reached);
}

/// The lower knot of the cell that begins at knot `near` in the direction of the search.
static inline uint32_t cell_from(const search_t* search, const uint32_t near)
{
    return search->rising ? near : near - 1;
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

/// The first of the segment's plays.
static inline uint32_t first_play(const search_t* search, const uint32_t segment)
{
    const hyst_q_state_t* state = search->state;
    return segment + 1 < state->num_segments ? state->segment[segment + 1].end : 0;
}

/// The segment that play j is in.
static uint32_t segment_of(const search_t* search, const uint32_t num_kept, const uint32_t j)
{
    return num_kept > 0 && j >= first_play(search, num_kept - 1) ? num_kept - 1 : num_kept;
}

static piece_t piece_of(const search_t* search, const uint32_t num_kept, const uint32_t end)
{
    const hyst_q_model_t* model = search->model;
    const hyst_q_front_t front = HYST_Q(front_at)(model, search->state, num_kept, end);
    piece_t piece;
    piece.rest = search->rising ? front.below - model->cumulative_moment[end]
                                : front.below + model->cumulative_moment[end];
    piece.weight = model->cumulative_weight[end];
    piece.num_kept = num_kept;
    piece.end = end;
    piece.start = search->rising ? 0 : UINT32_MAX;
    if (end > 0) {
        piece.start = limit_of(search, segment_of(search, num_kept, end - 1) + 1, end - 1);
    }
    piece.limit = limit_of(search, num_kept, end);
    return piece;
}

/// The piece before, for one that has plays.
static piece_t piece_before(const search_t* search, const piece_t* piece)
{
    const uint32_t index = segment_of(search, piece->num_kept, piece->end - 1);
    const hyst_q_segment_t* segment = &search->state->segment[index];
    const bool is_along = (segment->falling == 0) == search->rising;
    return piece_of(search, index + 1, is_along ? first_play(search, index) : piece->end - 1);
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

/// How many pieces and cells are followed, and the part of all outputs (2^-NEAR_BITS) that is near enough.
enum { MOST_PIECES = 5, NEAR_BITS = 6 };

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

/// Where the segment is taken as a whole.
static kink_t end_of_segment(const search_t* search, const uint32_t index)
{
    const hyst_q_segment_t* segment = &search->state->segment[index];
    const hyst_q_sum_t moment = search->model->cumulative_moment[segment->end];
    const uint32_t level = limit_of(search, index + 1, segment->end - 1U);
    kink_t kink = {level, hyst_q_front_sum(search->model, segment, level)};
    if (search->rising && segment->falling) {
        kink.sum -= 2 * moment;
    } else if (!search->rising && !segment->falling) {
        kink.sum += 2 * moment;
    }
    return kink;
}

/// Where play j begins to move, of a segment pushed against the direction of the search.
static kink_t start_of_play(const search_t* search, const hyst_q_segment_t* segment, const uint32_t j)
{
    const hyst_q_model_t* model = search->model;
    const uint32_t radius = model->radius[j];
    const hyst_q_sum_t before = hyst_q_front_sum(model, segment, segment->level);
    const hyst_q_sum_t moved =
        2 * (hyst_q_product(model->cumulative_weight[j], radius) - model->cumulative_moment[j]);
    const kink_t up = {segment->level + 2U * radius, before + moved};
    const kink_t down = {segment->level - 2U * radius, before - moved};
    return search->rising ? up : down;
}

/// About what D is where the envelope reaches the level, within one cell.
static uint32_t nonhysteretic_near(const search_t* search, const uint32_t cell, const uint32_t level)
{
    const hyst_q_knot_t* knot = &search->model->knot[cell];
    const uint32_t value = search->rising ? knot->ascending : knot->descending;
    const uint32_t slope = search->rising ? knot->ascending_slope : knot->descending_slope;
    const uint32_t offset =
        hyst_q_quotient((hyst_q_sum_t)(level - value) << HYST_Q_BITS, slope, hyst_q_leading_zeros(slope));
    return hyst_q_nonhysteretic(knot, offset < HYST_Q_WORD_MAX ? offset : HYST_Q_WORD_MAX);
}

static bool is_one(const cells_t* cells)
{
    return cells->near + 1 == cells->far || cells->far + 1 == cells->near;
}

/// Whether the output at the kink falls short, found by narrowing the cells until they tell: where the middle
/// knot lies on this side of the kink, D there and the plays' sum at the kink are together no more than the
/// output at the kink and no less than that at the knot; beyond it, the other way round. In one cell D at the
/// kink is estimated.
static bool is_kink_short(const search_t* search, cells_t* cells, const kink_t* kink)
{
    for (;;) {
        if (!is_beyond(search, kink->level, cells->near_level)) {
            return true;
        }
        if (!is_beyond(search, cells->far_level, kink->level)) {
            return false;
        }
        if (is_one(cells)) {
            const uint32_t cell = cell_from(search, cells->near);
            return is_short(search, nonhysteretic_near(search, cell, kink->level), kink->sum);
        }
        const uint32_t middle = (cells->near + cells->far) / 2;
        const uint32_t level = level_at_knot(search, middle);
        const bool short_of = is_short(search, search->model->knot[middle].nonhysteretic, kink->sum);
        if (is_beyond(search, level, kink->level)) {
            if (short_of) {
                return true;
            }
            cells->far = middle;
            cells->far_level = level;
        } else {
            if (!short_of) {
                return false;
            }
            cells->near = middle;
            cells->near_level = level;
        }
    }
}

/// The piece that holds the boundary or, where an estimate decided, one beside it. Narrows the cells too.
static piece_t search_pieces(const search_t* search, cells_t* cells, const piece_t* near,
                             const hyst_q_front_t* far)
{
    uint32_t low = far->num_kept;
    uint32_t high = near->num_kept;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const kink_t kink = end_of_segment(search, middle);
        if (is_kink_short(search, cells, &kink)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    if (low == 0) {
        return piece_of(search, 0, search->model->num_plays);
    }
    const hyst_q_segment_t* segment = &search->state->segment[low - 1];
    uint32_t end = low == near->num_kept ? near->end : first_play(search, low - 1);
    uint32_t last = low == far->num_kept                        ? far->end
                    : (segment->falling == 0) == search->rising ? end
                                                                : segment->end - 1U;
    while (end < last) {
        const uint32_t middle = end + (last - end) / 2;
        const kink_t kink = start_of_play(search, segment, middle);
        if (is_kink_short(search, cells, &kink)) {
            end = middle + 1;
        } else {
            last = middle;
        }
    }
    return piece_of(search, low, end);
}

/// Narrows the cells to one, of a piece that holds the boundary.
static void search_cells(const search_t* search, cells_t* cells, const piece_t* piece)
{
    while (!is_one(cells)) {
        const uint32_t middle = (cells->near + cells->far) / 2;
        const uint32_t level = level_at_knot(search, middle);
        const hyst_q_sum_t sum = sum_at(search, piece, level);
        if (is_short(search, search->model->knot[middle].nonhysteretic, sum)) {
            cells->near = middle;
        } else {
            cells->far = middle;
        }
    }
}

/// The knot behind the present input.
static inline uint32_t knot_behind(const search_t* search)
{
    return search->rising ? search->state->cell : search->state->cell + 1;
}

/// Searches all of the range for the cell that holds the boundary, and its piece. Returns the cell's near
/// knot. What lies out of reach is clamped to the last output within.
static uint32_t search_far(search_t* search, piece_t* piece)
{
    const hyst_q_model_t* model = search->model;
    const uint32_t end = search->rising ? model->num_knots - 1 : 0;
    const uint32_t level = level_at_knot(search, end);
    const hyst_q_front_t front = HYST_Q(find_front)(model, search->state, level, search->rising);
    const hyst_q_sum_t sum = front.below + hyst_q_front_part(model, front.end, level, !search->rising);
    const uint32_t nonhysteretic = model->knot[end].nonhysteretic;
    if (is_short(search, nonhysteretic, sum)) {
        search->clamped = true;
        search->wanted = hyst_q_total(model, nonhysteretic, sum);
    }
    const uint32_t near = knot_behind(search);
    cells_t cells = {near, end, level_at_knot(search, near), level};
    *piece = present_piece(search);
    *piece = search_pieces(search, &cells, piece, &front);
    search_cells(search, &cells, piece);
    return cells.near;
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

/// Finds the answer for a wanted output other than the present one. Two rounds at most: the second one looks
/// for an output that there is.
static inline hyst_q_value_t answer(search_t* search)
{
    hyst_q_value_t input;
    found_t found;
    piece_t piece = present_piece(search);
    uint32_t near = knot_behind(search);
    bool is_far = apart(search->wanted, search->state->output) >> (HYST_Q_BITS - NEAR_BITS) != 0;
    for (;;) {
        if (is_far) {
            near = search_far(search, &piece);
            if (search->wanted == search->state->output) {
                return search->state->input;
            }
        }
        if (!follow(search, near, &piece, &found)) {
            if (!is_far) {
                is_far = true;
                continue;
            }
            narrow_cell(search, &piece, near, &found);
        }
        if (is_exact(search, &found)) {
            return input_at(search, found.cell, reaching_end(search, &found));
        }
        if (answer_nearest(search, &piece, &found, &input)) {
            return input;
        }
        near = search->rising ? found.cell : found.cell + 1;
        is_far = false;
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
