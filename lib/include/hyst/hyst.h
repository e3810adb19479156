/// hyst: generalized Prandtl-Ishlinskii (GPI) hysteresis models and their exact inverse on a microcontroller.
///
///   y = D(v) + sum_j p_j w_j                                     Zhang et al. 2015, Eq. (8)
///   rising input:   w_j <- max(ascending(v) - r_j, w_j)
///   falling input:  w_j <- min(descending(v) + r_j, w_j)         Eq. (6)
///
/// with the play operators' radii r_j, weights p_j >= 0, an ascending and a descending envelope, and the
/// non-hysteretic part D. The host command `hyst` identifies such a model from a measured record, compresses
/// it to a few plays and emits a C header; this library runs it:
///
///   #include "vo2_film.h"                           // generated: vo2_film_model, VO2_FILM_NUM_PLAYS
///   static hyst_f32_segment_t memory[VO2_FILM_NUM_PLAYS];
///   static hyst_f32_state_t state;
///   ...
///   if (hyst_f32_init(&vo2_film_model, &state, memory, VO2_FILM_NUM_PLAYS) != HYST_STATUS_OK) { stop(); }
///   float y = hyst_f32_step(&vo2_film_model, &state, u);            // what the actuator does
///   hyst_f32_inverse_t want = hyst_f32_inverse(&vo2_film_model, &state, y_wanted);  // what to apply
///
/// Nothing in here allocates, prints, locks, masks interrupts, blocks, recurses or keeps a global. So every
/// function may run in an interrupt, and what interrupts it may call any of them too, on one condition: a
/// state belongs to one context at a time. Different states share nothing. Models, golden vectors and
/// snapshots being read are constant and may be shared by any number of contexts.
///
/// Where an interrupt steps a state, another context must mask that interrupt around each of its own calls
/// with the same state: around step, reset and restore, and around inverse, save and seal too.
/// These only read, but would read half of one sample and half of the next (and a checksum made over such a
/// mixture is right and does not tell). To read a single field needs no mask where a 32-bit load is one
/// instruction, as on every Cortex-M and RV32: it is of the last sample or of the one before.
///
/// Floats in an interrupt need the core to save the floating-point registers. Cortex-M does so by itself
/// (FPCCR.ASPEN, which is set out of reset); elsewhere it is the interrupt entry's duty.
#ifndef HYST_HYST_H
#define HYST_HYST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define HYST_VERSION_MAJOR 0
#define HYST_VERSION_MINOR 1
#define HYST_VERSION_PATCH 0

/// The layout of generated models. A header made for another layout refuses to compile.
#define HYST_MODEL_FORMAT 2

/// Most play operators in a model: keeps every count and index in 16 bits.
#define HYST_MAX_PLAYS 4096
/// Most knots in a model's table of curves.
#define HYST_MAX_KNOTS 65535
/// Most cycles of a homing sequence: keeps every count exact in float.
#define HYST_MAX_HOMING_CYCLES 1048576

#if defined(__GNUC__)
#define HYST_NODISCARD __attribute__((warn_unused_result))
#else
#define HYST_NODISCARD
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// Why a function refused. Values are part of the interface and are never renumbered.
typedef enum {
    HYST_STATUS_OK = 0,
    HYST_STATUS_NULL_POINTER = 1,  ///< a required pointer is NULL
    HYST_STATUS_MODEL_FORMAT = 2,  ///< the model was generated for another HYST_MODEL_FORMAT
    HYST_STATUS_PLAY_COUNT = 3,    ///< num_plays is 0 or above HYST_MAX_PLAYS
    HYST_STATUS_MEMORY_LENGTH = 4, ///< the memory given is shorter than num_plays
    HYST_STATUS_INPUT_RANGE = 5,   ///< input_min < input_max does not hold, or one or the width is not finite
    HYST_STATUS_RADIUS = 6,        ///< radii are not finite, not >= 0, or decrease
    HYST_STATUS_WEIGHT = 7,        ///< a weight is not finite or not >= 0, or their sums decrease
    HYST_STATUS_NONHYSTERETIC = 8, ///< the non-hysteretic part is not finite, decreases, or its slopes
                                   ///< contradict its knots
    HYST_STATUS_KNOTS = 9,     ///< the table's inputs do not strictly increase over [input_min, input_max]
    HYST_STATUS_ENVELOPE = 10, ///< an envelope is not finite, decreases, does not increase over all (equal
                               ///< neighbours are taken: saturation rounds so), or its slopes contradict it
    HYST_STATUS_ENVELOPE_ORDER = 11,  ///< ascending - r <= descending + r does not hold for the least radius
    HYST_STATUS_OUTPUT_RANGE = 12,    ///< the largest possible output, doubled, is not finite in this type
    HYST_STATUS_SNAPSHOT = 13,        ///< a snapshot holds no state this model can be in
    HYST_STATUS_SELF_TEST = 14,       ///< a golden vector came out with other bits than on the host
    HYST_STATUS_SNAPSHOT_FORMAT = 15, ///< no snapshot, or one of another layout, scalar or length
    HYST_STATUS_SNAPSHOT_MODEL = 16,  ///< a snapshot of another model
    HYST_STATUS_SNAPSHOT_TORN = 17,   ///< a snapshot's checksum is wrong: not written to its end, or damaged
    HYST_STATUS_CYCLES = 18,          ///< the number of homing cycles is 0 or above HYST_MAX_HOMING_CYCLES
    HYST_STATUS_LOADING = 19, ///< the loading curve or the moment does not follow from radii and weights
} hyst_status_t;

/// Which past a reset puts the memory into.
typedef enum {
    HYST_START_NEGATIVE_SATURATION = 0, ///< as left by a descent to input_min
    HYST_START_POSITIVE_SATURATION = 1, ///< as left by an ascent to input_max
    HYST_START_DEMAGNETISED = 2, ///< as left by a slowly decaying alternation about the middle of the range
} hyst_start_t;

/// The status in English, for a log. Never NULL; a value outside the enum gives "unknown status".
/// Constant time, no state: safe anywhere.
const char* hyst_status_text(hyst_status_t status);

#ifdef __cplusplus
}
#endif

#endif
