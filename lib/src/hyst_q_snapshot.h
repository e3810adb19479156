#include "hyst_q_internal.h"

static hyst_status_t check_arguments(const hyst_q_model_t* model, const hyst_q_state_t* state,
                                     const hyst_q_word_t* snapshot, const size_t length)
{
    if (model == NULL || state == NULL || snapshot == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    return length < (size_t)model->num_plays + 1 ? HYST_STATUS_MEMORY_LENGTH : HYST_STATUS_OK;
}

hyst_status_t HYST_Q(save)(const hyst_q_model_t* model, const hyst_q_state_t* state, hyst_q_word_t* snapshot,
                           const size_t length)
{
    const hyst_status_t status = check_arguments(model, state, snapshot, length);
    if (status != HYST_STATUS_OK) {
        return status;
    }
    uint32_t segment = state->num_segments - 1;
    for (uint32_t i = 0; i <= model->num_plays; ++i) {
        snapshot[i] = (hyst_q_word_t)hyst_q_saved_number(model, state, i, &segment);
    }
    return HYST_STATUS_OK;
}

/// Whether w lies in the play's strip at the present envelopes, and between its two saturations.
static bool is_in_reach(const hyst_q_model_t* model, const uint64_t ascending, const uint64_t descending,
                        const uint32_t radius, const uint32_t w)
{
    const uint32_t negative = model->knot[0].descending + radius;
    const uint32_t positive = model->knot[model->num_knots - 1].ascending - radius;
    const uint32_t low = negative < positive ? negative : positive;
    const uint32_t high = negative < positive ? positive : negative;
    return (uint64_t)w + radius >= ascending && w <= descending + radius && w >= low && w <= high;
}

/// Whether the model can have plays in the saved states after input v.
static bool is_possible(const hyst_q_model_t* model, const hyst_q_value_t v, const hyst_q_numbers_t* saved)
{
    const uint32_t cell = HYST_Q(find_cell)(model, 0, v);
    const uint32_t ascending = hyst_q_envelope(model, cell, v, true);
    const uint32_t descending = hyst_q_envelope(model, cell, v, false);
    uint32_t inner_w = 0;
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        const uint32_t radius = model->radius[j];
        const uint32_t w = hyst_q_number(saved, j + 1);
        if (!is_in_reach(model, ascending, descending, radius, w)) {
            return false;
        }
        if (j > 0 && (w < inner_w ? inner_w - w : w - inner_w) > radius - model->radius[j - 1]) {
            return false;
        }
        inner_w = w;
    }
    return true;
}

hyst_status_t HYST_Q(restore_numbers)(const hyst_q_model_t* model, hyst_q_state_t* state,
                                      const hyst_q_numbers_t* saved)
{
    const uint32_t distance = hyst_q_number(saved, 0);
    if (distance > (uint32_t)model->input_max - (uint32_t)model->input_min) {
        return HYST_STATUS_SNAPSHOT;
    }
    const hyst_q_value_t input = hyst_q_input_above(model, distance);
    if (!is_possible(model, input, saved)) {
        return HYST_STATUS_SNAPSHOT;
    }
    for (uint32_t j = model->num_plays; j-- > 0;) {
        HYST_Q(stack_play)(model, state, j, hyst_q_number(saved, j + 1), hyst_q_number(saved, j));
    }
    HYST_Q(place)(model, state, input);
    return HYST_STATUS_OK;
}

hyst_status_t HYST_Q(restore)(const hyst_q_model_t* model, hyst_q_state_t* state,
                              const hyst_q_word_t* snapshot, const size_t length)
{
    const hyst_status_t status = check_arguments(model, state, snapshot, length);
    if (status != HYST_STATUS_OK) {
        return status;
    }
    const hyst_q_numbers_t saved = {snapshot, NULL};
    return HYST_Q(restore_numbers)(model, state, &saved);
}
