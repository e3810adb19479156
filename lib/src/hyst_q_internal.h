/// What the fixed-point files share. Each is compiled once for q31 and once for q15: HYST_Q_BITS is 32 or 16,
/// HYST_Q(x) names hyst_q31_x or hyst_q15_x. All arithmetic is on unsigned numbers of at most 32 bits, and on
/// hyst_q_sum_t of twice HYST_Q_BITS for products and sums: nothing depends on how a core shifts or wraps
/// negative numbers.
#ifndef HYST_Q_INTERNAL_H
#define HYST_Q_INTERNAL_H

#if HYST_Q_BITS == 32
#include "hyst/hyst_q31.h"
#define HYST_Q(name)      hyst_q31_##name
#define HYST_Q_STATE_MAX  HYST_Q31_STATE_MAX
#define HYST_Q_RADIUS_MAX HYST_Q31_RADIUS_MAX
#define HYST_Q_OUTPUT_MIN INT32_MIN
#define HYST_Q_OUTPUT_MAX INT32_MAX
#define HYST_Q_WORD_MAX   UINT32_MAX
#define HYST_Q_HALF       (UINT64_C(1) << 31)
typedef int32_t hyst_q_value_t; ///< inputs and outputs
typedef uint32_t hyst_q_word_t; ///< envelopes, radii and states as stored
typedef uint64_t hyst_q_sum_t;  ///< weight times state
typedef int64_t hyst_q_wide_t;  ///< sums of a few outputs
#else
#include "hyst/hyst_q15.h"
#define HYST_Q(name)      hyst_q15_##name
#define HYST_Q_STATE_MAX  HYST_Q15_STATE_MAX
#define HYST_Q_RADIUS_MAX HYST_Q15_RADIUS_MAX
#define HYST_Q_OUTPUT_MIN INT16_MIN
#define HYST_Q_OUTPUT_MAX INT16_MAX
#define HYST_Q_WORD_MAX   UINT32_C(0xFFFF)
#define HYST_Q_HALF       (UINT32_C(1) << 15)
typedef int16_t hyst_q_value_t;
typedef uint16_t hyst_q_word_t;
typedef uint32_t hyst_q_sum_t;
typedef int32_t hyst_q_wide_t;
#endif

#include "hyst/hyst_snapshot.h"

typedef HYST_Q(knot_t) hyst_q_knot_t;
typedef HYST_Q(model_t) hyst_q_model_t;
typedef HYST_Q(segment_t) hyst_q_segment_t;
typedef HYST_Q(state_t) hyst_q_state_t;

/// Half of the input's range, rounded down: how far its middle lies above input_min.
static inline uint32_t hyst_q_half_range(const hyst_q_model_t* model)
{
    return ((uint32_t)model->input_max - (uint32_t)model->input_min) / 2;
}

/// `distance` units above input_min. At most input_max; the sum is taken where it cannot overflow.
static inline hyst_q_value_t hyst_q_input_above(const hyst_q_model_t* model, const uint32_t distance)
{
    return (hyst_q_value_t)((int64_t)model->input_min + (int64_t)distance);
}

/// Half up: x / 2^HYST_Q_BITS to the nearest integer.
static inline uint32_t hyst_q_round(const hyst_q_sum_t x)
{
    return (uint32_t)(x >> HYST_Q_BITS) + (uint32_t)((x >> (HYST_Q_BITS - 1)) & 1U);
}

#if HYST_Q_BITS == 32 && defined(__ARM_ARCH_ISA_THUMB) && __ARM_ARCH_ISA_THUMB == 1
/// These cores multiply 32 by 32 bits to 32: four products of halves are less work than a call of the
/// compiler's 64 by 64 bits.
typedef struct {
    uint32_t high, middle, low; ///< high 2^32 + (middle mod 2^16) 2^16 + (low mod 2^16)
} hyst_q_halves_t;

static inline hyst_q_halves_t hyst_q_multiply(const uint32_t a, const uint32_t b)
{
    const uint32_t low = (a & 0xFFFFU) * (b & 0xFFFFU);
    const uint32_t one = (a >> 16) * (b & 0xFFFFU) + (low >> 16);
    const uint32_t other = (a & 0xFFFFU) * (b >> 16) + (one & 0xFFFFU);
    const hyst_q_halves_t halves = {(a >> 16) * (b >> 16) + (one >> 16) + (other >> 16), other, low};
    return halves;
}

/// a * b, exact; and rounded as hyst_q_round does.
static inline hyst_q_sum_t hyst_q_product(const uint32_t a, const uint32_t b)
{
    const hyst_q_halves_t halves = hyst_q_multiply(a, b);
    return (uint64_t)halves.high << 32 | (uint32_t)(halves.middle << 16 | (halves.low & 0xFFFFU));
}

