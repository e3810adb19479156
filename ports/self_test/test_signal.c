#include "test_signal.h"

/// Parabolas in place of a sine: phase in 1/2048 of a period, result in [0, 1].
static float wave(const uint32_t phase)
{
    const float x = (float)(phase % 1024u) * (1.0f / 1024.0f);
    const float arc = 2.0f * x * (1.0f - x);
    return phase % 2048u < 1024u ? 0.5f + arc : 0.5f - arc;
}

float signal_smooth(const uint32_t index, const uint32_t rate)
{
    return 0.625f * wave(index * rate) + 0.375f * wave(index * rate * 5u / 13u);
}

float signal_random(uint32_t* seed)
{
    // Numerical Recipes' constants; the upper 24 bits are the good ones and exact in float.
    *seed = *seed * UINT32_C(1664525) + UINT32_C(1013904223);
    return (float)(*seed >> 8) * (1.0f / 16777216.0f);
}
