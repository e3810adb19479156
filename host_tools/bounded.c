#include "bounded.h"

#include <math.h>

/// Just inside, where the sine still has a slope.
static const double nearest_to_bound = 0.999;

/// In the middle of the bounds rounding leaves a number next to zero, and a search's difference step is a
/// part of the number it steps from.
static const double rounding = 1e-9;

double bounded_to_free(bounds_t b, double value)
{
    const double low = b.logarithmic ? log(b.low) : b.low;
    const double high = b.logarithmic ? log(b.high) : b.high;
    const double inner = b.logarithmic ? log(fmax(value, b.low)) : value;
    const double place = 2 * (inner - low) / (high - low) - 1;
    return fabs(place) < rounding ? 0 : asin(fmin(fmax(place, -nearest_to_bound), nearest_to_bound));
}

double bounded_from_free(bounds_t b, double free)
{
    const double low = b.logarithmic ? log(b.low) : b.low;
    const double high = b.logarithmic ? log(b.high) : b.high;
    const double value = low + (high - low) * 0.5 * (1 + sin(free));
    return b.logarithmic ? exp(value) : value;
}
