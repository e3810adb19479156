/// Single-precision GPI model: forward step, exact inverse, reset, snapshot, self-test.
/// Results are the same bits on every core with IEEE 754 single precision when compiled without
/// floating-point contraction (-ffp-contract=off, which the CMake target sets) and without -ffast-math.
#ifndef HYST_HYST_F32_H
#define HYST_HYST_F32_H

#include "hyst/hyst.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One knot of the table of curves, and the slopes of the cell that begins at it. All three curves share one
/// grid, so that within a cell the inverse is one linear equation. The last knot's slopes are not used.
typedef struct {
    float input;               ///< in input units
    float ascending;           ///< ascending envelope at this input
    float ascending_slope;     ///< (next ascending - ascending) / (next input - input)
    float descending;          ///< descending envelope at this input
    float descending_slope;    ///< likewise
    float nonhysteretic;       ///< D at this input, without `constant`, in output units
    float nonhysteretic_slope; ///< likewise
} hyst_f32_knot_t;

/// One play in the table of plays, and the loading curve L(x) = sum_j p_j max(0, x - 2 r_j): what the plays
/// add when the envelope comes back by x from an extreme that moved them all.
typedef struct {
    float opening; ///< 2 r_j: the play moves once the envelope has come back by more, envelope units
    float loading; ///< L(opening), output units
    float slope;   ///< p_0 + ... + p_j, slope of L beyond the opening, output units per envelope unit
} hyst_f32_play_t;

/// A model, constant, in flash: made by `hyst emit`.
/// With num_knots == 0 it is a classical PI model: both envelopes are the identity, D(v) =
/// nonhysteretic_slope * v, and no table of curves is stored or read.
typedef struct {
    uint32_t format;             ///< HYST_MODEL_FORMAT
    uint32_t num_plays;          ///< 1 ... HYST_MAX_PLAYS
    uint32_t num_knots;          ///< 0 (classical), or 2 ... HYST_MAX_KNOTS
    float input_min;             ///< least input, input units; equals the first knot's
    float input_max;             ///< largest input; equals the last knot's
    float constant;              ///< added to every output, output units
    float nonhysteretic_slope;   ///< output units per input unit; used only when num_knots == 0
    float moment;                ///< sum_j p_j r_j, output units
    const hyst_f32_play_t* play; ///< [num_plays] by radius
    const hyst_f32_knot_t* knot; ///< [num_knots], or NULL when num_knots == 0
} hyst_f32_model_t;

/// Neighbouring plays that one extreme of the envelope left: w_j = level - r_j when `rising`, -(level - r_j)
/// otherwise.
typedef struct {
    float level;     ///< the extreme, envelope units; negated when it was left by a falling input
    float sum[2];    ///< the plays' part of the output when a rising [1] input takes them, negated: when a
                     ///< falling [0]
    uint16_t last;   ///< the last play; the first one comes after the next segment's last
    uint16_t rising; ///< 1: left by a rising input, 0: by a falling one
} hyst_f32_segment_t;

/// The state, caller-owned, in RAM. Fields may be read; only the functions below write them. Floats and
/// integers take turns, lest a compiler store two floats at once, late, and hold up the next step by that.
typedef struct {
    hyst_f32_segment_t*
        memory;     ///< the caller's array [num_plays]; segments 0, the outermost, to `front` are in use
    uint32_t front; ///< the segment of the plays that moved last
    float input;    ///< the last input applied, after clamping
    uint32_t cell;  ///< the table's cell that holds `input`
    float plays;    ///< the plays' part of `output`
    uint32_t invalid_inputs; ///< inputs that were NaN (stops counting at UINT32_MAX)
    float output;            ///< the output that `input` gave
    uint32_t clamped_inputs; ///< inputs outside [input_min, input_max], infinities included (likewise)
} hyst_f32_state_t;

/// What the inverse found.
typedef struct {
    float input;  ///< the input to apply, within [input_min, input_max]
    bool clamped; ///< the wanted output is out of reach, or NaN: `input` gives the nearest reachable
} hyst_f32_inverse_t;

/// The outputs that one monotone move from the present memory can reach, output units.
typedef struct {
    float reachable_min;
    float reachable_max;
} hyst_f32_reach_t;

/// Golden vectors for the target, made by `hyst emit` with the host's arithmetic. Bits, so that nothing
/// rounds.
typedef struct {
    uint32_t num_steps;           ///< samples in each array below
    const uint32_t* input_bits;   ///< [num_steps] inputs applied in order from negative saturation
    const uint32_t* output_bits;  ///< [num_steps] the outputs
    const uint32_t* wanted_bits;  ///< [num_steps] outputs asked of the inverse after each step ...
    const uint32_t* inverse_bits; ///< [num_steps] ... and the inputs it answered (looked at, not committed)
} hyst_f32_golden_t;

