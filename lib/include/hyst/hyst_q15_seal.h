/// Sealed snapshots of 16-bit fixed-point states: as hyst/hyst_q31_seal.h, where every function is described.
/// A word holds two numbers, the first one in its lower half.
#ifndef HYST_HYST_Q15_SEAL_H
#define HYST_HYST_Q15_SEAL_H

#include "hyst/hyst_q15.h"
#include "hyst/hyst_snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HYST_Q15_SEALED_WORDS(num_plays) HYST_SNAPSHOT_WORDS((HYST_Q15_SNAPSHOT_LENGTH(num_plays) + 1) / 2)

uint32_t hyst_q15_model_crc(const hyst_q15_model_t* model);
HYST_NODISCARD hyst_status_t hyst_q15_seal(const hyst_q15_model_t* model, const hyst_q15_state_t* state,
                                           hyst_word_t* snapshot, size_t length);
HYST_NODISCARD hyst_status_t hyst_q15_unseal(const hyst_q15_model_t* model, hyst_q15_state_t* state,
                                             const hyst_word_t* snapshot, size_t length);

#ifdef __cplusplus
}
#endif

#endif
