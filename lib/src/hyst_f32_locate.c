#include "hyst_f32_inverse.h"

/// What is looked for; does not change while it is.
typedef struct {
    const hyst_f32_model_t* model;
    const hyst_f32_state_t* state;
    bool rising;
    float wanted;
    float plays;  ///< the plays' part of the present output
    float turned; ///< sum[rising] of the front, if it was left in the other direction
} search_t;

/// Knots of the table by index: the output at `near` falls short of the wanted one, at `far` it does not.
/// `start` stands for the line's beginning, which is no knot.
typedef struct {
    uint32_t near, far, start;
} knots_t;

/// Where a play, or all of a segment, starts to move: when the envelope is at shift + width. `sum` is that of
/// all plays there.
typedef struct {
    float shift, width, sum;
} kink_t;

/// The curves where a cell begins, and the ratio of their slopes.
typedef struct {
    hyst_f32_curves_t curves;
    float input, offset, ratio;
} cell_t;

static inline uint32_t middle_of(const knots_t* knots)
{
    return (knots->near + knots->far) / 2;
}

/// Whether `middle` lies between the two, in either direction.
static inline bool is_between(const knots_t* knots, const uint32_t middle)
{
    return middle != knots->near && middle != knots->far;
}

static inline float ahead_at(const search_t* search, const hyst_f32_knot_t* knot)
{
    return search->rising ? knot->ascending : -knot->descending;
}

static inline float offset_at(const search_t* search, const hyst_f32_knot_t* knot)
{
    return hyst_f32_toward(search->model->constant + knot->nonhysteretic, search->rising);
}

static inline uint32_t cell_after(const search_t* search, const knots_t* knots)
{
    return search->rising ? knots->near : knots->far;
}

static void set_cell(const search_t* search, const uint32_t index, const float v, cell_t* cell)
{
    cell->input = hyst_f32_toward(v, search->rising);
    cell->curves = hyst_f32_curves(search->model, index, search->rising, cell->input);
    cell->offset = hyst_f32_toward(hyst_f32_offset(search->model, index, v), search->rising);
    cell->ratio = hyst_f32_limit(cell->curves.offset_slope / cell->curves.envelope_slope, 0.0f, FLT_MAX);
}

static void begin_cell(const search_t* search, const knots_t* knots, const float start, cell_t* cell)
{
    const float v = knots->near == knots->start ? hyst_f32_toward(start, search->rising)
                                                : search->model->knot[knots->near].input;
    set_cell(search, cell_after(search, knots), v, cell);
}

static inline float end_sum(const search_t* search, const hyst_f32_segment_t* segment, const bool along)
{
    return !along && segment == &search->state->memory[search->state->front] ? search->turned
                                                                             : segment->sum[search->rising];
}

/// The kink of a play over a segment that was left in the other direction, or the end of one that was not.
static inline kink_t kink_of(const search_t* search, const hyst_f32_segment_t* segment, const uint32_t index)
{
    const bool along = hyst_f32_is_along(segment, search->rising);
    kink_t kink = {segment->level, 0.0f, end_sum(search, segment, along)};
    if (!along) {
        const hyst_f32_play_t* play = search->model->play;
        kink.shift = -kink.shift;
        kink.width = play[index].opening;
        kink.sum -= play[segment->last].loading - play[index].loading;
    }
    return kink;
}

/// Whether the output at the kink falls short. A knot's offset and a kink's sum short of the wanted output:
/// the earlier of the two falls short. Not short: the later does not. Narrows the knots until it is the kink.
static inline bool is_kink_short(const search_t* search, const kink_t* kink, const float start,
                                 knots_t* knots, cell_t* cell)
{
    for (;;) {
        const uint32_t middle = middle_of(knots);
        if (!is_between(knots, middle)) {
            break;
        }
        const hyst_f32_knot_t* knot = &search->model->knot[middle];
        const bool is_beyond = ahead_at(search, knot) - kink->shift > kink->width;
        if (offset_at(search, knot) + kink->sum < search->wanted) {
            if (is_beyond) {
                return true;
            }
            knots->near = middle;
        } else {
            if (!is_beyond) {
                return false;
            }
            knots->far = middle;
        }
    }
    if (!(cell->ratio >= 0.0f)) {
        begin_cell(search, knots, start, cell);
    }
    return cell->offset + cell->ratio * (kink->shift + kink->width - cell->curves.ahead) + kink->sum <
           search->wanted;
}

