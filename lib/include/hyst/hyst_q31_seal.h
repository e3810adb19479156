/// Sealed snapshots of 32-bit fixed-point states: hyst_q31_save and hyst_q31_restore, with the model's CRC
/// and a checksum round them (hyst_snapshot.h), for memory that power can fail on.
///
///   enum { WORDS = HYST_Q31_SEALED_WORDS(VO2_FILM_NUM_PLAYS) };
///   static hyst_word_t snapshot[WORDS];
///   if (hyst_q31_seal(&vo2_film_model, &state, snapshot, WORDS) == HYST_STATUS_OK) {
///       write_to_eeprom(snapshot, sizeof snapshot);
///   }
#ifndef HYST_HYST_Q31_SEAL_H
#define HYST_HYST_Q31_SEAL_H

#include "hyst/hyst_q31.h"
#include "hyst/hyst_snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Words of a sealed snapshot.
#define HYST_Q31_SEALED_WORDS(num_plays) HYST_SNAPSHOT_WORDS(HYST_Q31_SNAPSHOT_LENGTH(num_plays))

/// The CRC-32 of a model's numbers, which tells models apart: of format, counts, range, constant, radii,
/// weights and knots, not of addresses. For a model that hyst_q31_init has accepted. Time O(num_plays +
/// num_knots).
uint32_t hyst_q31_model_crc(const hyst_q31_model_t* model);

/// Writes the state's past to snapshot[HYST_Q31_SEALED_WORDS(num_plays)], the caller's array of `length`
/// words. Returns NULL_POINTER or MEMORY_LENGTH. Time O(num_plays + num_knots).
HYST_NODISCARD hyst_status_t hyst_q31_seal(const hyst_q31_model_t* model, const hyst_q31_state_t* state,
                                           hyst_word_t* snapshot, size_t length);

/// Puts a sealed past back. Changes nothing unless it returns HYST_STATUS_OK; otherwise, first fault first:
/// NULL_POINTER; SNAPSHOT_FORMAT: no snapshot (erased memory, say), or of another layout or scalar;
/// SNAPSHOT_TORN: longer than `length` words, or the checksum is wrong; SNAPSHOT_MODEL: of another model;
/// SNAPSHOT: whole, but not a state of this model (hyst_q31_restore). Time O(num_plays + num_knots).
HYST_NODISCARD hyst_status_t hyst_q31_unseal(const hyst_q31_model_t* model, hyst_q31_state_t* state,
                                             const hyst_word_t* snapshot, size_t length);

#ifdef __cplusplus
}
#endif

#endif
