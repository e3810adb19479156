#include "hyst_f32_segments.h"

static hyst_status_t check_layout(const hyst_f32_model_t* model, const size_t memory_length)
{
    if (model->format != HYST_MODEL_FORMAT) {
        return HYST_STATUS_MODEL_FORMAT;
    }
    if (model->num_plays == 0 || model->num_plays > HYST_MAX_PLAYS) {
        return HYST_STATUS_PLAY_COUNT;
    }
    if (model->play == NULL || (model->num_knots != 0 && model->knot == NULL)) {
        return HYST_STATUS_NULL_POINTER;
    }
    return memory_length < model->num_plays ? HYST_STATUS_MEMORY_LENGTH : HYST_STATUS_OK;
}

static hyst_status_t check_range(const hyst_f32_model_t* model)
{
    const bool finite = hyst_f32_is_finite(model->input_min) && hyst_f32_is_finite(model->input_max) &&
                        hyst_f32_is_finite(model->input_max - model->input_min);
    return finite && model->input_min < model->input_max ? HYST_STATUS_OK : HYST_STATUS_INPUT_RANGE;
}

static hyst_status_t check_openings(const hyst_f32_model_t* model)
{
    float least = 0.0f;
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        const float opening = model->play[j].opening;
        if (!(opening >= least && hyst_f32_is_finite(opening))) {
            return HYST_STATUS_RADIUS;
        }
        least = opening;
    }
    return HYST_STATUS_OK;
}

/// Whether the loading curve, as computed between two openings, does not overshoot the next one's value and
/// misses it by no more than rounding: of the slope, the difference, the product and both values, 6 u of the
/// value.
static bool is_joined(const hyst_f32_play_t* play)
{
    const float end = play->loading + play->slope * (play[1].opening - play->opening);
    return hyst_f32_is_finite(play[1].loading) && end <= play[1].loading &&
           play[1].loading - end <= 4.0f * FLT_EPSILON * play[1].loading + FLT_MIN;
}

/// Slopes that grow from 0, values that follow from them and the openings, and the moment that follows from
/// all. A value may be rounded up at every opening, so that N u of it, and 3 u from the first, are rounding.
static hyst_status_t check_loading(const hyst_f32_model_t* model)
{
    const hyst_f32_play_t* play = model->play;
    const hyst_f32_play_t* last = &play[model->num_plays - 1];
    float least = 0.0f;
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        if (!(play[j].slope >= least && hyst_f32_is_finite(play[j].slope))) {
            return HYST_STATUS_WEIGHT;
        }
        least = play[j].slope;
    }
    if (!(play[0].loading >= 0.0f && play[0].loading <= 0.0f)) {
        return HYST_STATUS_LOADING;
    }
    for (const hyst_f32_play_t* p = play; p < last; ++p) {
        if (!is_joined(p)) {
            return HYST_STATUS_LOADING;
        }
    }
    const float most = last->slope * last->opening;
    const float allowance = FLT_EPSILON * (float)(model->num_plays + 8) * most + FLT_MIN;
    return hyst_f32_magnitude(2.0f * model->moment - (most - last->loading)) <= allowance
               ? HYST_STATUS_OK
               : HYST_STATUS_LOADING;
}

/// Whether a curve does not decrease in a cell of this width, and its slope leads from one value to the next,
/// not beyond as computed, and to within rounding: of either value to float, of the slope, the difference,
/// the product and the sum, 8 u = 4 FLT_EPSILON at most; a slope that underflows is off by less than FLT_MIN.
static bool fits(const float width, const float value, const float slope, const float next_value)
{
    const float rise = next_value - value;
    const float allowance =
        4.0f * FLT_EPSILON * (hyst_f32_magnitude(value) + hyst_f32_magnitude(next_value)) + FLT_MIN * width;
    return hyst_f32_is_finite(rise) && rise >= 0.0f && hyst_f32_is_finite(slope) && slope >= 0.0f &&
           value + slope * width <= next_value && rise - slope * width <= allowance;
}

/// ascending - r <= descending + r to within the rounding of the three and of the sums.
static bool is_ordered(const hyst_f32_knot_t* knot, const float least_radius)
{
    const float allowance = FLT_EPSILON * (hyst_f32_magnitude(knot->ascending) +
                                           hyst_f32_magnitude(knot->descending) + 2.0f * least_radius);
    return knot->ascending - least_radius <= knot->descending + least_radius + allowance;
}

