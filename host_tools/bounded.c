#include "bounded.h"

#include <math.h>

/// Just inside, where the sine still has a slope.
static const double nearest_to_bound = 0.999;

double bounded_to_free(bounds_t b, double value)
{
    const double low = b.logarithmic ? log(b.low) : b.low;
    const double high = b.logarithmic ? log(b.high) : b.high;
    const double inner = b.logarithmic ? log(fmax(value, b.low)) : value;
    const double place = 2 * (inner - low) / (high - low) - 1;
    return asin(fmin(fmax(place, -nearest_to_bound), nearest_to_bound));
}

double bounded_from_free(bounds_t b, double free)
{
    const double low = b.logarithmic ? log(b.low) : b.low;
    const double high = b.logarithmic ? log(b.high) : b.high;
    const double value = low + (high - low) * 0.5 * (1 + sin(free));
    return b.logarithmic ? exp(value) : value;
}
