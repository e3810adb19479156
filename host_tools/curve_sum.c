#include "curve_sum.h"
#include <stdlib.h>

static bool same(double a, double b)
{
    return !(a < b) && !(a > b);
}

static bool same_argument(const curve_t* curve, const curve_t* other)
{
    return same(curve->slope, other->slope) && same(curve->shift, other->shift);
}

bool curve_equal(const curve_t* curve, const curve_t* other)
{
    if (curve->type != other->type || curve->num_knots != other->num_knots) {
        return false;
    }
    for (size_t i = 0; i < curve->num_knots; ++i) {
        if (!same(curve->x[i], other->x[i]) || !same(curve->y[i], other->y[i])) {
            return false;
        }
    }
    return curve->type == CURVE_TABLE || (same_argument(curve, other) && same(curve->gain, other->gain) &&
                                          same(curve->offset, other->offset));
}

static bool is_constant(const curve_t* curve)
{
    return curve->type != CURVE_TABLE && same(curve->gain * curve->slope, 0.0);
}

/// Knots of both where both are tables, of the one that is a table otherwise.
static curve_t sum_as_table(const curve_t* curve, const curve_t* other, double factor)
{
    const size_t most = curve->num_knots + other->num_knots;
    double* x = xmalloc(2 * most * sizeof(double));
    double* y = x + most;
    size_t count = 0;
    size_t i = 0;
    size_t j = 0;
    while (i < curve->num_knots || j < other->num_knots) {
        const bool own = j == other->num_knots || (i < curve->num_knots && curve->x[i] <= other->x[j]);
        const double knot = own ? curve->x[i] : other->x[j];
        i += own ? 1 : 0;
        j += own ? 0 : 1;
        if (count == 0 || knot > x[count - 1]) {
            x[count] = knot;
            y[count] = curve_value(curve, knot) + factor * curve_value(other, knot);
            count += 1;
        }
    }
    const curve_t sum = curve_table(x, y, count);
    free(x);
    return sum;
}

/// A constant takes the other's shape.
static curve_t sum_as_formula(const curve_t* curve, const curve_t* other, double factor)
{
    const double at_zero = curve_value(curve, 0.0);
    curve_t sum = is_constant(curve) ? *other : *curve;
    if (is_constant(curve)) {
        sum.gain = factor * other->gain;
        sum.offset = factor * other->offset + at_zero;
    } else if (same_argument(curve, other)) {
        sum.gain += factor * other->gain;
        sum.offset += factor * other->offset;
    } else {
        sum = curve_linear(curve_slope(curve, 0.0) + factor * curve_slope(other, 0.0), 0.0);
        sum.offset = at_zero + factor * curve_value(other, 0.0);
    }
    return sum;
}

bool curve_add_curve(curve_t* curve, const curve_t* other, double factor)
{
    const bool table = curve->type == CURVE_TABLE || other->type == CURVE_TABLE;
    const bool has_tanh = (curve->type == CURVE_TANH && !is_constant(curve)) || other->type == CURVE_TANH;
    const bool same_tanh = curve->type == other->type && same_argument(curve, other);
    if (has_tanh && (table || !(is_constant(curve) || same_tanh))) {
        return false;
    }
    const curve_t sum = table ? sum_as_table(curve, other, factor) : sum_as_formula(curve, other, factor);
    curve_free(curve);
    *curve = sum;
    return true;
}
