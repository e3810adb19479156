#include "q_model.h"
#include "output_range.h"
#include <stdio.h>
#include <stdlib.h>

static bool is_q31(const q_model_t* q)
{
    return q->quantized.bits == QUANTIZED_Q31;
}

q_model_t q_new(const model_t* model, quantized_bits_t bits, double table_error)
{
    q_model_t q = {0};
    const char* fault = quantize(model, bits, table_error, &q.quantized);
    if (fault != NULL) {
        fprintf(stderr, "q_new: %s\n", fault);
        exit(EXIT_FAILURE);
    }
    if (bits == QUANTIZED_Q15) {
        q.narrowed = narrowed_new(&q.quantized);
    }
    q.memory31 = xcalloc(model->num_plays, sizeof *q.memory31);
    q.memory15 = xcalloc(model->num_plays, sizeof *q.memory15);
    q.reference = xcalloc(model->num_plays, sizeof *q.reference);
    const hyst_status_t status = q_init(&q, model->num_plays);
    if (status != HYST_STATUS_OK) {
        fprintf(stderr, "q_new: %s\n", hyst_status_text(status));
        exit(EXIT_FAILURE);
    }
    q_reference_start(&q, HYST_START_NEGATIVE_SATURATION);
    return q;
}

void q_free(q_model_t* q)
{
    quantized_free(&q->quantized);
    narrowed_free(&q->narrowed);
    free(q->memory31);
    free(q->memory15);
    free(q->reference);
    *q = (q_model_t){0};
}

double q_random_table_error(random_t* random, const model_t* model)
{
    const double range = model_output_max(model) - model_output_min(model);
    const double scale = range > 0.0 ? range : 1.0;
    return scale * pow(10.0, random_uniform(random, -3.0, -1.0));
}

hyst_status_t q_init(q_model_t* q, size_t memory_length)
{
    return is_q31(q) ? hyst_q31_init(&q->quantized.model, &q->state31, q->memory31, memory_length)
                     : hyst_q15_init(&q->narrowed.model, &q->state15, q->memory15, memory_length);
}

int32_t q_step(q_model_t* q, int32_t input)
{
    return is_q31(q) ? hyst_q31_step(&q->quantized.model, &q->state31, input)
                     : hyst_q15_step(&q->narrowed.model, &q->state15, (int16_t)input);
}

int32_t q_reset(q_model_t* q, hyst_start_t start, int32_t input)
{
    return is_q31(q) ? hyst_q31_reset(&q->quantized.model, &q->state31, start, input)
                     : hyst_q15_reset(&q->narrowed.model, &q->state15, start, (int16_t)input);
}

q_inverse_t q_inverse(const q_model_t* q, int32_t wanted)
{
    if (is_q31(q)) {
        const hyst_q31_inverse_t found = hyst_q31_inverse(&q->quantized.model, &q->state31, wanted);
        return (q_inverse_t){found.input, found.clamped};
    }
    const hyst_q15_inverse_t found = hyst_q15_inverse(&q->narrowed.model, &q->state15, (int16_t)wanted);
    return (q_inverse_t){found.input, found.clamped};
}

q_reach_t q_reachable(const q_model_t* q)
{
    if (is_q31(q)) {
        const hyst_q31_reach_t reach = hyst_q31_reachable(&q->quantized.model, &q->state31);
        return (q_reach_t){reach.reachable_min, reach.reachable_max};
    }
    const hyst_q15_reach_t reach = hyst_q15_reachable(&q->narrowed.model, &q->state15);
    return (q_reach_t){reach.reachable_min, reach.reachable_max};
}

hyst_status_t q_save(const q_model_t* q, uint32_t* snapshot, size_t length)
{
    if (is_q31(q)) {
        return hyst_q31_save(&q->quantized.model, &q->state31, snapshot, length);
    }
    uint16_t* narrow = xcalloc(length + 1, sizeof *narrow);
    const hyst_status_t status = hyst_q15_save(&q->narrowed.model, &q->state15, narrow, length);
    for (size_t i = 0; status == HYST_STATUS_OK && i < length; ++i) {
        snapshot[i] = narrow[i];
    }
    free(narrow);
    return status;
}

hyst_status_t q_restore(q_model_t* q, const uint32_t* snapshot, size_t length)
{
    if (is_q31(q)) {
        return hyst_q31_restore(&q->quantized.model, &q->state31, snapshot, length);
    }
    uint16_t* narrow = xcalloc(length + 1, sizeof *narrow);
    for (size_t i = 0; i < length; ++i) {
        narrow[i] = (uint16_t)snapshot[i];
    }
    const hyst_status_t status = hyst_q15_restore(&q->narrowed.model, &q->state15, narrow, length);
    free(narrow);
    return status;
}

int32_t q_present_input(const q_model_t* q)
{
    return is_q31(q) ? q->state31.input : q->state15.input;
}

uint32_t q_clamped_inputs(const q_model_t* q)
{
    return is_q31(q) ? q->state31.clamped_inputs : q->state15.clamped_inputs;
}

int32_t q_value_max(const q_model_t* q)
{
    return is_q31(q) ? INT32_MAX : INT16_MAX;
}

int32_t q_value_min(const q_model_t* q)
{
    return is_q31(q) ? INT32_MIN : INT16_MIN;
}

static int32_t limited(const q_model_t* q, int64_t input)
{
    const int64_t low = q->quantized.model.input_min;
    const int64_t high = q->quantized.model.input_max;
    return (int32_t)(input < low ? low : input > high ? high : input);
}

