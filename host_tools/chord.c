#include "chord.h"
#include <float.h>
#include <math.h>

typedef struct {
    const curve_t* curve;
    double low, low_value, slope;
} chord_t;

static double distance(const chord_t* chord, double v)
{
    return fabs(curve_value(chord->curve, v) - (chord->low_value + chord->slope * (v - chord->low)));
}

/// The first knot above v.
static size_t first_knot_above(const curve_t* curve, double v)
{
    size_t low = 0;
    size_t high = curve->num_knots;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (curve->x[middle] > v) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

static double table_error(const chord_t* chord, double high)
{
    const curve_t* curve = chord->curve;
    double largest = 0.0;
    for (size_t i = first_knot_above(curve, chord->low); i < curve->num_knots && curve->x[i] < high; ++i) {
        largest = fmax(largest, distance(chord, curve->x[i]));
    }
    return largest;
}

/// gain slope / cosh^2(z) equals the chord's slope at z = +-atanh(sqrt(1 - q)), q = the chord's slope / (gain
/// slope).
static double tanh_error(const chord_t* chord, double high, double high_value)
{
    const curve_t* curve = chord->curve;
    const double q = chord->slope / (curve->gain * curve->slope);
    if (!(q > 0.0)) {
        // The curve saturates in double: it is monotone and stays between its ends.
        return fabs(high_value - chord->low_value);
    }
    const double z = q < 1.0 ? atanh(sqrt(1.0 - q)) : 0.0;
    const double candidate[] = {(z - curve->shift) / curve->slope, (-z - curve->shift) / curve->slope};
    double largest = 0.0;
    for (int i = 0; i < 2; ++i) {
        if (candidate[i] > chord->low && candidate[i] < high) {
            largest = fmax(largest, distance(chord, candidate[i]));
        }
    }
    return largest;
}

double chord_error(const curve_t* curve, double low, double high)
{
    const double low_value = curve_value(curve, low);
    const double high_value = curve_value(curve, high);
    const chord_t chord = {curve, low, low_value, (high_value - low_value) / (high - low)};
    double largest = 0.0;
    switch (curve->type) {
    case CURVE_LINEAR:
        return 0.0;
    case CURVE_TANH:
        largest = tanh_error(&chord, high, high_value);
        break;
    case CURVE_TABLE:
        largest = table_error(&chord, high);
        break;
    }
    // A handful of roundings of numbers no larger than the curve's parts.
    const double magnitude = fabs(low_value) + fabs(high_value) + fabs(curve->offset) + fabs(curve->gain);
    return largest > 0.0 ? largest + 8.0 * DBL_EPSILON * magnitude : 0.0;
}
