#include "hyst_f32_segments.h"

/// An input within reach of one monotone move and the output it would give, both in the direction of the
/// move.
typedef struct {
    float input;
    float output;
    float ahead; ///< the envelope there
    float plays; ///< the plays' part of the output
} point_t;

/// The stretch in which the wanted output is looked for. Invariant: `near` falls short of it, `far` does not.
/// Inputs, outputs and envelopes are in the direction of the move, so that all increase.
typedef struct {
    const hyst_f32_model_t* model;
    const hyst_f32_state_t* state;
    bool rising;
    float sign;
    float wanted;
    point_t near; ///< the end on the side of the present input
    point_t far;
} search_t;

/// The curves of a cell as lines through one point.
typedef struct {
    float input, width, envelope, envelope_slope, offset, offset_slope;
} lines_t;

static inline lines_t lines_of(const search_t* search, const uint32_t cell)
{
    const hyst_f32_model_t* model = search->model;
    const float sign = search->sign;
    if (model->num_knots == 0) {
        const lines_t identity = {
            0.0f, FLT_MAX, 0.0f, 1.0f, sign * model->constant, model->nonhysteretic_slope};
        return identity;
    }
    const hyst_f32_knot_t* knot = &model->knot[cell];
    const lines_t lines = {sign * knot->input,
                           knot[1].input - knot->input,
                           sign * (search->rising ? knot->ascending : knot->descending),
                           search->rising ? knot->ascending_slope : knot->descending_slope,
                           sign * (model->constant + knot->nonhysteretic),
                           knot->nonhysteretic_slope};
    return lines;
}

/// The very arithmetic of a step to `input`, which lies in `cell`, without storing.
static point_t look(const search_t* search, const uint32_t cell, const float input)
{
    const hyst_f32_model_t* model = search->model;
    const float ahead = search->sign * hyst_f32_envelope(model, cell, input, search->rising);
    hyst_f32_front_t front;
    float plays = search->sign * search->state->plays;
    if (hyst_f32_meet(model, search->state, search->rising, ahead, &front)) {
        plays = hyst_f32_larger(front.sum, plays);
    }
    const point_t point = {search->sign * input, search->sign * hyst_f32_offset(model, cell, input) + plays,
                           ahead, plays};
    return point;
}

/// Narrows the stretch to one side of the point; true when it falls short.
static bool narrow(search_t* search, const point_t point)
{
    if (point.output < search->wanted) {
        search->near = point;
        return true;
    }
    search->far = point;
    return false;
}

/// The m-th knot ahead of the present input.
static uint32_t knot_ahead(const search_t* search, const uint32_t m)
{
    const uint32_t present = search->state->cell;
    return search->rising ? present + m : present + 1 - m;
}

static point_t look_at_knot(const search_t* search, const uint32_t m)
{
    const uint32_t knot = knot_ahead(search, m);
    const uint32_t last_cell = hyst_f32_last_cell(search->model);
    return look(search, knot < last_cell ? knot : last_cell, search->model->knot[knot].input);
}

