/// The frame of a sealed snapshot, the same for every scalar.
#ifndef HYST_SNAPSHOT_INTERNAL_H
#define HYST_SNAPSHOT_INTERNAL_H

#include "hyst/hyst_snapshot.h"

/// Whose snapshot it is.
typedef struct {
    hyst_scalar_t scalar;
    uint32_t num_plays;
    uint32_t model_crc;
    uint32_t payload_words;
} hyst_seal_t;

/// Writes header and checksum round the payload that is in place already.
void hyst_seal_close(const hyst_seal_t* seal, hyst_word_t* snapshot);

/// SNAPSHOT_FORMAT, SNAPSHOT_TORN or SNAPSHOT_MODEL, as hyst_f32_unseal says; reads at most `length` words.
HYST_NODISCARD hyst_status_t hyst_seal_check(const hyst_seal_t* seal, const hyst_word_t* snapshot,
                                             size_t length);

#endif
