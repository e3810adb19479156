#include "transport.h"
#include <stdbool.h>

double transport_bound(const play_set_t* plays, const play_set_t* other)
{
    long double positive = 0.0L;
    long double negative = 0.0L;
    long double excess = 0.0L; // G at `radius`
    double radius = 0.0;
    size_t i = 0;
    size_t j = 0;
    while (i < plays->num_plays || j < other->num_plays) {
        const bool first =
            j == other->num_plays || (i < plays->num_plays && plays->radius[i] <= other->radius[j]);
        const double next = first ? plays->radius[i] : other->radius[j];
        const long double area = excess * ((long double)next - (long double)radius);
        positive += area > 0.0L ? area : 0.0L;
        negative -= area < 0.0L ? area : 0.0L;
        excess += first ? (long double)plays->weight[i] : -(long double)other->weight[j];
        radius = next;
        i += first ? 1 : 0;
        j += first ? 0 : 1;
    }
    return 2.0 * (double)(positive > negative ? positive : negative);
}
