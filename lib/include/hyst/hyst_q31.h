/// Fixed-point GPI model in 32-bit integers: forward step, exact inverse, reset, snapshot, self-test.
///
/// Scaling. Inputs and outputs are signed integers; the generated header says what one unit of them is worth
/// and converts (X_INPUT_SCALE, X_INPUT_OFFSET, x_input_from_units(), ...). Envelopes, radii and states are
/// unsigned integers of one common unit, counted from below the least state. A curve is a table of chords,
///
///   value + ((slope * ((v - input) << shift) + 2^31) >> 32), never above the next knot's value,
///
/// and the output is constant + D(v) + ((sum_j p_j w_j + 2^31) >> 32): the only two roundings there are, both
/// half up, both of unsigned 64-bit numbers. Sums of integers are exact, so states and outputs do not depend
/// on the order of summation or the length of a run, and are the same on every core. Overflow. hyst_q31_init
/// refuses models that could overflow (lib/DESIGN.md, "Fixed point"); there is nothing left to saturate but
/// inputs out of range, which are clamped and counted.
///
/// The memory is a stack of segments: neighbouring plays that the same envelope value pushed the same way. A
/// rising or falling input replaces a few at its top, so a smooth sample costs the same for any number of
/// plays.
#ifndef HYST_HYST_Q31_H
#define HYST_HYST_Q31_H

#include "hyst/hyst.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Largest envelope value and state; largest radius.
#define HYST_Q31_STATE_MAX  UINT32_C(0x7FFFFFFF)
#define HYST_Q31_RADIUS_MAX UINT32_C(0x40000000)

/// One knot of the table of curves and the slopes of the cell that begins at it: units of the curve per unit
/// of (v - input) << shift, times 2^32. The last knot's slopes and shift are not used.
typedef struct {
    int32_t input;          ///< input units
    uint32_t ascending;     ///< ascending envelope at this input, <= HYST_Q31_STATE_MAX
    uint32_t descending;    ///< descending envelope, likewise
    uint32_t nonhysteretic; ///< D at this input less `constant`, output units; 0 at the first knot
    uint32_t ascending_slope;
    uint32_t descending_slope;
    uint32_t nonhysteretic_slope;
    uint32_t shift; ///< brings the cell's width to 2^31 ... 2^32 - 1
} hyst_q31_knot_t;

/// A model, constant, in flash: made by `hyst emit --scalar q31`.
typedef struct {
    uint32_t format;        ///< HYST_MODEL_FORMAT
    uint32_t num_plays;     ///< 1 ... HYST_MAX_PLAYS
    uint32_t num_knots;     ///< 2 ... HYST_MAX_KNOTS
    int32_t input_min;      ///< least input; equals the first knot's
    int32_t input_max;      ///< largest input; equals the last knot's
    int64_t constant;       ///< added to every output, output units
    const uint32_t* radius; ///< [num_plays] not decreasing, <= HYST_Q31_RADIUS_MAX
    const uint32_t*
        cumulative_weight; ///< [num_plays + 1] p_0 + ... + p_(k-1), output units per state unit times 2^32
    const uint64_t* cumulative_moment; ///< [num_plays + 1] p_0 r_0 + ... + p_(k-1) r_(k-1)
    const hyst_q31_knot_t* knot;       ///< [num_knots]
} hyst_q31_model_t;

/// Plays that were pushed together: from the end of the segment above it on the stack (0 for the topmost) to
/// `end`.
typedef struct {
    /// With the segment's level c, w_j = c -+ r_j: what the topmost segment adds to P c to give sum p_j w_j
    /// over all plays, P being the weights before `end`. That is, the sum of p_j w_j from `end` on -+ that of
    /// p_j r_j before.
    uint64_t rest;
    uint32_t level;   ///< their states are level - r_j, or level + r_j
    uint16_t end;     ///< one past its last play
    uint16_t falling; ///< 1: level + r_j, pushed by a falling input; 0: level - r_j
} hyst_q31_segment_t;

/// The state, caller-owned, in RAM. Fields may be read; only the functions below write them.
typedef struct {
    uint64_t sum;                ///< sum of p_j w_j
    hyst_q31_segment_t* segment; ///< [num_plays] the memory, a stack: the last one used has play 0
    uint32_t num_segments;       ///< on the stack, 1 ... num_plays
    uint32_t cell;               ///< a table's cell that holds `input`
    uint32_t clamped_inputs;     ///< inputs outside [input_min, input_max] (stops counting at UINT32_MAX)
    int32_t input;               ///< the last input applied, after clamping
    int32_t output;              ///< the output it gave
} hyst_q31_state_t;

/// What the inverse found.
typedef struct {
    int32_t input; ///< the input to apply, within [input_min, input_max]
    bool clamped;  ///< the wanted output is out of reach: `input` gives the nearest reachable
} hyst_q31_inverse_t;