/// Checks the whole model, ties `memory` to `state` and puts it at negative saturation, input_min, counters
/// at 0. model: in flash or RAM, must outlive the state. memory: [memory_length] segments, memory_length >=
/// num_plays; must not overlap *state. Nothing is written unless it returns HYST_STATUS_OK. Returns:
/// NULL_POINTER, MODEL_FORMAT, PLAY_COUNT, MEMORY_LENGTH, INPUT_RANGE, RADIUS, WEIGHT, NONHYSTERETIC, KNOTS,
/// ENVELOPE, ENVELOPE_ORDER or OUTPUT_RANGE, each as hyst_status_t says. Time O(num_plays + num_knots).
HYST_NODISCARD hyst_status_t hyst_f32_init(const hyst_f32_model_t* model, hyst_f32_state_t* state,
                                           hyst_f32_segment_t* memory, size_t memory_length);

/// Forgets the past: memory as `start` says, then moved to `input` (treated as hyst_f32_step treats it; NaN:
/// the middle of the range). Counters are kept. Returns the output there. Time O(num_plays + num_knots).
float hyst_f32_reset(const hyst_f32_model_t* model, hyst_f32_state_t* state, hyst_start_t start, float input);

/// Applies `input` [input units] and returns the model's output [output units], always finite. Eqs. (6) and
/// (8). Below input_min or above input_max, infinities included: clamped and counted in clamped_inputs. NaN:
/// the previous input is held, counted in invalid_inputs. An unchanged input leaves the memory as it is. From
/// one state, a larger input never gives a smaller output, bit for bit. Time O(1) while the input stays
/// within or next to a cell of the table and a few openings; O(log num_plays + log num_knots) for any
/// jump.
float hyst_f32_step(const hyst_f32_model_t* model, hyst_f32_state_t* state, float input);

/// Looks, and changes nothing: the input that gives `wanted` [output units] from the present memory. To
/// commit it, pass the input that was really applied to hyst_f32_step. Exact to rounding for the tabulated
/// model; where many inputs give the same output, the one nearest to the present input. Solves one linear
/// equation in one cell of the table: no iteration to a tolerance. NaN: the present input, clamped = true.
/// Time O(1) next to the present input; O(log num_plays + log num_knots) for any jump.
hyst_f32_inverse_t hyst_f32_inverse(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                    float wanted);

/// Looks, and changes nothing: what hyst_f32_step gives at either end of the range, in the same bits.
/// Time O(log num_plays).
hyst_f32_reach_t hyst_f32_reachable(const hyst_f32_model_t* model, const hyst_f32_state_t* state);

/// Floats in a snapshot of a model with this many plays.
#define HYST_F32_SNAPSHOT_LENGTH(num_plays) (2 * (num_plays) + 3)

/// Copies the state's past to the caller's array of `length` floats: the last input, the plays' part of the
/// output, the number of segments, and of each segment, outermost first, its `level` and 1 + last, negative
/// when it was left by a falling input; the rest 0. Counts are exact in float. Time O(num_plays). Returns
/// NULL_POINTER or MEMORY_LENGTH (length < HYST_F32_SNAPSHOT_LENGTH(num_plays)).
HYST_NODISCARD hyst_status_t hyst_f32_save(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                           float* snapshot, size_t length);

/// Puts a saved past back, in the same bits. Counters are kept. Refuses with HYST_STATUS_SNAPSHOT, changing
/// nothing, what this model cannot have been in: an input out of range or not finite, segments that do not
/// nest, a play outside [ascending(input) - r, descending(input) + r], states further apart than their radii,
/// or a sum that is not theirs (beyond rounding). Also NULL_POINTER, MEMORY_LENGTH. Time O(num_plays + log
/// num_knots).
HYST_NODISCARD hyst_status_t hyst_f32_restore(const hyst_f32_model_t* model, hyst_f32_state_t* state,
                                              const float* snapshot, size_t length);

/// Runs the golden vectors from negative saturation, forward and inverse, and compares bits. Leaves the state
/// reset to negative saturation at input_min with its counters at 0. Returns HYST_STATUS_SELF_TEST on the
/// first difference, NULL_POINTER. Time num_steps times step and inverse.
HYST_NODISCARD hyst_status_t hyst_f32_self_test(const hyst_f32_model_t* model, hyst_f32_state_t* state,
                                                const hyst_f32_golden_t* golden);

#ifdef __cplusplus
}
#endif

#endif
