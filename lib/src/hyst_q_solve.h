/// A cell of the table and a piece of the memory as a line: where it reaches the wanted output.
#ifndef HYST_Q_SOLVE_H
#define HYST_Q_SOLVE_H

#include "hyst_q_internal.h"
#include <limits.h>

/// The output less the wanted one over the distance x from the cell's lower knot, rounded as the step rounds:
///
///   offset = x << shift
///   excess = at_knot + weight * scaled(level_slope, offset) + 2^HYST_Q_BITS * scaled(nonhysteretic_slope,
///   offset)
///
/// in units of 2^-HYST_Q_BITS output units, one half added: negative, that is with its top bit set, where the
/// output is below the wanted one. This holds for inputs whose outputs are less than half a word from the
/// wanted one, and which neither curve's next value limits.
typedef struct {
    hyst_q_sum_t at_knot;
    uint32_t weight;
    uint32_t level_slope;
    uint32_t nonhysteretic_slope;
    uint32_t shift;
    uint32_t width; ///< of the cell, input units
} hyst_q_line_t;

/// Two neighbouring distances, with what the output is above the wanted one, modulo the word: the output at
/// `high` is not below the wanted one, that at `low` is.
typedef struct {
    uint32_t low, high;
    uint32_t low_excess, high_excess;
} hyst_q_boundary_t;

static inline hyst_q_sum_t hyst_q_excess(const hyst_q_line_t* line, const uint32_t x)
{
    const uint32_t offset = x << line->shift;
    const hyst_q_sum_t nonhysteretic = hyst_q_scaled(line->nonhysteretic_slope, offset);
    const uint32_t level = hyst_q_scaled(line->level_slope, offset);
    return line->at_knot + hyst_q_product(line->weight, level) + (nonhysteretic << HYST_Q_BITS);
}

static inline bool hyst_q_is_negative(const hyst_q_sum_t excess)
{
    return excess >> (2 * HYST_Q_BITS - 1) != 0;
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

/// dividend / divisor to within 16, modulo the word, for a quotient that fits in one; divisor << zeros has
/// its top bit set.
static inline uint32_t hyst_q_quotient(const hyst_q_sum_t dividend, const uint32_t divisor,
                                       const uint32_t zeros)
{
#if HYST_Q_BITS == 32
    // A reciprocal of 17 bits, and what it leaves over once more: lib/DESIGN.md, section 7.
    const uint32_t normal = divisor << zeros;
    const uint32_t whole =
        ((uint32_t)(dividend >> 32) << zeros) | (((uint32_t)dividend >> 1) >> (31 - zeros));
    const uint32_t reciprocal = (UINT32_MAX / ((normal >> 16) + 1)) << 15;
    const uint32_t first = (uint32_t)(hyst_q_product(whole, reciprocal) >> 32) << 1;
    const uint32_t left = whole - (uint32_t)(hyst_q_product(first, normal) >> 32);
    return first + ((uint32_t)(hyst_q_product(left, reciprocal) >> 32) << 1);
#else
    (void)zeros;
    return dividend / divisor;
#endif
}

/// Where the line would reach the wanted output if nothing were rounded, in 1 ... width, and a power of two
/// about as long as it takes to rise by one unit.
static inline uint32_t hyst_q_guess(const hyst_q_line_t* line, uint32_t* step)
{
    const hyst_q_sum_t missing = 0 - line->at_knot;
    const uint32_t slope = line->nonhysteretic_slope + hyst_q_scaled(line->weight, line->level_slope);
    *step = 1;
    if ((uint32_t)(missing >> HYST_Q_BITS) >= slope) {
        return line->width;
    }
    const uint32_t zeros = hyst_q_leading_zeros(slope);
    const uint32_t flat = line->shift + (32 - HYST_Q_BITS);
    if (zeros > flat) {
        *step = UINT32_C(1) << (zeros - flat);
    }
    const uint32_t ahead = hyst_q_quotient(missing, slope, zeros) >> line->shift;
    return ahead < line->width ? ahead + 1 : line->width;
}

/// Finds the boundary: from the guess on by steps that double until it is enclosed, and then by halving.
/// False where it is not in the cell.
static inline bool hyst_q_solve(const hyst_q_line_t* line, hyst_q_boundary_t* found)
{
    uint32_t step;
    uint32_t low = hyst_q_guess(line, &step);
    uint32_t high = low;
    hyst_q_sum_t low_excess = hyst_q_excess(line, low);
    hyst_q_sum_t high_excess = low_excess;
    if (hyst_q_is_negative(low_excess)) {
        do {
            if (high == line->width) {
                return false;
            }
            low = high;
            low_excess = high_excess;
            high = line->width - low > step ? low + step : line->width;
            step |= step << 1;
            high_excess = hyst_q_excess(line, high);
        } while (hyst_q_is_negative(high_excess));
    } else {
        do {
            if (low == 0) {
                return false;
            }
            high = low;
            high_excess = low_excess;
            low = high > step ? high - step : 0;
            step |= step << 1;
            low_excess = hyst_q_excess(line, low);
        } while (!hyst_q_is_negative(low_excess));
    }
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        const hyst_q_sum_t excess = hyst_q_excess(line, middle);
        if (hyst_q_is_negative(excess)) {
            low = middle;
            low_excess = excess;
        } else {
            high = middle;
            high_excess = excess;
        }
    }
    found->low = low;
    found->high = high;
    found->low_excess = (uint32_t)(low_excess >> HYST_Q_BITS);
    found->high_excess = (uint32_t)(high_excess >> HYST_Q_BITS);
    return true;
}

#endif
