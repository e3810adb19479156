#include "group_loss.h"
#include <math.h>

group_sums_t group_sums_begin(double origin)
{
    return (group_sums_t){.origin = origin};
}

void group_sums_add(group_sums_t* sums, double radius, double weight)
{
    const long double d = (long double)radius - (long double)sums->origin;
    const long double p = (long double)weight;
    sums->num_plays += 1;
    sums->radius += d;
    sums->weight += p;
    sums->moment += p * d;
    sums->square += p * p;
    sums->square_moment += p * p * d;
    sums->square_inertia += p * p * d * d;
    sums->entropy -= p > 0.0L ? p * logl(p) : 0.0L;
}

/// The centroid's distance from the origin.
static long double centroid_distance(const group_sums_t* sums)
{
    return sums->weight > 0.0L ? sums->moment / sums->weight : sums->radius / (long double)sums->num_plays;
}

double group_centroid(const group_sums_t* sums)
{
    return (double)((long double)sums->origin + centroid_distance(sums));
}

double group_loss(const group_sums_t* sums)
{
    if (sums->num_plays < 2 || !(sums->weight > 0.0L)) {
        return 0.0;
    }
    const long double c = centroid_distance(sums);
    // -sum q log q with q = p / P, and sum p^2 (d - c)^2, both expanded; rounding may leave either below 0.
    const long double entropy = sums->entropy / sums->weight + logl(sums->weight);
    const long double inertia = sums->square_inertia - c * (2.0L * sums->square_moment - c * sums->square);
    return entropy > 0.0L && inertia > 0.0L ? (double)(entropy * sqrtl(inertia)) : 0.0;
}