static hyst_status_t check_knots(const hyst_f32_model_t* model)
{
    const hyst_f32_knot_t* knot = model->knot;
    const uint32_t last = model->num_knots - 1;
    if (last < 1 || last >= HYST_MAX_KNOTS) {
        return HYST_STATUS_KNOTS;
    }
    for (uint32_t k = 0; k < last; ++k) {
        if (!(knot[k].input < knot[k + 1].input)) {
            return HYST_STATUS_KNOTS;
        }
    }
    const bool covers = knot[0].input >= model->input_min && knot[0].input <= model->input_min &&
                        knot[last].input >= model->input_max && knot[last].input <= model->input_max;
    return covers ? HYST_STATUS_OK : HYST_STATUS_KNOTS;
}

static hyst_status_t check_curves(const hyst_f32_model_t* model)
{
    const hyst_f32_knot_t* knot = model->knot;
    const uint32_t last = model->num_knots - 1;
    for (uint32_t k = 0; k < last; ++k) {
        const hyst_f32_knot_t* next = &knot[k + 1];
        const float width = next->input - knot[k].input;
        if (!fits(width, knot[k].nonhysteretic, knot[k].nonhysteretic_slope, next->nonhysteretic)) {
            return HYST_STATUS_NONHYSTERETIC;
        }
        if (!fits(width, knot[k].ascending, knot[k].ascending_slope, next->ascending) ||
            !fits(width, knot[k].descending, knot[k].descending_slope, next->descending)) {
            return HYST_STATUS_ENVELOPE;
        }
    }
    if (!(knot[0].ascending < knot[last].ascending && knot[0].descending < knot[last].descending)) {
        return HYST_STATUS_ENVELOPE;
    }
    for (uint32_t k = 0; k <= last; ++k) {
        if (!is_ordered(&knot[k], 0.5f * model->play[0].opening)) {
            return HYST_STATUS_ENVELOPE_ORDER;
        }
    }
    return HYST_STATUS_OK;
}

/// Every envelope, level and opening is at most `reach`, every sum at most P reach, and no difference or
/// product of the step's or the inverse's is larger than 8 of that.
static hyst_status_t check_output(const hyst_f32_model_t* model)
{
    const hyst_f32_play_t* last = &model->play[model->num_plays - 1];
    const float reach = hyst_f32_envelope_bound(model) + last->opening;
    const float low = hyst_f32_offset(model, 0, model->input_min);
    const float high = hyst_f32_offset(model, hyst_f32_last_cell(model), model->input_max);
    const float offset = hyst_f32_larger(hyst_f32_magnitude(low), hyst_f32_magnitude(high));
    // A radius that overflows would hide behind a weight of 0.
    return hyst_f32_is_finite(8.0f * (offset + hyst_f32_magnitude(model->constant) + last->slope * reach)) &&
                   hyst_f32_is_finite(8.0f * reach)
               ? HYST_STATUS_OK
               : HYST_STATUS_OUTPUT_RANGE;
}

static hyst_status_t check_model(const hyst_f32_model_t* model)
{
    hyst_status_t status = check_range(model);
    if (status == HYST_STATUS_OK) {
        status = check_openings(model);
    }
    if (status == HYST_STATUS_OK) {
        status = check_loading(model);
    }
    if (status == HYST_STATUS_OK && model->num_knots == 0) {
        const float slope = model->nonhysteretic_slope;
        status = slope >= 0.0f && hyst_f32_is_finite(slope) ? HYST_STATUS_OK : HYST_STATUS_NONHYSTERETIC;
    }
    if (status == HYST_STATUS_OK && model->num_knots != 0) {
        status = check_knots(model);
    }
    if (status == HYST_STATUS_OK && model->num_knots != 0) {
        status = check_curves(model);
    }
    return status == HYST_STATUS_OK ? check_output(model) : status;
}

hyst_status_t hyst_f32_init(const hyst_f32_model_t* model, hyst_f32_state_t* state,
                            hyst_f32_segment_t* memory, const size_t memory_length)
{
    if (model == NULL || state == NULL || memory == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    hyst_status_t status = check_layout(model, memory_length);
    if (status == HYST_STATUS_OK) {
        status = check_model(model);
    }
    if (status != HYST_STATUS_OK) {
        return status;
    }
    state->memory = memory;
    state->invalid_inputs = 0;
    state->clamped_inputs = 0;
    hyst_f32_saturate(model, state, false);
    return HYST_STATUS_OK;
}
