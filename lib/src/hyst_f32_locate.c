#include "hyst_f32_inverse.h"

/// The envelope somewhere, and the part of the output that is known there: the plays' at a kink, the rest at
/// a knot. In the direction of the move.
typedef struct {
    float ahead, part;
} point_t;

/// Counted in the direction of the move: `low` falls short of the wanted output, `high` does not.
typedef struct {
    uint32_t low, high, middle; ///< middle: the next to ask
} bracket_t;

typedef struct {
    const hyst_f32_model_t* model;
    const hyst_f32_state_t* state;
    bool rising;
    float sign;
    float wanted;
    bracket_t knots; ///< 0: the present input
    point_t knot;    ///< at knots.low
    bracket_t kinks;
    point_t kink; ///< at kinks.low
    float turned; ///< sum[rising] of the front
} search_t;

/// The envelope is at shift + width where the kink is; `sum` is the plays' there.
typedef struct {
    float shift, width, sum;
} kink_t;

static inline bool is_open(const bracket_t* bracket)
{
    return bracket->high - bracket->low > 1;
}

static inline void narrow(bracket_t* bracket, const bool is_short)
{
    if (is_short) {
        bracket->low = bracket->middle;
    } else {
        bracket->high = bracket->middle;
    }
    bracket->middle = bracket->low + (bracket->high - bracket->low) / 2;
}

static inline point_t knot_at(const search_t* search, const uint32_t count)
{
    const uint32_t cell = search->state->cell;
    const hyst_f32_knot_t* knot =
        &search->model->knot[search->rising ? cell + count : cell + 1 - count];
    const point_t point = {search->sign * (search->rising ? knot->ascending : knot->descending),
                           search->sign * (search->model->constant + knot->nonhysteretic)};
    return point;
}

/// The cell that begins at the knot.
static inline uint32_t cell_from(const search_t* search, const uint32_t count)
{
    return search->rising ? search->state->cell + count : search->state->cell - count;
}

/// Where a segment is taken.
static inline kink_t end_of_segment(const search_t* search, const uint32_t index)
{
    const hyst_f32_segment_t* segment = &search->state->memory[index];
    kink_t kink = {segment->level, 0.0f, segment->sum[search->rising]};
    if (!hyst_f32_is_along(segment, search->rising)) {
        kink.shift = -segment->level;
        kink.width = search->model->play[segment->last].opening;
        if (index == search->state->front) {
            kink.sum = search->turned;
        }
    }
    return kink;
}

/// Where the play starts to move over a segment that was left in the other direction.
static inline kink_t opening_of(const search_t* search, const kink_t* end, const float loading,
                                const uint32_t index)
{
    const hyst_f32_play_t* play = &search->model->play[index];
    const kink_t kink = {end->shift, play->opening, end->sum - (loading - play->loading)};
    return kink;
}

/// Slope of the output's other part over the envelope in the cell that the knots leave.
static float ratio_of(const search_t* search)
{
    const curves_t curves =
        hyst_f32_curves(search->model, cell_from(search, search->knots.low), search->rising);
    return hyst_f32_limit(curves.offset_slope / curves.envelope_slope, 0.0f, FLT_MAX);
}

/// One question, which halves either the knots or the kinks.
static inline void ask(search_t* search, const kink_t* kink)
{
    point_t knot = search->knot;
    point_t at_kink = {kink->shift + kink->width, kink->sum};
    bool is_beyond = false;
    const bool is_knot_open = is_open(&search->knots);
    if (is_knot_open) {
        knot = knot_at(search, search->knots.middle);
        is_beyond = knot.ahead - kink->shift > kink->width;
    } else {
        knot.part = knot.part + ratio_of(search) * (at_kink.ahead - knot.ahead);
    }
    const bool is_short = knot.part + kink->sum < search->wanted;
    if (is_knot_open && is_short != is_beyond) {
        narrow(&search->knots, is_short);
        if (is_short) {
            search->knot = knot;
        }
    } else {
        narrow(&search->kinks, is_short);
        if (is_short) {
            search->kink = at_kink;
        }
    }
}

static void set_kinks(search_t* search, const uint32_t low, const uint32_t high)
{
    search->kinks.low = low;
    search->kinks.high = high;
    search->kinks.middle = low + 1;
}

