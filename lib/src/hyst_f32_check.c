#include "hyst_f32_internal.h"

static hyst_status_t check_layout(const hyst_f32_model_t* model, const size_t memory_length)
{
    if (model->format != HYST_MODEL_FORMAT) {
        return HYST_STATUS_MODEL_FORMAT;
    }
    if (model->num_plays == 0 || model->num_plays > HYST_MAX_PLAYS) {
        return HYST_STATUS_PLAY_COUNT;
    }
    if (model->radius == NULL || model->weight == NULL || (model->num_knots != 0 && model->knot == NULL)) {
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

static hyst_status_t check_plays(const hyst_f32_model_t* model)
{
    float least = 0.0f;
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        if (!(model->radius[j] >= least && hyst_f32_is_finite(model->radius[j]))) {
            return HYST_STATUS_RADIUS;
        }
        least = model->radius[j];
    }
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        if (!(model->weight[j] >= 0.0f && hyst_f32_is_finite(model->weight[j]))) {
            return HYST_STATUS_WEIGHT;
        }
    }
    return HYST_STATUS_OK;
}

/// Whether a curve does not decrease in a cell of this width, and its slope leads from one value to the next
/// to within rounding: of either value to float, of the slope, the difference and the product, 8 u = 4
/// FLT_EPSILON at most; a slope that underflows is off by less than FLT_MIN.
static bool fits(const float width, const float value, const float slope, const float next_value)
{
    const float rise = next_value - value;
    const float allowance =
        4.0f * FLT_EPSILON * (hyst_f32_magnitude(value) + hyst_f32_magnitude(next_value)) + FLT_MIN * width;
    return hyst_f32_is_finite(rise) && rise >= 0.0f && hyst_f32_is_finite(slope) && slope >= 0.0f &&
           hyst_f32_magnitude(slope * width - rise) <= allowance;
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
        if (!is_ordered(&knot[k], model->radius[0])) {
            return HYST_STATUS_ENVELOPE_ORDER;
        }
    }
    return HYST_STATUS_OK;
}

/// Bounds every term and partial sum of every output in the order a step adds them; rounding is monotone, so
/// what is finite here is finite there. Twice the bound must be finite too, since the inverse subtracts two
/// outputs.
static hyst_status_t check_output(const hyst_f32_model_t* model)
{
    const float bound = hyst_f32_envelope_bound(model);
    float sum = 0.0f;
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j] * (bound + model->radius[j]);
    }
    const uint32_t last_cell = model->num_knots == 0 ? 0 : model->num_knots - 2;
    const float low = hyst_f32_nonhysteretic(model, 0, model->input_min);
    const float high = hyst_f32_nonhysteretic(model, last_cell, model->input_max);
    const float offset = hyst_f32_magnitude(model->constant) +
                         hyst_f32_larger(hyst_f32_magnitude(low), hyst_f32_magnitude(high));
    // A radius whose push overflows would hide behind a weight of 0.
    const float reach = bound + 2.0f * model->radius[model->num_plays - 1];
    return hyst_f32_is_finite(2.0f * (offset + sum)) && hyst_f32_is_finite(2.0f * reach)
               ? HYST_STATUS_OK
               : HYST_STATUS_OUTPUT_RANGE;
}

static hyst_status_t check_model(const hyst_f32_model_t* model)
{
    hyst_status_t status = check_range(model);
    if (status == HYST_STATUS_OK) {
        status = check_plays(model);
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

hyst_status_t hyst_f32_init(const hyst_f32_model_t* model, hyst_f32_state_t* state, float* memory,
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
    state->memory = memory;
    state->invalid_inputs = 0;
    state->clamped_inputs = 0;
    hyst_f32_saturate_negative(model, state);
    return HYST_STATUS_OK;
}