static void search_kinks(const search_t* search, knots_t* knots, cell_t* cell, hyst_f32_line_t* line)
{
    const hyst_f32_segment_t* memory = search->state->memory;
    const hyst_f32_segment_t* over = NULL;
    const uint32_t present = line->kept;
    uint32_t low = 0;
    uint32_t high = present + 1;
    for (;;) {
        const uint32_t middle = (low + high) / 2;
        if (middle == low) {
            if (over != NULL) {
                line->num_moving = low;
                return;
            }
            line->kept = present - low;
            if (low != 0) {
                line->num_moving = memory[line->kept].last + 1u;
            }
            if (line->kept == 0) {
                return;
            }
            over = &memory[line->kept - 1];
            low = line->num_moving;
            high = hyst_f32_is_along(over, search->rising) ? low : over->last + 1u;
            continue;
        }
        const hyst_f32_segment_t* segment = over != NULL ? over : &memory[present - middle];
        const kink_t kink = kink_of(search, segment, over != NULL ? middle - 1 : segment->last);
        if (is_kink_short(search, &kink, line->input, knots, cell)) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// The plays' sum over the envelope a in one piece: end - (top - (loading + slope ((a - shift) - opening))),
/// which are a step's operations, with zeros where it has none.
typedef struct {
    float shift, opening, loading, slope, top, end;
} piece_t;

static inline piece_t piece_of(const search_t* search, const hyst_f32_line_t* line)
{
    const hyst_f32_model_t* model = search->model;
    piece_t piece = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, search->plays};
    if (line->num_moving == 0) {
        return piece;
    }
    const hyst_f32_play_t* last = &model->play[line->num_moving - 1];
    piece.slope = last->slope;
    piece.end = -model->moment;
    if (line->kept != 0) {
        const hyst_f32_segment_t* kept = &search->state->memory[line->kept - 1];
        const bool along = hyst_f32_is_along(kept, search->rising);
        piece.end = end_sum(search, kept, along);
        piece.shift = kept->level;
        if (!along) {
            piece.shift = -kept->level;
            piece.opening = last->opening;
            piece.loading = last->loading;
            piece.top = model->play[kept->last].loading;
        }
    }
    return piece;
}

static inline float sum_at(const piece_t* piece, const float ahead)
{
    const float x = ahead - piece->shift - piece->opening;
    return piece->end - (piece->top - (piece->loading + piece->slope * x));
}

/// Moves the line to the one that crosses the wanted output.
static void search_line(const search_t* search, const uint32_t end, hyst_f32_found_t* found)
{
    hyst_f32_line_t* line = &found->line;
    const uint32_t start = search->rising ? line->cell : line->cell + 1;
    knots_t knots = {start, end, start};
    cell_t cell;
    cell.ratio = -1.0f;
    search_kinks(search, &knots, &cell, line);
    const piece_t piece = piece_of(search, line);
    for (uint32_t middle = middle_of(&knots); is_between(&knots, middle); middle = middle_of(&knots)) {
        const hyst_f32_knot_t* knot = &search->model->knot[middle];
        if (offset_at(search, knot) + hyst_f32_larger(sum_at(&piece, ahead_at(search, knot)), search->plays) <
            search->wanted) {
            knots.near = middle;
        } else {
            knots.far = middle;
        }
    }
    begin_cell(search, &knots, line->input, &cell);
    line->cell = cell_after(search, &knots);
    line->input = cell.input;
    line->output = cell.offset + sum_at(&piece, cell.curves.ahead);
    found->curves = cell.curves;
}

/// The output at the end of the range.
static float reach_of(const search_t* search)
{
    const hyst_f32_model_t* model = search->model;
    const bool rising = search->rising;
    hyst_f32_front_t front;
    cell_t cell;
    set_cell(search, rising ? hyst_f32_last_cell(model) : 0, rising ? model->input_max : model->input_min,
             &cell);
    float plays = search->plays;
    if (hyst_f32_meet(model, search->state, rising, cell.curves.ahead, &front)) {
        plays = hyst_f32_larger(front.sum, plays);
    }
    return cell.offset + plays;
}

void hyst_f32_locate(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const bool rising,
                     hyst_f32_found_t* found)
{
    search_t search;
    search.model = model;
    search.state = state;
    search.rising = rising;
    search.plays = hyst_f32_toward(state->plays, rising);
    const float reach = reach_of(&search);
    if (reach < found->wanted) {
        found->wanted = reach;
        found->clamped = true;
    }
    if (!(found->line.output < found->wanted)) {
        return;
    }
    search.wanted = found->wanted;
    search.turned = 0.0f;
    if (!hyst_f32_is_along(&state->memory[state->front], rising)) {
        search.turned = hyst_f32_end_of(model, state->memory, state->front, rising);
    }
    search_line(&search, rising ? hyst_f32_last_cell(model) + 1 : 0, found);
}
