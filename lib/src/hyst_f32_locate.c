#include "hyst_f32_inverse.h"

/// What is looked for; does not change while it is.
typedef struct {
    const hyst_f32_model_t* model;
    const hyst_f32_state_t* state;
    bool rising;
    float sign;
    float wanted;
    float plays;  ///< the plays' part of the present output
    float turned; ///< sum[rising] of the front
} search_t;

/// Knots of the table by index: the output at `near` falls short of the wanted one, at `far` it does not.
/// `start` stands for the line's beginning, which is no knot.
typedef struct {
    uint32_t near, far, start;
} knots_t;

/// Where the plays of a segment, or the next one of them, start to move: when the envelope is at shift +
/// width. `sum` is that of all plays there.
typedef struct {
    float shift, width, sum;
} kink_t;

/// The plays' sum over the envelope a: end - (top - (loading + slope ((a - shift) - opening))).
typedef struct {
    float shift, opening, loading, slope, top, end;
} stretch_t;

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
    return search->sign * (search->rising ? knot->ascending : knot->descending);
}

static inline float offset_at(const search_t* search, const hyst_f32_knot_t* knot)
{
    return search->sign * (search->model->constant + knot->nonhysteretic);
}

static hyst_f32_curves_t curves_of(const search_t* search, const uint32_t cell, const float input)
{
    return hyst_f32_curves(search->model, cell, search->rising, input);
}

/// The input at `near`.
static inline float near_input(const search_t* search, const knots_t* knots, const hyst_f32_line_t* line)
{
    return knots->near == knots->start ? line->input : search->sign * search->model->knot[knots->near].input;
}

static inline uint32_t cell_of(const search_t* search, const knots_t* knots)
{
    return search->rising ? knots->near : knots->far;
}

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

static inline kink_t opening_of(const search_t* search, const kink_t* end, const float top,
                                const uint32_t index)
{
    const hyst_f32_play_t* play = &search->model->play[index];
    const kink_t kink = {end->shift, play->opening, end->sum - (top - play->loading)};
    return kink;
}

static float search_kinks(const search_t* search, knots_t* knots, hyst_f32_line_t* line)
{
    const hyst_f32_segment_t* memory = search->state->memory;
    const uint32_t present = line->kept;
    uint32_t low = 0;
    uint32_t high = present + 1;
    bool is_over = false;
    kink_t end = {0.0f, 0.0f, 0.0f};
    float top = 0.0f;
    bool is_cell = false;
    hyst_f32_curves_t cell = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    float ratio = 0.0f;
    float ahead = -FLT_MAX;
    for (;;) {
        const uint32_t middle = (low + high) / 2;
        if (middle == low) {
            if (is_over) {
                line->num_moving = low;
                return ahead;
            }
            line->kept = present - low;
            if (low != 0) {
                line->num_moving = memory[line->kept].last + 1u;
            }
            if (line->kept == 0 || hyst_f32_is_along(&memory[line->kept - 1], search->rising)) {
                return ahead;
            }
            is_over = true;
            end = end_of_segment(search, line->kept - 1);
            high = memory[line->kept - 1].last + 1u;
            top = search->model->play[high - 1].loading;
            low = line->num_moving;
            continue;
        }
        const kink_t kink = is_over ? opening_of(search, &end, top, middle - 1)
                                    : end_of_segment(search, present - middle);
        bool is_short = false;
        for (;;) {
            const uint32_t m = middle_of(knots);
            if (!is_between(knots, m)) {
                if (!is_cell) {
                    cell = curves_of(search, cell_of(search, knots), near_input(search, knots, line));
                    ratio = hyst_f32_limit(cell.offset_slope / cell.envelope_slope, 0.0f, FLT_MAX);
                    is_cell = true;
                }
                is_short = cell.offset + ratio * (kink.shift + kink.width - cell.ahead) + kink.sum <
                           search->wanted;
                break;
            }
            const hyst_f32_knot_t* knot = &search->model->knot[m];
            const float beyond = ahead_at(search, knot) - kink.shift;
            if (offset_at(search, knot) + kink.sum < search->wanted) {
                if (beyond > kink.width) {
                    is_short = true;
                    break;
                }
                knots->near = m;
            } else {
                if (!(beyond > kink.width)) {
                    break;
                }
                knots->far = m;
            }
        }
        if (is_short) {
            low = middle;
            ahead = kink.shift + kink.width;
        } else {
            high = middle;
        }
    }
}