/// Which knot ahead, of low ... high, would be the first not to fall short if the plays' sum were linear in
/// the envelope between the stretch's ends.
static uint32_t guess_knot(const search_t* search, uint32_t low, uint32_t high)
{
    const hyst_f32_model_t* model = search->model;
    const point_t* near = &search->near;
    const float width = search->far.ahead - near->ahead;
    const float slope = width > 0.0f ? (search->far.plays - near->plays) / width : 0.0f;
    const float wanted =
        search->wanted - (near->plays - slope * near->ahead) - search->sign * model->constant;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const hyst_f32_knot_t* knot = &model->knot[knot_ahead(search, middle)];
        const float envelope = search->rising ? knot->ascending : knot->descending;
        if (search->sign * (knot->nonhysteretic + slope * envelope) < wanted) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

enum { MOST_GUESSES = 3 };

/// Narrows the stretch, whose ends are the low-th and high-th knot ahead, to one cell: by guesses, and where
/// those do not halve it in time, by halving. Returns `low`.
static uint32_t search_cells(search_t* search, uint32_t low, uint32_t high)
{
    uint32_t num_guesses = 0;
    uint32_t goal = (high - low) / 2;
    while (high - low > 1) {
        const uint32_t middle =
            num_guesses < MOST_GUESSES ? guess_knot(search, low + 1, high - 1) : low + (high - low) / 2;
        if (narrow(search, look_at_knot(search, middle))) {
            low = middle;
        } else {
            high = middle;
        }
        ++num_guesses;
        if (high - low <= goal) {
            num_guesses = 0;
            goal = (high - low) / 2;
        }
    }
    return low;
}

/// Narrows the stretch by the point in the cell where the envelope is at `ahead` and the plays' part is
/// `sum`; true when it falls short.
static bool probe_kink(search_t* search, const lines_t* lines, const float ahead, const float sum)
{
    const float along = (ahead - lines->envelope) / lines->envelope_slope;
    const point_t point = {lines->input + along, lines->offset + lines->offset_slope * along + sum, ahead,
                           sum};
    // Outside the stretch it is known. A flat envelope gives no number where all of the cell is on one side.
    if (!(point.input > search->near.input)) {
        return true;
    }
    return point.input < search->far.input && narrow(search, point);
}

/// How many segments are kept: the first one out whose end is not short of the wanted output. `end` is the
/// front's.
static uint32_t search_segments(search_t* search, const lines_t* lines, const float end)
{
    const hyst_f32_segment_t* memory = search->state->memory;
    const uint32_t front = search->state->front;
    uint32_t low = 0;
    uint32_t high = front + 1;
    uint32_t middle = high;
    while (low < high) {
        const hyst_f32_segment_t* segment = &memory[middle - 1];
        const float ahead = hyst_f32_is_along(segment, search->rising)
                                ? segment->level
                                : search->model->play[segment->last].opening - segment->level;
        if (probe_kink(search, lines, ahead, middle == front + 1 ? end : segment->sum[search->rising])) {
            high = middle - 1;
        } else {
            low = middle;
        }
        middle = high - (high - low) / 2;
    }
    return low;
}

/// Narrows the stretch over a segment left in the other direction to one between two openings, low ... its
/// last.
static void search_openings(search_t* search, const lines_t* lines, const hyst_f32_segment_t* kept,
                            const float end, uint32_t low)
{
    const hyst_f32_play_t* play = search->model->play;
    uint32_t high = kept->last;
    uint32_t middle = low;
    while (low < high) {
        const float sum = end - (play[kept->last].loading - play[middle].loading);
        if (probe_kink(search, lines, play[middle].opening - kept->level, sum)) {
            low = middle + 1;
        } else {
            high = middle;
        }
        middle = low + (high - low) / 2;
    }
}

/// Narrows the stretch in its cell until the output is linear there.
static void search_kinks(search_t* search, const uint32_t cell)
{
    const uint32_t front = search->state->front;
    const hyst_f32_segment_t* memory = search->state->memory;
    const lines_t lines = lines_of(search, cell);
    float end = memory[front].sum[search->rising];
    if (!hyst_f32_is_along(&memory[front], search->rising)) {
        end = hyst_f32_end_of(search->model, memory, front, search->rising);
    }
    const uint32_t num_kept = search_segments(search, &lines, end);
    if (num_kept == 0 || hyst_f32_is_along(&memory[num_kept - 1], search->rising)) {
        return;
    }
    const bool is_front = num_kept == front + 1;
    search_openings(search, &lines, &memory[num_kept - 1],
                    is_front ? end : memory[num_kept - 1].sum[search->rising],
                    is_front ? 0 : memory[num_kept].last + 1u);
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
    return hyst_f32_limit(after < before ? near.input + after * width : far.input - before * width,
                          near.input, far.input);
}

/// A piece of the move in which the same plays move along.
typedef struct {
    uint32_t kept;       ///< segments that are not taken, at least one where no play moves
    uint32_t num_moving; ///< plays 0 ... num_moving - 1 move
    float slope;         ///< of the plays' sum over the envelope
    float limit;         ///< the envelope at which the piece ends
} piece_t;

static inline piece_t piece_of(const search_t* search, const uint32_t kept, const uint32_t num_moving)
{
    const hyst_f32_play_t* play = search->model->play;
    piece_t piece = {kept, num_moving, num_moving == 0 ? 0.0f : play[num_moving - 1].slope, FLT_MAX};
    if (kept != 0) {
        const hyst_f32_segment_t* segment = &search->state->memory[kept - 1];
        piece.limit = hyst_f32_is_along(segment, search->rising) ? segment->level
                                                                 : play[num_moving].opening - segment->level;
    }
    return piece;
}

/// The piece of the present point, where the envelope is at `ahead`.
static inline piece_t present_piece(const search_t* search, const float ahead)
{
    const uint32_t front = search->state->front;
    const hyst_f32_segment_t* top = &search->state->memory[front];
    const bool moves = hyst_f32_is_along(top, search->rising) && ahead >= top->level;
    return moves ? piece_of(search, front, top->last + 1u) : piece_of(search, front + 1, 0);
}

static inline piece_t next_piece(const search_t* search, const piece_t* piece)
{
    const hyst_f32_segment_t* kept = &search->state->memory[piece->kept - 1];
    const bool is_taken = hyst_f32_is_along(kept, search->rising) || piece->num_moving >= kept->last;
    return is_taken ? piece_of(search, piece->kept - 1, kept->last + 1u)
                    : piece_of(search, piece->kept, piece->num_moving + 1);
}

enum { MOST_PIECES = 6 };

/// Where a cell ends in the direction of the move.
static float end_of_cell(const search_t* search, const uint32_t cell)
{
    const hyst_f32_model_t* model = search->model;
    if (model->num_knots == 0) {
        return search->sign * (search->rising ? model->input_max : model->input_min);
    }
    return search->sign * model->knot[search->rising ? cell + 1 : cell].input;
}

/// Follows the output from the present point piece by piece, cell by cell; false where the wanted one is
/// further away.
static bool solve_near(const search_t* search, float* input)
{
    const hyst_f32_model_t* model = search->model;
    uint32_t cell = search->state->cell;
    lines_t lines = lines_of(search, cell);
    float near = search->near.input;
    float rest = search->wanted - search->near.output;
    float ahead = search->near.ahead;
    // Not worth following where even all plays together would take cells for it.
    const float steepest =
        lines.offset_slope + model->play[model->num_plays - 1].slope * lines.envelope_slope;
    if (rest > 3.0f * lines.width * steepest) {
        return false;
    }
    float end = end_of_cell(search, cell);
    piece_t piece = present_piece(search, ahead);
    for (int i = 0; i < MOST_PIECES; ++i) {
        const float slope = lines.offset_slope + piece.slope * lines.envelope_slope;
        const float step = rest / slope;
        *input = near + step;
        if (step > 0.0f && *input < end && ahead + lines.envelope_slope * step <= piece.limit) {
            return true;
        }
        const float room = (piece.limit - ahead) / lines.envelope_slope;
        if (room < end - near) {
            if (!(room >= 0.0f)) {
                return false;
            }
            rest -= slope * room;
            near += room;
            ahead = piece.limit;
            piece = next_piece(search, &piece);
        } else {
            if (cell == (search->rising ? hyst_f32_last_cell(model) : 0)) {
                return false;
            }
            rest -= slope * (end - near);
            near = end;
            cell = search->rising ? cell + 1 : cell - 1;
            end = end_of_cell(search, cell);
            lines = lines_of(search, cell);
            ahead = lines.envelope + lines.envelope_slope * (near - lines.input);
        }
    }
    return false;
}

/// The wanted output's input, in the direction of the move; wanted lies ahead of the present output. *clamped
/// is set where it is out of reach.
static float find(search_t* search, bool* clamped)
{
    const hyst_f32_model_t* model = search->model;
    const uint32_t present = search->state->cell;
    const bool rising = search->rising;
    float input;
    if (solve_near(search, &input)) {
        return input;
    }
    search->far =
        look(search, rising ? hyst_f32_last_cell(model) : 0, rising ? model->input_max : model->input_min);
    if (search->far.output < search->wanted) {
        *clamped = true;
        search->wanted = search->far.output;
        if (!(search->near.output < search->wanted)) {
            return search->near.input;
        }
    }
    uint32_t low = 0;
    if (model->num_knots != 0) {
        low = search_cells(search, 0, rising ? model->num_knots - 1 - present : present + 1);
    }
    search_kinks(search, rising ? present + low : present - low);
    return solve(search);
}

hyst_f32_inverse_t hyst_f32_inverse(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                    const float wanted)
{
    hyst_f32_inverse_t result = {state->input, hyst_f32_is_nan(wanted)};
    const bool rising = wanted > state->output;
    if (rising || wanted < state->output) {
        const float sign = hyst_f32_sign(rising);
        search_t search; // member by member: initialising it whole calls a memset on some cores
        search.model = model;
        search.state = state;
        search.rising = rising;
        search.sign = sign;
        search.wanted = sign * wanted;
        search.near.input = sign * state->input;
        search.near.output = sign * state->output;
        search.near.ahead = sign * hyst_f32_envelope(model, state->cell, state->input, rising);
        search.near.plays = sign * state->plays;
        result.input = sign * find(&search, &result.clamped);
    }
    return result;
}
