/// The inverse within one cell of the table and one piece of the memory: integers solved as a line, then
/// corrected. Included by hyst_q_inverse.h alone.
#ifndef HYST_Q_SOLVE_H
#define HYST_Q_SOLVE_H

#include "hyst_q_internal.h"
#include <limits.h>

/// In one cell, while the same plays move: how far the output lies above that of the lower knot, at the
/// distance x from it.
///
///   offset = x << shift
///   rise   = min(D's line(offset), nonhysteretic_limit)
///            + (weight * limited(envelope's line(offset)) + fraction) / 2^HYST_Q_BITS
///
/// The envelope is limited to the levels of the piece, from `level_start` above its value at the knot on.
/// Rounding is that of the step, so the rise is exact.
typedef struct {
    uint32_t shift;
    uint32_t nonhysteretic_slope;
    uint32_t nonhysteretic_limit;
    uint32_t level_slope;
    uint32_t level_start;
    uint32_t level_limit; ///< counted from level_start
    uint32_t weight;
    uint32_t fraction; ///< of the plays' sum at level_start and one half
    uint32_t need;     ///< the rise that is looked for, >= 1
} hyst_q_rise_t;

static inline uint32_t hyst_q_rise(const hyst_q_rise_t* line, const uint32_t x)
{
    const uint32_t offset = x << line->shift;
    uint32_t nonhysteretic = hyst_q_scaled(line->nonhysteretic_slope, offset);
    if (nonhysteretic > line->nonhysteretic_limit) {
        nonhysteretic = line->nonhysteretic_limit;
    }
    uint32_t level = hyst_q_scaled(line->level_slope, offset);
    level = level > line->level_start ? level - line->level_start : 0;
    if (level > line->level_limit) {
        level = line->level_limit;
    }
    const hyst_q_sum_t plays = hyst_q_product(line->weight, level) + line->fraction;
    return nonhysteretic + (uint32_t)(plays >> HYST_Q_BITS);
}

/// Leading zeros of x > 0 in a word of 32 bits.
static inline uint32_t hyst_q_leading_zeros(uint32_t x)
{
#if defined(__GNUC__) && UINT_MAX == 0xFFFFFFFF
    return (uint32_t)__builtin_clz(x);
#else
    uint32_t zeros = 0;
    for (uint32_t half = 16; half != 0; half /= 2) {
        if (x >> (32 - half) == 0) {
            zeros += half;
            x <<= half;
        }
    }
    return zeros;
#endif
}

/// dividend / divisor or up to 13 less; divisor has no leading zeros after << zeros. What does not fit gives
/// UINT32_MAX.
static inline uint32_t hyst_q_quotient(const hyst_q_sum_t dividend, const uint32_t divisor,
                                       const uint32_t zeros)
{
#if HYST_Q_BITS == 32
    if ((uint32_t)(dividend >> 32) >= divisor) {
        return UINT32_MAX;
    }
    // lib/DESIGN.md, section 7: a reciprocal of 17 bits, never too large, and what it leaves once more.
    const uint32_t normal = divisor << zeros;
    const hyst_q_sum_t whole = dividend << zeros;
    const uint32_t reciprocal = UINT32_MAX / ((normal >> 16) + 1);
    const uint32_t first = (uint32_t)(hyst_q_product((uint32_t)(whole >> 32), reciprocal) >> 16);
    const hyst_q_sum_t left = whole - hyst_q_product(first, normal);
    return first + (uint32_t)(hyst_q_product((uint32_t)(left >> 32), reciprocal) >> 16);
#else
    (void)zeros;
    return dividend / divisor;
#endif
}

/// A stretch of a cell: the rise falls short of the line's need at `low`, and does not at `high`.
typedef struct {
    uint32_t low, high;
    uint32_t low_rise, high_rise;
} hyst_q_stretch_t;

/// Narrows the stretch to one unit: from `x` on, within it, by steps that double until the need is enclosed,
/// and then by halving.
static inline void hyst_q_narrow(const hyst_q_rise_t* line, hyst_q_stretch_t* stretch, uint32_t x,
                                 uint32_t step)
{
    bool up = true;
    bool is_first = true;
    bool is_enclosed = false;
    while (stretch->high - stretch->low > 1) {
        const uint32_t rise = hyst_q_rise(line, x);
        const bool is_short = rise < line->need;
        if (is_short) {
            stretch->low = x;
            stretch->low_rise = rise;
        } else {
            stretch->high = x;
            stretch->high_rise = rise;
        }
        is_enclosed = is_enclosed || (!is_first && is_short != up);
        up = is_short;
        is_first = false;
        const uint32_t room = stretch->high - stretch->low;
        if (is_enclosed || step >= room) {
            x = stretch->low + room / 2;
        } else {
            x = up ? stretch->low + step : stretch->high - step;
            step <<= step >> 31 == 0 ? 1U : 0U;
        }
    }
}

/// Solves the line as if nothing were rounded, and from there on exactly. The stretch is the cell.
static inline void hyst_q_solve(const hyst_q_rise_t* line, hyst_q_stretch_t* stretch)
{
    const uint32_t width = stretch->high;
    if (width > 1) {
        hyst_q_sum_t slope =
            (hyst_q_sum_t)line->nonhysteretic_slope + hyst_q_scaled(line->weight, line->level_slope);
        const hyst_q_sum_t start = hyst_q_product(line->weight, line->level_start);
        hyst_q_sum_t rise = ((hyst_q_sum_t)line->need << HYST_Q_BITS) - line->fraction + start;
        if (slope >> HYST_Q_BITS != 0) {
            slope /= 2;
            rise = ((hyst_q_sum_t)line->need << (HYST_Q_BITS - 1)) - line->fraction / 2 + start / 2;
        }
        uint32_t x = width - 1;
        uint32_t step = width;
        if (slope != 0) {
            const uint32_t zeros = hyst_q_leading_zeros((uint32_t)slope);
            const uint32_t ahead = hyst_q_quotient(rise, (uint32_t)slope, zeros) >> line->shift;
            x = ahead + 1 < width ? ahead + 1 : width - 1;
            // The power of two next above what it takes for one output unit, at least 1.
            const uint32_t flatness = zeros + HYST_Q_BITS - 32;
            step = flatness > line->shift ? UINT32_C(1) << (flatness - line->shift) : 1U;
        }
        hyst_q_narrow(line, stretch, x, step);
    }
    if (stretch->high_rise == 0) {
        stretch->high_rise = hyst_q_rise(line, stretch->high);
    }
}

#endif
