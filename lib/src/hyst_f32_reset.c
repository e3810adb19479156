#include "hyst_f32_segments.h"

/// Both envelopes at the ends of an alternation about the middle: ascending at its top, descending at its
/// bottom.
typedef struct {
    float ascending;
    float descending;
} span_t;

/// A walk outward from the middle of the range, from knot to knot on either side.
typedef struct {
    const hyst_f32_model_t* model;
    float middle;
    uint32_t cell_above; ///< holds the alternation's top
    uint32_t cell_below; ///< holds its bottom
    bool at_top;         ///< the alternation has reached input_max
    bool at_bottom;      ///< and input_min
    span_t span;
    span_t inner; ///< the span before the last widening
} walk_t;

static float opening(const span_t span)
{
    return span.ascending - span.descending;
}

static float upper_end(const walk_t* walk)
{
    return walk->model->num_knots == 0 ? walk->model->input_max
                                       : walk->model->knot[walk->cell_above + 1].input;
}

static float lower_end(const walk_t* walk)
{
    return walk->model->num_knots == 0 ? walk->model->input_min : walk->model->knot[walk->cell_below].input;
}

/// Widens the alternation to the nearer of the next knots above and below. Rounding of the middle may bring
/// one end of the range before the other: that side then stays there.
static void widen(walk_t* walk)
{
    const hyst_f32_model_t* model = walk->model;
    const float above = walk->at_top ? FLT_MAX : upper_end(walk) - walk->middle;
    const float below = walk->at_bottom ? FLT_MAX : walk->middle - lower_end(walk);
    const bool up_to_knot = walk->at_top || above <= below;
    const bool down_to_knot = walk->at_bottom || below <= above;
    const float top = up_to_knot ? upper_end(walk) : walk->middle + below;
    const float bottom = down_to_knot ? lower_end(walk) : walk->middle - above;
    walk->span.ascending = hyst_f32_envelope(model, walk->cell_above, top, true);
    walk->span.descending = hyst_f32_envelope(model, walk->cell_below, bottom, false);
    if (up_to_knot && walk->cell_above + 2 >= model->num_knots) {
        walk->at_top = true;
    } else if (up_to_knot) {
        ++walk->cell_above;
    }
    if (down_to_knot && walk->cell_below == 0) {
        walk->at_bottom = true;
    } else if (down_to_knot) {
        --walk->cell_below;
    }
}

/// The extreme that play j, of radius r, was left by: ascending(top) at the amplitude where ascending(top) -
/// descending(bottom) = 2 r, found by walking outward; between knots both envelopes are linear in the
/// amplitude. A play that the full range does not move gets the middle of its strip there.
static float extreme(walk_t* walk, const float two_r)
{
    while (!(walk->at_top && walk->at_bottom) && opening(walk->span) < two_r) {
        walk->inner = walk->span;
        widen(walk);
    }
    const span_t inner = walk->inner;
    const span_t outer = walk->span;
    const float gap = opening(outer) - opening(inner);
    if (opening(outer) < two_r) {
        return 0.5f * (outer.ascending + outer.descending + two_r);
    }
    const float part = gap > 0.0f ? hyst_f32_limit((two_r - opening(inner)) / gap, 0.0f, 1.0f) : 0.0f;
    return inner.ascending + part * (outer.ascending - inner.ascending);
}

/// Play r follows the alternation until its amplitude has shrunk so far that it no longer moves, and stays at
/// ascending(top) - r. That amplitude grows with r, so one walk outward serves all plays. As a stack: a
/// segment of its own for each play, all left by a rising input, the widest outermost.
static void demagnetise(const hyst_f32_model_t* model, hyst_f32_state_t* state)
{
    const float middle = hyst_f32_middle(model);
    const uint32_t cell = hyst_f32_find_cell(model, 0, hyst_f32_last_cell(model), middle);
    walk_t walk = {model, middle, cell, cell, false, false, {0.0f, 0.0f}, {0.0f, 0.0f}};
    walk.span.ascending = hyst_f32_envelope(model, cell, middle, true);
    walk.span.descending = hyst_f32_envelope(model, cell, middle, false);
    walk.inner = walk.span;
    const uint32_t front = model->num_plays - 1;
    float least = -FLT_MAX;
    for (uint32_t j = 0; j <= front; ++j) {
        hyst_f32_segment_t* segment = &state->memory[front - j];
        least = hyst_f32_larger(least, extreme(&walk, model->play[j].opening));
        segment->level = least;
        segment->last = (uint16_t)j;
        segment->rising = 1;
    }
    state->front = front;
    hyst_f32_sum_up(model, state->memory, front);
    state->plays = state->memory[front].sum[1];
    hyst_f32_place(model, state, middle);
}

float hyst_f32_reset(const hyst_f32_model_t* model, hyst_f32_state_t* state, const hyst_start_t start,
                     const float input)
{
    switch (start) {
    case HYST_START_POSITIVE_SATURATION:
        hyst_f32_saturate(model, state, true);
        break;
    case HYST_START_DEMAGNETISED:
        demagnetise(model, state);
        break;
    case HYST_START_NEGATIVE_SATURATION:
    default:
        hyst_f32_saturate(model, state, false);
        break;
    }
    return hyst_f32_step(model, state, hyst_f32_is_nan(input) ? hyst_f32_middle(model) : input);
}