/// The outputs that one monotone move from the present memory can reach.
typedef struct {
    int32_t reachable_min;
    int32_t reachable_max;
} hyst_q31_reach_t;

/// Golden vectors for the target, made by `hyst emit` on the host.
typedef struct {
    uint32_t num_steps;     ///< samples in each array below
    const int32_t* input;   ///< [num_steps] inputs applied in order from negative saturation
    const int32_t* output;  ///< [num_steps] the outputs
    const int32_t* wanted;  ///< [num_steps] outputs asked of the inverse after each step ...
    const int32_t* inverse; ///< [num_steps] ... and the inputs it answered (looked at, not committed)
} hyst_q31_golden_t;

/// Checks the whole model, ties `memory` to `state` and puts it at negative saturation, input_min, counter at
/// 0. model: in flash or RAM, must outlive the state. memory: [memory_length] segments, memory_length >=
/// num_plays; must not overlap *state. Nothing is written unless it returns HYST_STATUS_OK. Returns:
/// NULL_POINTER, MODEL_FORMAT, PLAY_COUNT, MEMORY_LENGTH, INPUT_RANGE, RADIUS (also: too large for the
/// envelopes), WEIGHT (also: moments that contradict weights and radii), NONHYSTERETIC, KNOTS, ENVELOPE,
/// ENVELOPE_ORDER or OUTPUT_RANGE (some output does not fit). Time O(num_plays + num_knots).
HYST_NODISCARD hyst_status_t hyst_q31_init(const hyst_q31_model_t* model, hyst_q31_state_t* state,
                                           hyst_q31_segment_t* memory, size_t memory_length);

/// Forgets the past: memory as `start` says, then moved to `input` (treated as hyst_q31_step treats it). The
/// counter is kept. Returns the output there. Time O(num_plays log num_knots).
int32_t hyst_q31_reset(const hyst_q31_model_t* model, hyst_q31_state_t* state, hyst_start_t start,
                       int32_t input);

/// Applies `input` and returns the model's output. Eqs. (6) and (8). Out of range: clamped and counted in
/// clamped_inputs. An unchanged input leaves the memory as it is.
/// Time: constant while the input stays in a cell of the table or goes to the next one and no reversal is
/// wiped out, otherwise O(log num_plays + log num_knots).
int32_t hyst_q31_step(const hyst_q31_model_t* model, hyst_q31_state_t* state, int32_t input);

/// Looks, and changes nothing: the input whose output from the present memory is nearest to `wanted`. Of two
/// outputs equally near, the one nearer to the present output; of all inputs that give it, the one nearest to
/// the present input. To commit it, pass the input that was really applied to hyst_q31_step. Time O(log
/// num_knots + 64 log num_plays): a line is solved and corrected by steps of bounded number, no iteration to
/// a tolerance; outputs that are near need no search.
hyst_q31_inverse_t hyst_q31_inverse(const hyst_q31_model_t* model, const hyst_q31_state_t* state,
                                    int32_t wanted);

/// Looks, and changes nothing: what hyst_q31_step gives at either end of the range. Time O(log num_plays).
hyst_q31_reach_t hyst_q31_reachable(const hyst_q31_model_t* model, const hyst_q31_state_t* state);

/// Numbers in a snapshot of a model with this many plays.
#define HYST_Q31_SNAPSHOT_LENGTH(num_plays) ((num_plays) + 1)

/// Copies the state's past to snapshot[num_plays + 1] (input - input_min, then the plays' states), the
/// caller's array of `length` numbers. Returns NULL_POINTER or MEMORY_LENGTH (length < num_plays + 1). Time
/// O(num_plays).
HYST_NODISCARD hyst_status_t hyst_q31_save(const hyst_q31_model_t* model, const hyst_q31_state_t* state,
                                           uint32_t* snapshot, size_t length);

/// Puts a saved past back. The counter is kept. Refuses with HYST_STATUS_SNAPSHOT, changing nothing, what
/// this model cannot have been in: an input out of range, a play outside [ascending(input) - r,
/// descending(input) + r] or beyond both saturations, or states further apart than their radii. Also
/// NULL_POINTER, MEMORY_LENGTH. Time O(num_plays + log num_knots).
HYST_NODISCARD hyst_status_t hyst_q31_restore(const hyst_q31_model_t* model, hyst_q31_state_t* state,
                                              const uint32_t* snapshot, size_t length);

/// Runs the golden vectors from negative saturation, forward and inverse, and compares. Leaves the state at
/// negative saturation, input_min, with its counter at 0. Returns HYST_STATUS_SELF_TEST on the first
/// difference, NULL_POINTER. Time num_steps times step and inverse.
HYST_NODISCARD hyst_status_t hyst_q31_self_test(const hyst_q31_model_t* model, hyst_q31_state_t* state,
                                                const hyst_q31_golden_t* golden);

#ifdef __cplusplus
}
#endif

#endif
