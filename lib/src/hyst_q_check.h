#include "hyst_q_internal.h"

static hyst_status_t check_layout(const hyst_q_model_t* model, const size_t memory_length)
{
    if (model->format != HYST_MODEL_FORMAT) {
        return HYST_STATUS_MODEL_FORMAT;
    }
    if (model->num_plays == 0 || model->num_plays > HYST_MAX_PLAYS) {
        return HYST_STATUS_PLAY_COUNT;
    }
    if (model->radius == NULL || model->cumulative_weight == NULL || model->cumulative_moment == NULL ||
        model->knot == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    if (model->input_min >= model->input_max) {
        return HYST_STATUS_INPUT_RANGE;
    }
    return memory_length < model->num_plays ? HYST_STATUS_MEMORY_LENGTH : HYST_STATUS_OK;
}

static hyst_status_t check_plays(const hyst_q_model_t* model)
{
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        const uint32_t radius = model->radius[j];
        if (radius > HYST_Q_RADIUS_MAX || (j > 0 && radius < model->radius[j - 1])) {
            return HYST_STATUS_RADIUS;
        }
    }
    if (model->cumulative_weight[0] != 0 || model->cumulative_moment[0] != 0) {
        return HYST_STATUS_WEIGHT;
    }
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        if (model->cumulative_weight[j + 1] < model->cumulative_weight[j]) {
            return HYST_STATUS_WEIGHT;
        }
        const uint32_t weight = (uint32_t)(model->cumulative_weight[j + 1] - model->cumulative_weight[j]);
        if (model->cumulative_moment[j + 1] - model->cumulative_moment[j] !=
            (hyst_q_sum_t)weight * model->radius[j]) {
            return HYST_STATUS_WEIGHT;
        }
    }
    return HYST_STATUS_OK;
}

static hyst_status_t check_knots(const hyst_q_model_t* model)
{
    const hyst_q_knot_t* knot = model->knot;
    const uint32_t last = model->num_knots - 1;
    if (model->num_knots < 2 || model->num_knots > HYST_MAX_KNOTS || knot[0].input != model->input_min ||
        knot[last].input != model->input_max) {
        return HYST_STATUS_KNOTS;
    }
    for (uint32_t k = 0; k < last; ++k) {
        if (knot[k].input >= knot[k + 1].input || knot[k].shift >= HYST_Q_BITS) {
            return HYST_STATUS_KNOTS;
        }
        const uint32_t width = (uint32_t)knot[k + 1].input - (uint32_t)knot[k].input;
        if (width > HYST_Q_WORD_MAX >> knot[k].shift || width << knot[k].shift <= HYST_Q_WORD_MAX / 2) {
            return HYST_STATUS_KNOTS;
        }
    }
    return HYST_STATUS_OK;
}

/// A slope rounded up by less than two units leads this much beyond the next value at most.
#define ROUNDED_UP 2U

/// Whether a curve does not decrease in a cell of this (shifted) width and its slope leads to the next value:
/// hyst_q_line then ends there, and its sum fits.
static bool fits(const uint32_t width, const uint32_t value, const uint32_t slope, const uint32_t next_value)
{
    const uint32_t rise = hyst_q_round((hyst_q_sum_t)slope * width);
    return value <= next_value && rise >= next_value - value && rise - (next_value - value) <= ROUNDED_UP;
}

/// ascending - r <= descending + r at this knot for the least radius, and so up to the next one: both lines
/// are rounded alike, so it is enough that the unrounded ones, at the end of the cell, are in order.
static bool is_ordered(const uint32_t width, const hyst_q_knot_t* knot, const uint32_t least_radius)
{
    const uint64_t high = (uint64_t)knot->descending + 2U * (uint64_t)least_radius;
    if (knot->ascending > high) {
        return false;
    }
    if (knot->ascending_slope <= knot->descending_slope) {
        return true;
    }
    const uint32_t excess = (uint32_t)(knot->ascending_slope - knot->descending_slope);
    const hyst_q_sum_t lead = (hyst_q_sum_t)excess * width;
    return ((lead + HYST_Q_WORD_MAX) >> HYST_Q_BITS) <= high - knot->ascending;
}

