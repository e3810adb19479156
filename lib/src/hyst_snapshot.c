#include "hyst_snapshot_internal.h"

enum { MAGIC, FORMAT_AND_SCALAR, NUM_PLAYS, MODEL_CRC, PAYLOAD_WORDS };

/// 0x04C11DB7 with its bits reversed.
#define POLYNOMIAL UINT32_C(0xEDB88320)

uint32_t hyst_crc32(uint32_t crc, const uint32_t word)
{
    crc ^= word;
    for (uint32_t bit = 0; bit < 32; ++bit) {
        crc = (crc >> 1) ^ (POLYNOMIAL & (0u - (crc & 1u)));
    }
    return crc;
}

static uint32_t checksum(const hyst_word_t* snapshot, const size_t count)
{
    uint32_t crc = HYST_CRC32_START;
    for (size_t i = 0; i < count; ++i) {
        crc = hyst_crc32(crc, snapshot[i].bits);
    }
    return ~crc;
}

static uint32_t format_and_scalar(const hyst_seal_t* seal)
{
    return ((uint32_t)HYST_SNAPSHOT_FORMAT << 16) | (uint32_t)seal->scalar;
}

void hyst_seal_close(const hyst_seal_t* seal, hyst_word_t* snapshot)
{
    snapshot[MAGIC].bits = HYST_SNAPSHOT_MAGIC;
    snapshot[FORMAT_AND_SCALAR].bits = format_and_scalar(seal);
    snapshot[NUM_PLAYS].bits = seal->num_plays;
    snapshot[MODEL_CRC].bits = seal->model_crc;
    snapshot[PAYLOAD_WORDS].bits = seal->payload_words;
    const size_t last = HYST_SNAPSHOT_HEADER_WORDS + (size_t)seal->payload_words;
    snapshot[last].bits = checksum(snapshot, last);
}

hyst_status_t hyst_seal_check(const hyst_seal_t* seal, const hyst_word_t* snapshot, const size_t length)
{
    if (length < HYST_SNAPSHOT_WORDS(0)) {
        return HYST_STATUS_SNAPSHOT_TORN;
    }
    if (snapshot[MAGIC].bits != HYST_SNAPSHOT_MAGIC ||
        snapshot[FORMAT_AND_SCALAR].bits != format_and_scalar(seal)) {
        return HYST_STATUS_SNAPSHOT_FORMAT;
    }
    // The length it states itself, so that a shorter model's snapshot is found foreign and not torn.
    const size_t payload_words = snapshot[PAYLOAD_WORDS].bits;
    if (payload_words > length - HYST_SNAPSHOT_WORDS(0)) {
        return HYST_STATUS_SNAPSHOT_TORN;
    }
    const size_t last = HYST_SNAPSHOT_HEADER_WORDS + payload_words;
    if (snapshot[last].bits != checksum(snapshot, last)) {
        return HYST_STATUS_SNAPSHOT_TORN;
    }
    if (snapshot[NUM_PLAYS].bits != seal->num_plays || snapshot[MODEL_CRC].bits != seal->model_crc) {
        return HYST_STATUS_SNAPSHOT_MODEL;
    }
    return payload_words == seal->payload_words ? HYST_STATUS_OK : HYST_STATUS_SNAPSHOT_FORMAT;
}
