#ifndef HYST_PORT_FLOAT_BITS_H
#define HYST_PORT_FLOAT_BITS_H

#include <stdint.h>

static inline uint32_t float_bits(const float value)
{
    const union {
        float value;
        uint32_t bits;
    } word = {.value = value};
    return word.bits;
}

/// FNV-1a over a word's bytes, least significant first (Fowler, Noll, Vo; RFC 9923).
static inline uint32_t checksum_add(uint32_t sum, const uint32_t word)
{
    for (uint32_t shift = 0; shift < 32; shift += 8) {
        sum = (sum ^ ((word >> shift) & 255u)) * UINT32_C(16777619);
    }
    return sum;
}

#define CHECKSUM_START UINT32_C(2166136261)

#endif
