/// The inverse's view of the memory: which plays an envelope has moved once it has come to a level. Included
/// by hyst_q_inverse.h alone.
#ifndef HYST_Q_PIECES_H
#define HYST_Q_PIECES_H

#include "hyst_q_internal.h"

/// A search away from the present input for the nearest one whose output reaches `wanted`. Outputs do not
/// decrease with the input, so that input lies at a boundary: it reaches, its nearer neighbour falls short.
typedef struct {
    const hyst_q_model_t* model;
    const hyst_q_state_t* state;
    hyst_q_value_t wanted;
    bool rising;
    bool clamped; ///< the output asked for is out of reach: `wanted` is the last one within
} search_t;

/// The levels over which a push moves the plays before `end` and leaves `num_kept` segments at the stack's
/// bottom: from `start` to `limit`, away from the present. sum p_j w_j is rest + weight * level.
typedef struct {
    hyst_q_sum_t rest;
    uint32_t weight;
    uint32_t num_kept;
    uint32_t end;
    uint32_t start;
    uint32_t limit;
} piece_t;

static inline bool is_beyond(const search_t* search, const uint32_t level, const uint32_t other)
{
    return search->rising ? level > other : level < other;
}

/// The level beyond which play `end` moves, too.
static inline uint32_t limit_of(const search_t* search, const uint32_t num_kept, const uint32_t end)
{
    if (num_kept == 0) {
        return search->rising ? UINT32_MAX : 0;
    }
    const hyst_q_segment_t* segment = &search->state->segment[num_kept - 1];
    const uint32_t across = 2U * search->model->radius[end];
    if (search->rising) {
        return segment->falling ? segment->level + across : segment->level;
    }
    // Below 0 for a play that cannot be moved.
    return segment->falling ? segment->level : segment->level > across ? segment->level - across : 0;
}

/// The first piece: with it also the levels before its start, which move nothing.
static inline piece_t present_piece(const search_t* search)
{
    const hyst_q_state_t* state = search->state;
    const hyst_q_segment_t* top = &state->segment[state->num_segments - 1];
    piece_t piece;
    if ((top->falling == 0) == search->rising) {
        piece.rest = top->rest;
        piece.end = top->end;
        piece.num_kept = state->num_segments - 1;
        piece.start = top->level;
    } else {
        piece.rest = state->sum;
        piece.end = 0;
        piece.num_kept = state->num_segments;
        piece.start = search->rising ? 0 : UINT32_MAX;
    }
    piece.weight = search->model->cumulative_weight[piece.end];
    piece.limit = limit_of(search, piece.num_kept, piece.end);
    return piece;
}

/// Takes the next plays into the piece: those of a segment pushed in the direction of the search all at once,
/// others one by one.
static inline void take_next(const search_t* search, piece_t* piece)
{
    const hyst_q_segment_t* next = &search->state->segment[piece->num_kept - 1];
    const uint32_t end = (next->falling == 0) == search->rising ? next->end : piece->end + 1;
    const uint32_t weight = search->model->cumulative_weight[end];
    piece->rest -= hyst_q_product(weight - piece->weight, piece->limit);
    piece->weight = weight;
    piece->end = end;
    piece->num_kept -= end == next->end ? 1U : 0U;
    piece->start = piece->limit;
    piece->limit = limit_of(search, piece->num_kept, end);
}

static inline hyst_q_sum_t sum_at(const search_t* search, const piece_t* piece, const uint32_t level)
{
    const uint32_t reached = is_beyond(search, piece->start, level) ? piece->start : level;
    return piece->rest + hyst_q_product(piece->weight, reached);
}

/// The first of the segment's plays.
static inline uint32_t first_play(const search_t* search, const uint32_t segment)
{
    const hyst_q_state_t* state = search->state;
    return segment + 1 < state->num_segments ? state->segment[segment + 1].end : 0;
}

/// The segment that play j is in.
static uint32_t segment_of(const search_t* search, const uint32_t num_kept, const uint32_t j)
{
    return num_kept > 0 && j >= first_play(search, num_kept - 1) ? num_kept - 1 : num_kept;
}

static piece_t piece_of(const search_t* search, const uint32_t num_kept, const uint32_t end)
{
    const hyst_q_model_t* model = search->model;
    const hyst_q_front_t front = HYST_Q(front_at)(model, search->state, num_kept, end);
    piece_t piece;
    piece.rest = search->rising ? front.below - model->cumulative_moment[end]
                                : front.below + model->cumulative_moment[end];
    piece.weight = model->cumulative_weight[end];
    piece.num_kept = num_kept;
    piece.end = end;
    piece.start = search->rising ? 0 : UINT32_MAX;
    if (end > 0) {
        piece.start = limit_of(search, segment_of(search, num_kept, end - 1) + 1, end - 1);
    }
    piece.limit = limit_of(search, num_kept, end);
    return piece;
}

/// The piece before, for one that has plays.
static piece_t piece_before(const search_t* search, const piece_t* piece)
{
    const uint32_t index = segment_of(search, piece->num_kept, piece->end - 1);
    const hyst_q_segment_t* segment = &search->state->segment[index];
    const bool is_along = (segment->falling == 0) == search->rising;
    return piece_of(search, index + 1, is_along ? first_play(search, index) : piece->end - 1);
}

#endif
