#include "hyst_f32_segments.h"

/// How far rounding may take a play's state, in units of the largest envelope plus its radius; u =
/// FLT_EPSILON / 2. A state is a rounded push of a computed envelope. Strip: an envelope in a cell is off by
/// 7 u (slope, difference and product 2 u each, since a cell rises by at most twice the bound; sum 1 u), a
/// push adds 1 u, and the order of the envelopes is checked to within 4 u: 2 (7 + 1) + 4 = 20 u. Neighbours:
/// one push each after steps, one interpolation of 18 u each after demagnetising: 36 u. 20 FLT_EPSILON = 40 u
/// covers both.
#define ROUNDING (20.0f * FLT_EPSILON)

/// Places in a snapshot.
enum { INPUT, PLAYS, COUNT, SEGMENTS };

hyst_status_t hyst_f32_save(const hyst_f32_model_t* model, const hyst_f32_state_t* state, float* snapshot,
                            const size_t length)
{
    if (model == NULL || state == NULL || snapshot == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    const size_t needed = HYST_F32_SNAPSHOT_LENGTH((size_t)model->num_plays);
    if (length < needed) {
        return HYST_STATUS_MEMORY_LENGTH;
    }
    snapshot[INPUT] = state->input;
    snapshot[PLAYS] = state->plays;
    snapshot[COUNT] = (float)(state->front + 1);
    size_t end = SEGMENTS;
    for (uint32_t i = 0; i <= state->front; ++i) {
        const hyst_f32_segment_t* segment = &state->memory[i];
        const float num_plays = (float)(segment->last + 1);
        snapshot[end++] = segment->level;
        snapshot[end++] = segment->rising != 0 ? num_plays : -num_plays;
    }
    for (; end < needed; ++end) {
        snapshot[end] = 0.0f;
    }
    return HYST_STATUS_OK;
}

/// The count that x stands for, 1 ... most; 0 if it is none.
static uint32_t count_of(const float x, const uint32_t most)
{
    if (!(x >= 1.0f && x <= (float)most)) {
        return 0;
    }
    const uint32_t count = (uint32_t)x;
    return (float)count < x ? 0 : count;
}

/// A segment as saved, without its sums; `last` is UINT16_MAX where the snapshot holds no segment.
static hyst_f32_segment_t segment_at(const hyst_f32_model_t* model, const float* snapshot,
                                     const uint32_t index)
{
    const float code = snapshot[SEGMENTS + 2 * index + 1];
    const uint32_t count = count_of(hyst_f32_magnitude(code), model->num_plays);
    const hyst_f32_segment_t segment = {.level = snapshot[SEGMENTS + 2 * index],
                                        .sum = {0.0f, 0.0f},
                                        .last = count == 0 ? UINT16_MAX : (uint16_t)(count - 1),
                                        .rising = code > 0.0f};
    return segment;
}

/// The state of a play of the segment.
static float play_of(const hyst_f32_model_t* model, const hyst_f32_segment_t* segment, const uint32_t play)
{
    return hyst_f32_sign(segment->rising != 0) * (segment->level - 0.5f * model->play[play].opening);
}

/// Both envelopes at an input, and the rounding of a play's state without its radius.
typedef struct {
    float ascending, descending, bound;
} strip_t;

/// Whether plays first ... last of the segment can be where they are. Of a segment left by a rising input all
/// are in reach of the falling one when the first is, and the other way round.
static bool is_in_strip(const hyst_f32_model_t* model, const strip_t* strip,
                        const hyst_f32_segment_t* segment, const uint32_t first)
{
    const float radius = 0.5f * model->play[first].opening;
    const float allowance = ROUNDING * (strip->bound + radius);
    const float w = play_of(model, segment, first);
    return w >= hyst_f32_pushed(strip->ascending, radius, true) - allowance &&
           w <= hyst_f32_pushed(strip->descending, radius, false) + allowance;
}

/// Whether the segments nest, from all plays outermost to at least one, with each play in its strip and no
/// further from the next one than their radii are apart.
static bool is_possible(const hyst_f32_model_t* model, const float* snapshot, const uint32_t count)
{
    const float v = snapshot[INPUT];
    if (!(v >= model->input_min && v <= model->input_max)) {
        return false;
    }
    const uint32_t cell = hyst_f32_find_cell(model, 0, hyst_f32_last_cell(model), v);
    const strip_t strip = {hyst_f32_envelope(model, cell, v, true), hyst_f32_envelope(model, cell, v, false),
                           hyst_f32_envelope_bound(model)};
    hyst_f32_segment_t segment = segment_at(model, snapshot, 0);
    bool possible = segment.last == model->num_plays - 1;
    for (uint32_t i = 0; possible && i + 1 < count; ++i) {
        const hyst_f32_segment_t inner = segment_at(model, snapshot, i + 1);
        if (inner.last >= segment.last) {
            return false;
        }
        const uint32_t first = inner.last + 1u;
        const float radius = 0.5f * model->play[first].opening;
        const float apart =
            hyst_f32_magnitude(play_of(model, &segment, first) - play_of(model, &inner, inner.last));
        possible =
            is_in_strip(model, &strip, &segment, first) &&
            apart <= radius - 0.5f * model->play[inner.last].opening + ROUNDING * (strip.bound + radius);
        segment = inner;
    }
    return possible && is_in_strip(model, &strip, &segment, 0);
}

/// sum p_j r_j over plays 0 ... last: the loading curve at the opening is slope opening - 2 of it.
static float moment_of(const hyst_f32_play_t* play)
{
    return 0.5f * (play->slope * play->opening - play->loading);
}

/// Whether `plays` is the sum of the plays' parts, to within rounding: of each segment's contribution 8 u, of
/// the table N + 4 u (init), of the state's sums 8 u for each segment further out; N segments at most.
static bool is_their_sum(const hyst_f32_model_t* model, const float* snapshot, const uint32_t count)
{
    const hyst_f32_play_t* play = model->play;
    const hyst_f32_play_t* widest = &play[model->num_plays - 1];
    float sum = 0.0f;
    for (uint32_t i = 0; i < count; ++i) {
        const hyst_f32_segment_t segment = segment_at(model, snapshot, i);
        const hyst_f32_play_t* last = &play[segment.last];
        float slope = last->slope;
        float moment = moment_of(last);
        if (i + 1 < count) {
            const hyst_f32_play_t* inner = &play[segment_at(model, snapshot, i + 1).last];
            slope -= inner->slope;
            moment -= moment_of(inner);
        }
        sum += hyst_f32_sign(segment.rising != 0) * (segment.level * slope - moment);
    }
    const float reach = hyst_f32_envelope_bound(model) + widest->opening;
    const float allowance =
        FLT_EPSILON * (float)(16 * model->num_plays + 16) * widest->slope * reach + FLT_MIN;
    return hyst_f32_magnitude(snapshot[PLAYS] - sum) <= allowance;
}

hyst_status_t hyst_f32_restore(const hyst_f32_model_t* model, hyst_f32_state_t* state, const float* snapshot,
                               const size_t length)
{
    if (model == NULL || state == NULL || snapshot == NULL) {
        return HYST_STATUS_NULL_POINTER;
    }
    if (length < HYST_F32_SNAPSHOT_LENGTH((size_t)model->num_plays)) {
        return HYST_STATUS_MEMORY_LENGTH;
    }
    const uint32_t count = count_of(snapshot[COUNT], model->num_plays);
    if (count == 0 || !is_possible(model, snapshot, count) || !is_their_sum(model, snapshot, count)) {
        return HYST_STATUS_SNAPSHOT;
    }
    for (uint32_t i = 0; i < count; ++i) {
        state->memory[i] = segment_at(model, snapshot, i);
    }
    state->front = count - 1;
    hyst_f32_sum_up(model, state->memory, state->front);
    state->plays = snapshot[PLAYS];
    hyst_f32_place(model, state, snapshot[INPUT]);
    return HYST_STATUS_OK;
}
