#include "transport.h"
#include <math.h>
#include <stdbool.h>

/// A sum carried with what rounding took from it, so that heavy plays leave light ones their digits.
typedef struct {
    long double sum, lost;
} exact_sum_t;

static void add_exactly(exact_sum_t* total, long double term)
{
    const long double sum = total->sum + term;
    const long double kept = sum - total->sum;
    total->lost += (total->sum - (sum - kept)) + (term - kept);
    total->sum = sum;
}

void transport_pieces(const play_set_t* plays, const play_set_t* other, double limit,
                      transport_piece_t* piece, void* context)
{
    exact_sum_t excess = {0.0L, 0.0L};
    double radius = 0.0;
    size_t i = 0;
    size_t j = 0;
    while (i < plays->num_plays || j < other->num_plays) {
        const bool first =
            j == other->num_plays || (i < plays->num_plays && plays->radius[i] <= other->radius[j]);
        const double next = fmin(first ? plays->radius[i] : other->radius[j], limit);
        if (next > radius) {
            piece(context, radius, next, (double)(excess.sum + excess.lost));
        }
        add_exactly(&excess, first ? (long double)plays->weight[i] : -(long double)other->weight[j]);
        radius = next;
        i += first ? 1 : 0;
        j += first ? 0 : 1;
    }
    if (limit > radius) {
        piece(context, radius, limit, (double)(excess.sum + excess.lost));
    }
}

typedef struct {
    long double below, above;
} areas_t;

static void add_area(void* context, double from, double to, double excess)
{
    areas_t* areas = context;
    const long double area = 2.0L * (long double)excess * ((long double)to - (long double)from);
    areas->above += area > 0.0L ? area : 0.0L;
    areas->below -= area < 0.0L ? area : 0.0L;
}

transport_t transport_between(const play_set_t* plays, const play_set_t* other, double limit)
{
    areas_t areas = {0.0L, 0.0L};
    transport_pieces(plays, other, limit, add_area, &areas);
    return (transport_t){(double)areas.below, (double)areas.above};
}

double transport_bound(transport_t transport, double constant)
{
    return fmax(fabs(constant + transport.above), fabs(constant - transport.below));
}

double transport_centre(transport_t transport)
{
    return 0.5 * (transport.below - transport.above);
}