static hyst_status_t check_curves(const hyst_q_model_t* model)
{
    const hyst_q_knot_t* knot = model->knot;
    const uint32_t last = model->num_knots - 1;
    if (knot[0].nonhysteretic != 0 || knot[last].nonhysteretic > HYST_Q_WORD_MAX - ROUNDED_UP) {
        return HYST_STATUS_NONHYSTERETIC;
    }
    const uint32_t ascending = knot[last].ascending;
    const uint32_t descending = knot[last].descending;
    if (ascending > HYST_Q_STATE_MAX || descending > HYST_Q_STATE_MAX || knot[0].ascending >= ascending ||
        knot[0].descending >= descending) {
        return HYST_STATUS_ENVELOPE;
    }
    for (uint32_t k = 0; k < last; ++k) {
        const hyst_q_knot_t* next = &knot[k + 1];
        const uint32_t width = hyst_q_offset(&knot[k], next->input);
        if (!fits(width, knot[k].nonhysteretic, knot[k].nonhysteretic_slope, next->nonhysteretic)) {
            return HYST_STATUS_NONHYSTERETIC;
        }
        if (!fits(width, knot[k].ascending, knot[k].ascending_slope, next->ascending) ||
            !fits(width, knot[k].descending, knot[k].descending_slope, next->descending)) {
            return HYST_STATUS_ENVELOPE;
        }
        if (!is_ordered(width, &knot[k], model->radius[0])) {
            return HYST_STATUS_ENVELOPE_ORDER;
        }
    }
    const bool ends_ordered = ascending <= (uint64_t)descending + 2U * (uint64_t)model->radius[0];
    return ends_ordered ? HYST_STATUS_OK : HYST_STATUS_ENVELOPE_ORDER;
}

/// Every play keeps between its two saturations, so these must be states, and give outputs, that fit.
static hyst_status_t check_output(const hyst_q_model_t* model)
{
    const hyst_q_knot_t* last = &model->knot[model->num_knots - 1];
    const uint32_t bottom = model->knot[0].descending;
    const uint32_t widest = model->radius[model->num_plays - 1];
    if (widest > last->ascending || widest > HYST_Q_STATE_MAX - bottom) {
        return HYST_STATUS_RADIUS;
    }
    hyst_q_sum_t least = 0;
    hyst_q_sum_t most = 0;
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        const hyst_q_sum_t weight = (uint32_t)(model->cumulative_weight[j + 1] - model->cumulative_weight[j]);
        const uint32_t low = bottom + model->radius[j];
        const uint32_t high = last->ascending - model->radius[j];
        least += weight * (low < high ? low : high);
        most += weight * (low < high ? high : low);
    }
    const int64_t constant = model->constant;
    const int64_t reach = INT64_C(1) << 40;
    const bool fit =
        constant > -reach && constant < reach &&
        constant + (int64_t)hyst_q_round(least) >= HYST_Q_OUTPUT_MIN &&
        constant + (int64_t)last->nonhysteretic + (int64_t)hyst_q_round(most) <= HYST_Q_OUTPUT_MAX;
    return fit ? HYST_STATUS_OK : HYST_STATUS_OUTPUT_RANGE;
}

static hyst_status_t check_model(const hyst_q_model_t* model)
{
    hyst_status_t status = check_plays(model);
    if (status == HYST_STATUS_OK) {
        status = check_knots(model);
    }
    if (status == HYST_STATUS_OK) {
        status = check_curves(model);
    }
    return status == HYST_STATUS_OK ? check_output(model) : status;
}

hyst_status_t HYST_Q(init)(const hyst_q_model_t* model, hyst_q_state_t* state, hyst_q_segment_t* memory,
                           const size_t memory_length)
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
    state->segment = memory;
    state->clamped_inputs = 0;
    HYST_Q(saturate)(model, state, model->knot[0].descending, true);
    HYST_Q(place)(model, state, model->input_min);
    return HYST_STATUS_OK;
}