static inline uint32_t hyst_q_scaled(const uint32_t a, const uint32_t b)
{
    const hyst_q_halves_t halves = hyst_q_multiply(a, b);
    return halves.high + ((halves.middle >> 15) & 1U);
}
#else
static inline hyst_q_sum_t hyst_q_product(const uint32_t a, const uint32_t b)
{
    return (hyst_q_sum_t)a * b;
}

static inline uint32_t hyst_q_scaled(const uint32_t a, const uint32_t b)
{
    return hyst_q_round(hyst_q_product(a, b));
}
#endif

/// How far v lies behind the knot, in the unit of the cell's slopes.
static inline uint32_t hyst_q_offset(const hyst_q_knot_t* knot, const hyst_q_value_t v)
{
    return ((uint32_t)v - (uint32_t)knot->input) << knot->shift;
}

/// A curve in the cell at this offset: exact at both knots, never above the next knot's value.
static inline uint32_t hyst_q_line(const uint32_t value, const uint32_t slope, const uint32_t offset,
                                   const uint32_t next_value)
{
    const uint32_t y = value + hyst_q_scaled(slope, offset);
    return y < next_value ? y : next_value;
}

static inline uint32_t hyst_q_level(const hyst_q_knot_t* knot, const uint32_t offset, const bool rising)
{
    return rising ? hyst_q_line(knot->ascending, knot->ascending_slope, offset, knot[1].ascending)
                  : hyst_q_line(knot->descending, knot->descending_slope, offset, knot[1].descending);
}

static inline uint32_t hyst_q_envelope(const hyst_q_model_t* model, const uint32_t cell,
                                       const hyst_q_value_t v, const bool rising)
{
    const hyst_q_knot_t* knot = &model->knot[cell];
    return hyst_q_level(knot, hyst_q_offset(knot, v), rising);
}

static inline uint32_t hyst_q_nonhysteretic(const hyst_q_knot_t* knot, const uint32_t offset)
{
    return hyst_q_line(knot->nonhysteretic, knot->nonhysteretic_slope, offset, knot[1].nonhysteretic);
}

/// The output for this sum of weighted states. hyst_q31_init has seen to it that it fits.
static inline hyst_q_value_t hyst_q_total(const hyst_q_model_t* model, const uint32_t nonhysteretic,
                                          const hyst_q_sum_t sum)
{
    return (hyst_q_value_t)(model->constant + (hyst_q_wide_t)nonhysteretic +
                            (hyst_q_wide_t)hyst_q_round(sum));
}

static inline hyst_q_value_t hyst_q_output(const hyst_q_model_t* model, const uint32_t cell,
                                           const hyst_q_value_t v, const hyst_q_sum_t sum)
{
    const hyst_q_knot_t* knot = &model->knot[cell];
    return hyst_q_total(model, hyst_q_nonhysteretic(knot, hyst_q_offset(knot, v)), sum);
}

/// Whether an envelope at `level`, rising or falling, moves play j, which is in `segment`. No sum exceeds 32
/// bits: a state plus its radius and a level plus twice a radius are at most 2^31 - 1 + 2^31.
static inline bool hyst_q_moves(const hyst_q_model_t* model, const hyst_q_segment_t* segment,
                                const uint32_t j, const uint32_t level, const bool rising)
{
    if (rising) {
        return level > (segment->falling ? segment->level + 2U * model->radius[j] : segment->level);
    }
    return (segment->falling ? level : level + 2U * model->radius[j]) < segment->level;
}

/// sum of p_j (level - r_j), or of p_j (level + r_j), over the plays from `begin` up to `end`. Parts may
/// wrap, the whole does not.
static inline hyst_q_sum_t hyst_q_part(const hyst_q_model_t* model, const uint32_t begin, const uint32_t end,
                                       const uint32_t level, const bool falling)
{
    const uint32_t weight = (uint32_t)(model->cumulative_weight[end] - model->cumulative_weight[begin]);
    const hyst_q_sum_t moment = model->cumulative_moment[end] - model->cumulative_moment[begin];
    const hyst_q_sum_t product = hyst_q_product(weight, level);
    return falling ? product + moment : product - moment;
}

/// The same over the plays before `end`.
static inline hyst_q_sum_t hyst_q_front_part(const hyst_q_model_t* model, const uint32_t end,
                                             const uint32_t level, const bool falling)
{
    const hyst_q_sum_t moment = model->cumulative_moment[end];
    const hyst_q_sum_t product = hyst_q_product(model->cumulative_weight[end], level);
    return falling ? product + moment : product - moment;
}

