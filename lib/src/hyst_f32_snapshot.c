#include "hyst_f32_internal.h"

/// How far rounding may take a play's state, in units of the largest envelope plus its radius; u =
/// FLT_EPSILON / 2. A state is a rounded push of a computed envelope. Strip: an envelope in a cell is off by
/// 7 u (slope, difference and product 2 u each, since a cell rises by at most twice the bound; sum 1 u), a
/// push adds 1 u, and the order of the envelopes is checked to within 4 u: 2 (7 + 1) + 4 = 20 u. Neighbours:
/// one push each after steps, one interpolation of 18 u each after demagnetising: 36 u. 20 FLT_EPSILON = 40 u
/// covers both.
#define ROUNDING (20.0f * FLT_EPSILON)

hyst_status_t hyst_f32_save(const hyst_f32_model_t* model, const hyst_f32_state_t* state, float* snapshot,
                            const size_t length)
{
    if (model == NULL || state == NULL || snapshot == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    if (length < (size_t)model->num_plays + 1) {
        return HYST_STATUS_MEMORY_LENGTH;
    }
    snapshot[0] = state->input;
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        snapshot[j + 1] = state->memory[j];
    }
    return HYST_STATUS_OK;
}

/// Whether the model can have plays in states w after input v.
static bool is_possible(const hyst_f32_model_t* model, const float v, const float* w)
{
    if (!(v >= model->input_min && v <= model->input_max)) {
        return false;
    }
    const uint32_t cell = hyst_f32_find_cell(model, 0, v);
    const float ascending = hyst_f32_envelope(model, cell, v, true);
    const float descending = hyst_f32_envelope(model, cell, v, false);
    const float bound = hyst_f32_envelope_bound(model);
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        const float radius = model->radius[j];
        const float allowance = ROUNDING * (bound + radius);
        const float low = hyst_f32_pushed(ascending, radius, true) - allowance;
        const float high = hyst_f32_pushed(descending, radius, false) + allowance;
        if (!(w[j] >= low && w[j] <= high)) {
            return false;
        }
        if (j > 0 && hyst_f32_magnitude(w[j] - w[j - 1]) > (radius - model->radius[j - 1]) + allowance) {
            return false;
        }
    }
    return true;
}

hyst_status_t hyst_f32_restore(const hyst_f32_model_t* model, hyst_f32_state_t* state, const float* snapshot,
                               const size_t length)
{
    if (model == NULL || state == NULL || snapshot == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    if (length < (size_t)model->num_plays + 1) {
        return HYST_STATUS_MEMORY_LENGTH;
    }
    if (!is_possible(model, snapshot[0], &snapshot[1])) {
        return HYST_STATUS_SNAPSHOT;
    }
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        state->memory[j] = snapshot[j + 1];
    }
    hyst_f32_place(model, state, snapshot[0]);
    return HYST_STATUS_OK;
}
