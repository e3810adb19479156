#include "hyst_q_internal.h"

/// Where an alternation of a given amplitude about the middle of the range takes the envelopes.
typedef struct {
    uint32_t top;    ///< ascending, at the middle + amplitude
    uint32_t bottom; ///< descending, at the middle - amplitude
} span_t;

static span_t span_at(const hyst_q_model_t* model, const uint32_t amplitude)
{
    const hyst_q_value_t above = hyst_q_input_above(model, hyst_q_half_range(model) + amplitude);
    const hyst_q_value_t below = hyst_q_input_above(model, hyst_q_half_range(model) - amplitude);
    const span_t span = {hyst_q_envelope(model, HYST_Q(find_cell)(model, 0, above), above, true),
                         hyst_q_envelope(model, HYST_Q(find_cell)(model, 0, below), below, false)};
    return span;
}

/// Whether the alternation moves a play both ways.
static bool swings(const span_t span, const uint32_t radius)
{
    return span.top >= span.bottom && span.top - span.bottom >= 2U * radius;
}

/// The least amplitude that moves the play both ways, at most `high`, which does.
static uint32_t least_swing(const hyst_q_model_t* model, const uint32_t radius, uint32_t high)
{
    uint32_t low = 0;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (swings(span_at(model, middle), radius)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

/// The state in which an alternation leaves a play whose amplitude shrinks from half the range to 0 in steps
/// of one unit: the last amplitude that moves it both ways ends with a rise, the next smaller one may still
/// push it down. A play that the full range does not move gets the middle of its strip there.
static uint32_t demagnetised(const hyst_q_model_t* model, const uint32_t radius)
{
    const uint32_t half = hyst_q_half_range(model);
    const span_t full = span_at(model, half);
    if (!swings(full, radius)) {
        return full.bottom / 2 + full.top / 2 + (full.bottom & full.top & 1U);
    }
    const uint32_t amplitude = least_swing(model, radius, half);
    const uint32_t risen = span_at(model, amplitude).top - radius;
    if (amplitude == 0) {
        return risen;
    }
    const uint32_t fallen = span_at(model, amplitude - 1).bottom + radius;
    return fallen < risen ? fallen : risen;
}

static void demagnetise(const hyst_q_model_t* model, hyst_q_state_t* state)
{
    uint32_t w = demagnetised(model, model->radius[model->num_plays - 1]);
    for (uint32_t j = model->num_plays; j-- > 0;) {
        const uint32_t inner_w = j > 0 ? demagnetised(model, model->radius[j - 1]) : 0;
        HYST_Q(stack_play)(model, state, j, w, inner_w);
        w = inner_w;
    }
    HYST_Q(place)(model, state, hyst_q_input_above(model, hyst_q_half_range(model)));
}

hyst_q_value_t HYST_Q(reset)(const hyst_q_model_t* model, hyst_q_state_t* state, const hyst_start_t start,
                             const hyst_q_value_t input)
{
    switch (start) {
    case HYST_START_POSITIVE_SATURATION:
        HYST_Q(saturate)(model, state, model->knot[model->num_knots - 1].ascending, false);
        HYST_Q(place)(model, state, model->input_max);
        break;
    case HYST_START_DEMAGNETISED:
        demagnetise(model, state);
        break;
    case HYST_START_NEGATIVE_SATURATION:
    default:
        HYST_Q(saturate)(model, state, model->knot[0].descending, true);
        HYST_Q(place)(model, state, model->input_min);
        break;
    }
    return HYST_Q(step)(model, state, input);
}
