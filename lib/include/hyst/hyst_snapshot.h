/// What sealed snapshots of every scalar share: a snapshot that says whose it is and whether it is whole, for
/// memory that power can fail on. An array of 32-bit words, the same numbers on every core:
///
///   0                 HYST_SNAPSHOT_MAGIC
///   1                 HYST_SNAPSHOT_FORMAT << 16 | scalar
///   2                 the model's num_plays
///   3                 the model's CRC
///   4                 words of payload
///   5 ...             payload, as the scalar's save function lays it out
///   last              CRC-32 of all words before it
///
/// The CRC-32 is that of IEEE 802.3 (reflected 0x04C11DB7, start and final exclusive-or of all ones) over the
/// words' bytes, least significant first. It finds every burst of up to 32 bits, and any 3 wrong bits in up
/// to 11 KB; of other damage all but one case in 2^32.
#ifndef HYST_HYST_SNAPSHOT_H
#define HYST_HYST_SNAPSHOT_H

#include "hyst/hyst.h"

#ifdef __cplusplus
extern "C" {
#endif

/// "HYST" as bytes in ascending order.
#define HYST_SNAPSHOT_MAGIC        UINT32_C(0x54535948)
#define HYST_SNAPSHOT_FORMAT       1
#define HYST_SNAPSHOT_HEADER_WORDS 5
/// Words of a snapshot whose payload has this many.
#define HYST_SNAPSHOT_WORDS(payload_words) (HYST_SNAPSHOT_HEADER_WORDS + (payload_words) + 1)

/// Which scalar's state a payload holds. Values are stored and never renumbered.
typedef enum { HYST_SCALAR_F32 = 1, HYST_SCALAR_Q31 = 2, HYST_SCALAR_Q15 = 3 } hyst_scalar_t;

/// One word of a snapshot, whichever way it is looked at.
typedef union {
    uint32_t bits;
    int32_t integer;
    float real;
} hyst_word_t;

#define HYST_CRC32_START UINT32_C(0xFFFFFFFF)

/// Carries a CRC on over one more word. Start with HYST_CRC32_START; the finished CRC is the result's
/// complement. Constant time, without a table.
uint32_t hyst_crc32(uint32_t crc, uint32_t word);

#ifdef __cplusplus
}
#endif

#endif
