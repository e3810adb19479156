/// A checksum of a model's content.
#ifndef HYST_HOST_MODEL_CRC_H
#define HYST_HOST_MODEL_CRC_H

#include "model.h"
#include <stdint.h>

/// CRC-32 (IEEE 802.3, reflected) of `length` bytes, continued from `crc` (0 to begin).
uint32_t crc32_update(uint32_t crc, const void* data, size_t length);
/// Of everything a model file holds, whatever its layout: the same on every machine.
uint32_t model_crc(const model_t* model);

#endif