int32_t q_random_input(random_t* random, const q_model_t* q, int32_t last)
{
    const hyst_q31_model_t* model = &q->quantized.model;
    const int64_t width = (int64_t)model->input_max - model->input_min;
    switch (random_below(random, 16)) {
    case 0:
        return model->input_min;
    case 1:
        return model->input_max;
    case 2:
        return limited(q, (int64_t)model->knot[random_below(random, model->num_knots)].input - 1 +
                              (int64_t)random_below(random, 3));
    case 3:
        return random_below(random, 8) == 0   ? q_value_max(q)
               : random_below(random, 7) == 0 ? q_value_min(q)
                                              : last;
    case 4:
    case 5:
    case 6:
        return limited(q, (int64_t)model->input_min + (int64_t)random_below(random, (size_t)width + 1));
    default:
        break;
    }
    const double step = pow((double)width, random_uniform(random, 0.0, 1.0));
    return limited(q, last + (int64_t)(random_below(random, 2) == 0 ? step : -step));
}

int32_t q_from_units(const q_model_t* q, double input)
{
    return limited(q, nearest_integer((input - q->quantized.input_offset) / q->quantized.input_scale));
}

double q_to_units(const q_model_t* q, int32_t output)
{
    return q->quantized.output_offset + q->quantized.output_scale * (double)output;
}

/// x / 2^bits, half up.
static int64_t rounded(const q_model_t* q, uint64_t x)
{
    const unsigned bits = (unsigned)q->quantized.bits;
    return (int64_t)(x >> bits) + (int64_t)((x >> (bits - 1)) & 1U);
}

/// The curve at v, in the last cell that begins at or before it.
static int64_t curve_at(const q_model_t* q, int64_t v, const uint32_t* value, const uint32_t* slope)
{
    const hyst_q31_knot_t* knot = q->quantized.knot;
    const size_t stride = sizeof *knot / sizeof *value;
    size_t k = 0;
    for (size_t step = (HYST_MAX_KNOTS + 1) / 2; step > 0; step /= 2) {
        if (k + step + 1 < q->quantized.model.num_knots && v >= knot[k + step].input) {
            k += step;
        }
    }
    const uint64_t behind = (uint64_t)(v - knot[k].input) << knot[k].shift;
    const int64_t y = value[k * stride] + rounded(q, (uint64_t)slope[k * stride] * behind);
    const int64_t next = value[(k + 1) * stride];
    return y < next ? y : next;
}

/// The state of play j after an input v: the strip's form of Eq. (6), which needs no direction.
static int64_t play_at(const q_model_t* q, size_t j, int64_t ascending, int64_t descending)
{
    const int64_t radius = q->quantized.radius[j];
    const int64_t w = (int64_t)q->reference[j];
    const int64_t fallen = w < descending + radius ? w : descending + radius;
    return fallen > ascending - radius ? fallen : ascending - radius;
}

static int64_t ascending_at(const q_model_t* q, int64_t v)
{
    return curve_at(q, v, &q->quantized.knot->ascending, &q->quantized.knot->ascending_slope);
}

static int64_t descending_at(const q_model_t* q, int64_t v)
{
    return curve_at(q, v, &q->quantized.knot->descending, &q->quantized.knot->descending_slope);
}

static void reference_move(q_model_t* q, int64_t v)
{
    const int64_t ascending = ascending_at(q, v);
    const int64_t descending = descending_at(q, v);
    for (size_t j = 0; j < q->quantized.model.num_plays; ++j) {
        q->reference[j] = (uint64_t)play_at(q, j, ascending, descending);
    }
    q->reference_input = v;
}

void q_reference_start(q_model_t* q, hyst_start_t start)
{
    const hyst_q31_model_t* model = &q->quantized.model;
    const int64_t ascending = ascending_at(q, model->input_max);
    const int64_t descending = descending_at(q, model->input_min);
    const bool positive = start == HYST_START_POSITIVE_SATURATION;
    for (size_t j = 0; j < model->num_plays; ++j) {
        const int64_t radius = q->quantized.radius[j];
        q->reference[j] = (uint64_t)(positive ? ascending - radius : descending + radius);
    }
    q->reference_input = positive ? model->input_max : model->input_min;
    if (start != HYST_START_DEMAGNETISED) {
        return;
    }
    const int64_t half = ((int64_t)model->input_max - model->input_min) / 2;
    const int64_t middle = model->input_min + half;
    const int64_t top = ascending_at(q, middle + half);
    const int64_t bottom = descending_at(q, middle - half);
    for (size_t j = 0; j < model->num_plays; ++j) {
        // What the full alternation does not move: the middle of its strip, as documented.
        if (top - bottom < 2 * (int64_t)q->quantized.radius[j]) {
            q->reference[j] = (uint64_t)((top + bottom) / 2);
        }
    }
    for (int64_t amplitude = half; amplitude >= 0; --amplitude) {
        reference_move(q, middle - amplitude);
        reference_move(q, middle + amplitude);
    }
}

int32_t q_reference_look(const q_model_t* q, int32_t input)
{
    const int64_t v = limited(q, input);
    const int64_t ascending = ascending_at(q, v);
    const int64_t descending = descending_at(q, v);
    uint64_t sum = 0;
    for (size_t j = 0; j < q->quantized.model.num_plays; ++j) {
        const uint64_t weight = q->quantized.cumulative_weight[j + 1] - q->quantized.cumulative_weight[j];
        sum += weight * (uint64_t)play_at(q, j, ascending, descending);
    }
    const int64_t nonhysteretic =
        curve_at(q, v, &q->quantized.knot->nonhysteretic, &q->quantized.knot->nonhysteretic_slope);
    return (int32_t)(q->quantized.model.constant + nonhysteretic + rounded(q, sum));
}

int32_t q_reference_step(q_model_t* q, int32_t input)
{
    const int32_t output = q_reference_look(q, input);
    reference_move(q, limited(q, input));
    return output;
}