static inline stretch_t stretch_of(const search_t* search, const hyst_f32_line_t* line)
{
    const hyst_f32_model_t* model = search->model;
    stretch_t stretch = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, search->plays};
    if (line->num_moving == 0) {
        return stretch;
    }
    const hyst_f32_play_t* moving = &model->play[line->num_moving - 1];
    stretch.slope = moving->slope;
    stretch.end = -model->moment;
    if (line->kept != 0) {
        const kink_t end = end_of_segment(search, line->kept - 1);
        stretch.end = end.sum;
        stretch.shift = end.shift;
        if (!hyst_f32_is_along(&search->state->memory[line->kept - 1], search->rising)) {
            stretch.opening = moving->opening;
            stretch.loading = moving->loading;
            stretch.top = model->play[search->state->memory[line->kept - 1].last].loading;
        }
    }
    return stretch;
}

static inline float sum_at(const stretch_t* stretch, const float ahead)
{
    const float x = ahead - stretch->shift - stretch->opening;
    return stretch->end - (stretch->top - (stretch->loading + stretch->slope * x));
}

static void search_knots(const search_t* search, const stretch_t* stretch, knots_t* knots)
{
    for (uint32_t middle = middle_of(knots); is_between(knots, middle); middle = middle_of(knots)) {
        const hyst_f32_knot_t* knot = &search->model->knot[middle];
        const float sum = hyst_f32_larger(sum_at(stretch, ahead_at(search, knot)), search->plays);
        if (offset_at(search, knot) + sum < search->wanted) {
            knots->near = middle;
        } else {
            knots->far = middle;
        }
    }
}

/// Moves the line to the one that crosses the wanted output, if it does not lie beyond `end`; true if that
/// was shown.
static bool search_line(const search_t* search, const uint32_t end, hyst_f32_line_t* line)
{
    knots_t knots = {0, end, 0};
    knots.start = search->rising ? line->cell : line->cell + 1;
    knots.near = knots.start;
    const float kink = search_kinks(search, &knots, line);
    const stretch_t stretch = stretch_of(search, line);
    search_knots(search, &stretch, &knots);
    line->cell = cell_of(search, &knots);
    line->input = near_input(search, &knots, line);
    hyst_f32_curves_t cell = curves_of(search, line->cell, line->input);
    if (kink > cell.ahead) {
        const float step = (kink - cell.ahead) / cell.envelope_slope;
        line->input += step;
        cell.offset += cell.offset_slope * step;
        cell.ahead = kink;
    }
    line->output = cell.offset + sum_at(&stretch, cell.ahead);
    return knots.far != end;
}

/// The output at the end of the range.
static float reach_of(const search_t* search)
{
    const hyst_f32_model_t* model = search->model;
    const bool rising = search->rising;
    const hyst_f32_curves_t curves = curves_of(search, rising ? hyst_f32_last_cell(model) : 0,
                                               rising ? model->input_max : -model->input_min);
    hyst_f32_front_t front;
    float plays = search->plays;
    if (hyst_f32_meet(model, search->state, rising, curves.ahead, &front)) {
        plays = hyst_f32_larger(front.sum, plays);
    }
    return curves.offset + plays;
}

void hyst_f32_locate(const hyst_f32_model_t* model, const hyst_f32_state_t* state, const bool rising,
                     float* wanted, hyst_f32_line_t* line, bool* clamped)
{
    const hyst_f32_line_t from = *line;
    search_t search;
    search.model = model;
    search.state = state;
    search.rising = rising;
    search.sign = hyst_f32_sign(rising);
    search.wanted = *wanted;
    search.plays = search.sign * state->plays;
    search.turned = search.plays;
    if (!hyst_f32_is_along(&state->memory[state->front], rising)) {
        search.turned = hyst_f32_end_of(model, state->memory, state->front, rising);
    }
    const uint32_t end = rising ? hyst_f32_last_cell(model) + 1 : 0;
    if (search_line(&search, end, line)) {
        return;
    }
    const float reach = reach_of(&search);
    if (reach < *wanted) {
        *clamped = true;
        *wanted = reach;
        search.wanted = reach;
        *line = from;
        if (line->output < reach) {
            (void)search_line(&search, end, line);
        }
    }
}