/// sum of p_j w_j over all plays when `segment` is the topmost and at `level`.
static inline hyst_q_sum_t hyst_q_front_sum(const hyst_q_model_t* model, const hyst_q_segment_t* segment,
                                            const uint32_t level)
{
    return segment->rest + hyst_q_product(model->cumulative_weight[segment->end], level);
}

/// sum of p_j w_j over the plays from the segment's end on.
static inline hyst_q_sum_t hyst_q_below(const hyst_q_model_t* model, const hyst_q_segment_t* segment)
{
    const hyst_q_sum_t moment = model->cumulative_moment[segment->end];
    return segment->falling ? segment->rest - moment : segment->rest + moment;
}

/// The state of play j, which is in `segment`.
static inline uint32_t hyst_q_play(const hyst_q_model_t* model, const hyst_q_segment_t* segment,
                                   const uint32_t j)
{
    return segment->falling ? segment->level + model->radius[j] : segment->level - model->radius[j];
}

/// The level at which an envelope begins to move play j, which is in `segment`: w + r rising, w - r falling,
/// and not below 0 for a play that moves.
static inline uint32_t hyst_q_kink(const hyst_q_model_t* model, const hyst_q_segment_t* segment,
                                   const uint32_t j, const bool rising)
{
    if (rising) {
        return segment->falling ? segment->level + 2U * model->radius[j] : segment->level;
    }
    return segment->falling ? segment->level : segment->level - 2U * model->radius[j];
}

/// Number `index` of a snapshot. *segment goes along with it, from the topmost one on.
static inline uint32_t hyst_q_saved_number(const hyst_q_model_t* model, const hyst_q_state_t* state,
                                           const uint32_t index, uint32_t* segment)
{
    if (index == 0) {
        return (uint32_t)state->input - (uint32_t)model->input_min;
    }
    while (state->segment[*segment].end < index) {
        --*segment;
    }
    return hyst_q_play(model, &state->segment[*segment], index - 1);
}

enum { HYST_Q_NUMBERS_IN_WORD = 32 / HYST_Q_BITS };

/// A snapshot's numbers, one by one or, where that is NULL, packed into words, the first one lowest.
typedef struct {
    const hyst_q_word_t* single;
    const hyst_word_t* packed;
} hyst_q_numbers_t;

static inline uint32_t hyst_q_number(const hyst_q_numbers_t* numbers, const uint32_t index)
{
    if (numbers->single != NULL) {
        return numbers->single[index];
    }
    const uint32_t word = numbers->packed[index / HYST_Q_NUMBERS_IN_WORD].bits;
    return (word >> (index % HYST_Q_NUMBERS_IN_WORD * HYST_Q_BITS)) & HYST_Q_WORD_MAX;
}

/// As hyst_q31_restore, for arguments that have been checked.
HYST_NODISCARD hyst_status_t HYST_Q(restore_numbers)(const hyst_q_model_t* model, hyst_q_state_t* state,
                                                     const hyst_q_numbers_t* saved);

/// Where an envelope's push ends: it moves the plays before `end` and leaves `num_kept` segments at the
/// stack's bottom.
typedef struct {
    uint32_t end;
    uint32_t num_kept;
    hyst_q_sum_t below; ///< sum of p_j w_j over the plays from `end` on
} hyst_q_front_t;

/// A cell k with knot[k].input <= v <= knot[k + 1].input; `guess` is where to look first. v within the range.
uint32_t HYST_Q(find_cell)(const hyst_q_model_t* model, uint32_t guess, hyst_q_value_t v);

/// Looks how far a push to `level` would go.
hyst_q_front_t HYST_Q(find_front)(const hyst_q_model_t* model, const hyst_q_state_t* state, uint32_t level,
                                  bool rising);

/// The push that ends there, known already.
hyst_q_front_t HYST_Q(front_at)(const hyst_q_model_t* model, const hyst_q_state_t* state, uint32_t num_kept,
                                uint32_t end);

/// Puts a new segment in place of those that a push to `level` moves as a whole, and of the first plays of
/// the next one that it moves. Play 0 moves.
void HYST_Q(replace)(const hyst_q_model_t* model, hyst_q_state_t* state, uint32_t level, bool rising);

/// Puts all plays into one segment.
void HYST_Q(saturate)(const hyst_q_model_t* model, hyst_q_state_t* state, uint32_t level, bool falling);

/// Builds the memory play by play, from the last to the first: w is the state of play j, and inner_w that of
/// play j - 1 (any value for j = 0). Starts over at j = num_plays - 1.
void HYST_Q(stack_play)(const hyst_q_model_t* model, hyst_q_state_t* state, uint32_t j, uint32_t w,
                        uint32_t inner_w);

/// Puts the state at `input`, within the range, with the memory as it is.
void HYST_Q(place)(const hyst_q_model_t* model, hyst_q_state_t* state, hyst_q_value_t input);

#endif
