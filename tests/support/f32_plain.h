/// Eqs. (6) and (8) in float as they stand: every play at every sample. What the segment memory is held
/// against.
#ifndef HYST_TESTS_F32_PLAIN_H
#define HYST_TESTS_F32_PLAIN_H

#include <stdbool.h>
#include <stddef.h>

/// The plays' sum after their states in `memory` met `envelope`.
static inline float f32_plain_meet(const float* radius, const float* weight, float* memory, size_t num_plays,
                                   float envelope, bool rising)
{
    float sum = 0.0F;
    for (size_t j = 0; j < num_plays; ++j) {
        const float pushed = rising ? envelope - radius[j] : envelope + radius[j];
        if (rising ? pushed > memory[j] : pushed < memory[j]) {
            memory[j] = pushed;
        }
        sum += weight[j] * memory[j];
    }
    return sum;
}

#endif