static void search_kinks(search_t* search, line_t* line)
{
    const hyst_f32_segment_t* memory = search->state->memory;
    const uint32_t kept = line->kept;
    set_kinks(search, 0, kept + 1);
    while (is_open(&search->kinks)) {
        const kink_t kink = end_of_segment(search, kept - search->kinks.middle);
        ask(search, &kink);
    }
    line->kept = kept - search->kinks.low;
    if (search->kinks.low != 0) {
        line->num_moving = memory[line->kept].last + 1u;
    }
    if (line->kept == 0 || hyst_f32_is_along(&memory[line->kept - 1], search->rising)) {
        return;
    }
    const uint32_t last = memory[line->kept - 1].last;
    const kink_t end = end_of_segment(search, line->kept - 1);
    set_kinks(search, line->num_moving, last + 1u);
    while (is_open(&search->kinks)) {
        const kink_t kink = opening_of(search, &end, search->model->play[last].loading, search->kinks.middle - 1);
        ask(search, &kink);
    }
    line->num_moving = search->kinks.low;
}

/// The plays' sum at `ahead`, in the arithmetic of a step, when the line's plays move.
static float sum_at(const search_t* search, const line_t* line, const float ahead)
{
    const hyst_f32_model_t* model = search->model;
    const float present = search->sign * search->state->plays;
    if (line->num_moving == 0) {
        return present;
    }
    if (line->kept == 0) {
        return hyst_f32_larger(present, hyst_f32_over_none(model, ahead));
    }
    const hyst_f32_segment_t* kept = &search->state->memory[line->kept - 1];
    const bool along = hyst_f32_is_along(kept, search->rising);
    const float end = end_of_segment(search, line->kept - 1).sum;
    return hyst_f32_larger(present, hyst_f32_over(model->play, kept, along, end, line->num_moving - 1,
                                                  hyst_f32_beyond(kept, along, ahead)));
}

static void search_knots(search_t* search, const line_t* line)
{
    while (is_open(&search->knots)) {
        const point_t knot = knot_at(search, search->knots.middle);
        const bool is_short = knot.part + sum_at(search, line, knot.ahead) < search->wanted;
        narrow(&search->knots, is_short);
        if (is_short) {
            search->knot = knot;
        }
    }
}

/// The line begins at the knot or the kink, whichever comes later.
static void begin(const search_t* search, line_t* line)
{
    const hyst_f32_model_t* model = search->model;
    line->cell = cell_from(search, search->knots.low);
    if (search->knots.low != 0) {
        line->input = search->sign * model->knot[search->rising ? line->cell : line->cell + 1].input;
    }
    const point_t knot = search->knot;
    const point_t kink = search->kink;
    if (kink.ahead > knot.ahead) {
        const curves_t curves = hyst_f32_curves(model, line->cell, search->rising);
        const float step = (kink.ahead - knot.ahead) / curves.envelope_slope;
        line->input += step;
        line->ahead = kink.ahead;
        line->output = knot.part + curves.offset_slope * step + kink.part;
    } else {
        line->ahead = knot.ahead;
        line->output =
            knot.part +
            (kink.part + hyst_f32_slope(model->play, line->num_moving) * (knot.ahead - kink.ahead));
    }
}

/// The output at the end of the range.
static float reach_of(const search_t* search)
{
    const hyst_f32_model_t* model = search->model;
    const bool rising = search->rising;
    const float input = rising ? model->input_max : model->input_min;
    const uint32_t cell = rising ? hyst_f32_last_cell(model) : 0;
    hyst_f32_front_t front;
    float plays = search->sign * search->state->plays;
    if (hyst_f32_meet(model, search->state, rising,
                      search->sign * hyst_f32_envelope(model, cell, input, rising), &front)) {
        plays = hyst_f32_larger(front.sum, plays);
    }
    return search->sign * hyst_f32_offset(model, cell, input) + plays;
}

void hyst_f32_locate(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const bool rising,
                     float* wanted, line_t* line, bool* clamped)
{
    search_t search;
    search.model = model;
    search.state = state;
    search.rising = rising;
    search.sign = hyst_f32_sign(rising);
    const float reach = reach_of(&search);
    if (reach < *wanted) {
        *clamped = true;
        *wanted = reach;
        if (!(line->output < reach)) {
            return;
        }
    }
    search.wanted = *wanted;
    const float plays = search.sign * state->plays;
    search.kink.ahead = line->ahead;
    search.kink.part = plays;
    search.knot.ahead = line->ahead;
    search.knot.part = search.sign * hyst_f32_offset(model, state->cell, state->input);
    search.knots.low = 0;
    search.knots.high = rising ? hyst_f32_last_cell(model) + 1 - state->cell : state->cell + 1;
    search.knots.middle = 1;
    search.turned = 0.0f;
    if (!hyst_f32_is_along(&state->memory[state->front], rising)) {
        search.turned = hyst_f32_end_of(model, state->memory, state->front, rising);
    }
    search_kinks(&search, line);
    search_knots(&search, line);
    begin(&search, line);
}
