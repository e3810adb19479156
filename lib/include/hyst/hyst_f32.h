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

/// A model, constant, in flash: made by `hyst emit`.
/// With num_knots == 0 it is a classical PI model: both envelopes are the identity, D(v) =
/// nonhysteretic_slope * v, and no table is stored or read.
typedef struct {
    uint32_t format;             ///< HYST_MODEL_FORMAT
    uint32_t num_plays;          ///< 1 ... HYST_MAX_PLAYS
    uint32_t num_knots;          ///< 0 (classical), or 2 ... HYST_MAX_KNOTS
    float input_min;             ///< least input, input units; equals the first knot's
    float input_max;             ///< largest input; equals the last knot's
    float constant;              ///< added to every output, output units
    float nonhysteretic_slope;   ///< output units per input unit; used only when num_knots == 0
    const float* radius;         ///< [num_plays] >= 0, not decreasing, envelope units
    const float* weight;         ///< [num_plays] >= 0, output units per envelope unit
    const hyst_f32_knot_t* knot; ///< [num_knots], or NULL when num_knots == 0
} hyst_f32_model_t;

/// The state, caller-owned, in RAM. Fields may be read; only the functions below write them.
typedef struct {
    float* memory;           ///< [num_plays] the plays' states w_j, the caller's array
    float input;             ///< the last input applied, after clamping
    float output;            ///< the output it gave
    uint32_t cell;           ///< the table's cell that holds `input`
    uint32_t invalid_inputs; ///< inputs that were NaN (stops counting at UINT32_MAX)
    uint32_t clamped_inputs; ///< inputs outside [input_min, input_max], infinities included (likewise)
} hyst_f32_state_t;

/// What the inverse found.
typedef struct {
    float input;         ///< the input to apply, within [input_min, input_max]
    float reachable_min; ///< the outputs that one monotone move from the present memory can reach:
    float reachable_max; ///<   [reachable_min, reachable_max], output units
    bool clamped;        ///< the wanted output lies outside, or is NaN: `input` gives the nearest reachable
} hyst_f32_inverse_t;

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
/// at 0. model: in flash or RAM, must outlive the state. memory: [memory_length] floats, memory_length >=
/// num_plays; must not overlap *state. Nothing is written unless it returns HYST_STATUS_OK. Returns:
/// NULL_POINTER, MODEL_FORMAT, PLAY_COUNT, MEMORY_LENGTH, INPUT_RANGE, RADIUS, WEIGHT, NONHYSTERETIC, KNOTS,
/// ENVELOPE, ENVELOPE_ORDER or OUTPUT_RANGE, each as hyst_status_t says. Time O(num_plays + num_knots).
HYST_NODISCARD hyst_status_t hyst_f32_init(const hyst_f32_model_t* model, hyst_f32_state_t* state,
                                           float* memory, size_t memory_length);

/// Forgets the past: memory as `start` says, then moved to `input` (treated as hyst_f32_step treats it; NaN:
/// the middle of the range). Counters are kept. Returns the output there. Time O(num_plays + num_knots).
float hyst_f32_reset(const hyst_f32_model_t* model, hyst_f32_state_t* state, hyst_start_t start, float input);

/// Applies `input` [input units] and returns the model's output [output units], always finite. Eqs. (6) and
/// (8). Below input_min or above input_max, infinities included: clamped and counted in clamped_inputs. NaN:
/// the previous input is held, counted in invalid_inputs. An unchanged input leaves the memory as it is. Time
/// O(num_plays + log num_knots).
float hyst_f32_step(const hyst_f32_model_t* model, hyst_f32_state_t* state, float input);

/// Looks, and changes nothing: the input that gives `wanted` [output units] from the present memory. To
/// commit it, pass the input that was really applied to hyst_f32_step. Exact to rounding for the tabulated
/// model; where many inputs give the same output, the one nearest to the present input. Solves one linear
/// equation in one cell of the table: no iteration to a tolerance. Time O(num_plays (log num_knots + log
/// num_plays)). NaN: the present input, clamped = true.
hyst_f32_inverse_t hyst_f32_inverse(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                    float wanted);

/// Copies the state's past to snapshot[num_plays + 1] (the last input, then the plays' states), the caller's
/// array of `length` floats. Returns NULL_POINTER or MEMORY_LENGTH (length < num_plays + 1). Time
/// O(num_plays).
HYST_NODISCARD hyst_status_t hyst_f32_save(const hyst_f32_model_t* model, const hyst_f32_state_t* state,
                                           float* snapshot, size_t length);

/// Puts a saved past back. Counters are kept. Refuses with HYST_STATUS_SNAPSHOT, changing nothing, what this
/// model cannot have been in: an input out of range or not finite, a play outside [ascending(input) - r,
/// descending(input) + r], or states further apart than their radii (beyond rounding). Also NULL_POINTER,
/// MEMORY_LENGTH. Time O(num_plays + log num_knots).
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
