#include "model.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The cell that holds v: the last knot at or below it, kept within the table so that the end cells continue.
static size_t table_cell(const curve_t* curve, double v)
{
    size_t low = 0;
    size_t high = curve->num_knots - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (curve->x[middle] <= v) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static double cell_slope(const curve_t* curve, size_t cell)
{
    return (curve->y[cell + 1] - curve->y[cell]) / (curve->x[cell + 1] - curve->x[cell]);
}

double curve_value(const curve_t* curve, double v)
{
    switch (curve->type) {
    case CURVE_LINEAR:
        return curve->gain * (curve->slope * v + curve->shift) + curve->offset;
    case CURVE_TANH:
        return curve->gain * tanh(curve->slope * v + curve->shift) + curve->offset;
    case CURVE_TABLE:
        break;
    }
    const size_t cell = table_cell(curve, v);
    return curve->y[cell] + (v - curve->x[cell]) * cell_slope(curve, cell);
}

double curve_slope(const curve_t* curve, double v)
{
    switch (curve->type) {
    case CURVE_LINEAR:
        return curve->gain * curve->slope;
    case CURVE_TANH: {
        // 1 - tanh^2 would cancel near saturation.
        const double cosine = cosh(curve->slope * v + curve->shift);
        return curve->gain * curve->slope / (cosine * cosine);
    }
    case CURVE_TABLE:
        break;
    }
    return cell_slope(curve, table_cell(curve, v));
}

double curve_inverse(const curve_t* curve, double value, double low, double high)
{
    if (curve_value(curve, low) >= value) {
        return low;
    }
    // 200 halvings reach below the last bit of the interval even where it contains 0.
    for (int i = 0; i < 200; ++i) {
        const double middle = low + 0.5 * (high - low);
        if (middle <= low || middle >= high) {
            break;
        }
        if (curve_value(curve, middle) >= value) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return high;
}

void curve_add(curve_t* curve, double constant)
{
    curve->offset += constant;
    for (size_t i = 0; i < curve->num_knots; ++i) {
        curve->y[i] += constant;
    }
}

void curve_scale(curve_t* curve, double factor)
{
    curve->gain *= factor;
    curve->offset *= factor;
    for (size_t i = 0; i < curve->num_knots; ++i) {
        curve->y[i] *= factor;
    }
}

curve_t curve_linear(double slope, double shift)
{
    return (curve_t){.type = CURVE_LINEAR, .slope = slope, .shift = shift, .gain = 1.0};
}

curve_t curve_tanh(double slope, double shift)
{
    return (curve_t){.type = CURVE_TANH, .slope = slope, .shift = shift, .gain = 1.0};
}

static double* copy_values(const double* values, size_t count)
{
    if (values == NULL || count == 0) {
        return NULL;
    }
    return memcpy(xmalloc(count * sizeof(double)), values, count * sizeof(double));
}

curve_t curve_table(const double* x, const double* y, size_t num_knots)
{
    return (curve_t){.type = CURVE_TABLE,
                     .num_knots = num_knots,
                     .x = copy_values(x, num_knots),
                     .y = copy_values(y, num_knots)};
}

curve_t curve_copy(const curve_t* curve)
{
    curve_t copy = *curve;
    copy.x = copy_values(curve->x, curve->num_knots);
    copy.y = copy_values(curve->y, curve->num_knots);
    return copy;
}

void curve_free(curve_t* curve)
{
    free(curve->x);
    free(curve->y);
    *curve = (curve_t){0};
}
