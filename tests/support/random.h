/// Seeded random numbers for tests: the same sequence on every machine.
#ifndef HYST_TESTS_RANDOM_H
#define HYST_TESTS_RANDOM_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint64_t state;
} random_t;

static inline random_t random_new(uint64_t seed)
{
    return (random_t){seed};
}

/// SplitMix64 (Steele, Lea, Flood 2014): every seed is a good one, also 0.
static inline uint64_t random_bits(random_t* random)
{
    random->state += UINT64_C(0x9E3779B97F4A7C15);
    uint64_t z = random->state;
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return z ^ (z >> 31);
}

/// In [low, high).
static inline double random_uniform(random_t* random, double low, double high)
{
    const double unit = (double)(random_bits(random) >> 11) * 0x1p-53;
    return low + (high - low) * unit;
}

/// In {0, ..., count - 1}; the bias of the remainder is below count / 2^64.
static inline size_t random_below(random_t* random, size_t count)
{
    return (size_t)(random_bits(random) % count);
}

/// Standard normal, Box-Muller.
static inline double random_normal(random_t* random)
{
    const double radius = sqrt(-2.0 * log(1.0 - random_uniform(random, 0.0, 1.0)));
    return radius * cos(6.283185307179586477 * random_uniform(random, 0.0, 1.0));
}

#endif
