/// The memory as nested segments: what a sample costs does not grow with the number of plays.
///
/// LAYOUT
///   Flash, one entry a play, sorted by radius (hyst_f32_play_t):
///     opening_j = 2 r_j              how far the envelope must come back before play j moves
///     slope_j   = p_0 + ... + p_j    slope of the plays' sum over the envelope while plays 0 ... j move
///     loading_j = sum_{i<j} p_i (opening_j - opening_i)   the loading curve L at opening_j
///   and the moment Q = sum_j p_j r_j in the model. The loading curve L(x) = sum_j p_j max(0, x - opening_j)
///   is convex and piecewise linear: L(x) = loading_j + slope_j (x - opening_j) for opening_j < x <=
///   opening_{j+1}. RAM, a stack of segments, segment[0] outermost, segment[depth - 1] the front
///   (hyst_f32_segment_t, 16 bytes). Segment i holds plays (last_{i+1}, last_i], all left by one extreme
///   `level` of the envelope:
///     w_j = level - r_j when it was left by a rising input, -(level - r_j) by a falling one.
///   Every segment holds a play, so last_0 = N - 1 > last_1 > ... and N segments are enough.
///   Neighbours may have the same direction: an extreme whose plays were all taken is gone.
///
/// WHAT A MOVE DOES (rising; falling is the mirror image, written with sign = -1)
///   The envelope rises to a. Segment i is `taken`, all its plays move, when
///     it is ascending:  a - level_i >= 0             it is descending: a - level_i > opening_{last_i}.
///   If a segment is taken, all further in are taken too, so the ones kept are found by halving. Of the
///   innermost kept segment k, when it is descending, plays j with opening_j < a - level_k move; when it is
///   ascending, none. The moved plays become the front: level a, last = the last one moved, everything
///   further in is forgotten.
///
/// THE SUM
///   sum_i[direction] is the sum of all p_j w_j when an input moving in that direction has just taken segment
///   i. Over segment k, kept innermost, x = a - level_k:
///     ascending:  S = sum_k[rising] + slope_last x                            (x <= 0, plays 0 ... last move
///     along) descending: S = sum_k[rising] - (loading_{last_k} - L(x)) none kept:  S = a slope_{N-1} - Q
///   An ascending front's sum[rising] is S itself. Its sum[falling] is computed once, when a falling input
///   first moves a play: S over segment k at the envelope level - opening_last, where the front will have
///   been taken. So each sum is a function of the segments further out alone: no running sum, no drift; the
///   same memory has the same sums, however it came about.
///
/// MONOTONE, BIT FOR BIT
///   Rounding is monotone, so `taken` is nested also as computed: a descending front d over an ascending c
///   has last = the largest j with fl(c - d) > opening_j, and a >= c gives fl(a - d) >= fl(c - d); the other
///   pairs alike. Where one segment's stretch ends, its S is by construction the next stretch's first value.
///   The loading curve is rounded so that it does not fall at an opening (init checks it). A stretch is
///   evaluated from its far end, so where it begins, at a reversal, S may be off by rounding; the state
///   therefore keeps the plays' part `plays` of the present output, and a rising input gives max(S, plays), a
///   falling one min(S, plays). This never feeds back into a segment.
///
/// INVERSE
///   In one cell of the table and one stretch between two openings the output is linear in the input. From
///   the present point that line is solved first, then a few that follow it. A line further away is found by
///   halving the table's knots and the kinks, where segments are taken or plays start to move, together:
///   the output's other part at a knot plus the plays' sum at a kink (sum_i is the end value) tells of the
///   earlier one that it falls short, or of the later one that it does not. Then one linear equation.
#ifndef HYST_F32_SEGMENTS_H
#define HYST_F32_SEGMENTS_H

#include "hyst_f32_internal.h"

/// +1 up, -1 down: turns a quantity into the direction of the move and back, exactly.
static inline float hyst_f32_sign(const bool rising)
{
    return rising ? 1.0f : -1.0f;
}

/// A quantity in the direction of the move, or back.
static inline float hyst_f32_toward(const float x, const bool rising)
{
    return rising ? x : -x;
}

/// Whether the segment was left in this direction.
static inline bool hyst_f32_is_along(const hyst_f32_segment_t* segment, const bool rising)
{
    return segment->rising == (rising ? 1 : 0);
}

/// How far beyond the segment's level `ahead` is, the envelope in the direction of the move.
static inline float hyst_f32_beyond(const hyst_f32_segment_t* segment, const bool along, const float ahead)
{
    return along ? ahead - segment->level : ahead + segment->level;
}

/// Whether a move to beyond = x takes all plays of the segment.
static inline bool hyst_f32_is_taken(const hyst_f32_play_t* play, const hyst_f32_segment_t* segment,
                                     const bool along, const float x)
{
    return along ? x >= 0.0f : x > play[segment->last].opening;
}

static inline float hyst_f32_loading(const hyst_f32_play_t* play, const float x)
{
    return play->loading + play->slope * (x - play->opening);
}

/// S over the innermost kept segment when plays 0 ... last have moved.
static inline float hyst_f32_over(const hyst_f32_play_t* play, const hyst_f32_segment_t* kept,
                                  const bool along, const float end, const uint32_t last, const float x)
{
    return along ? end + play[last].slope * x
                 : end - (play[kept->last].loading - hyst_f32_loading(&play[last], x));
}

/// S with every play moved.
static inline float hyst_f32_over_none(const hyst_f32_model_t* model, const float ahead)
{
    return ahead * model->play[model->num_plays - 1].slope - model->moment;
}

/// The largest j with opening_j < x, low <= j <= high.
uint32_t hyst_f32_last_moved(const hyst_f32_play_t* play, uint32_t low, uint32_t high, float x);

/// sum[rising] of a segment left in the other direction: S over the next one out at the envelope that takes
/// it.
float hyst_f32_end_of(const hyst_f32_model_t* model, const hyst_f32_segment_t* memory, uint32_t index,
                      bool rising);

/// What a move makes of the memory: segments below `index` are kept, the front goes there.
typedef struct {
    uint32_t index; ///< state->front + 1 after a reversal
    uint32_t last;  ///< the last play that moved
    float sum;      ///< S
    float end;      ///< after a reversal: sum[rising] of the segment that was turned back from
} hyst_f32_front_t;

/// The front that a move to `ahead` makes; false when it moves no play. Looks only.
bool hyst_f32_meet(const hyst_f32_model_t* model, const hyst_f32_state_t* state, bool rising, float ahead,
                   hyst_f32_front_t* front);

/// Moves the state to v, finite and in `cell`, whatever the move is.
float hyst_f32_move(const hyst_f32_model_t* model, hyst_f32_state_t* state, uint32_t cell, float v);

/// A step of any input: one that is no number, out of range or far away.
float hyst_f32_step_anywhere(const hyst_f32_model_t* model, hyst_f32_state_t* state, float input);

/// Sets both sums of segments 0 ... front from their levels and plays, as the moves would have.
void hyst_f32_sum_up(const hyst_f32_model_t* model, hyst_f32_segment_t* memory, uint32_t front);

#endif
