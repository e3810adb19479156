/// How far the outputs of two models can come apart that differ in their plays and a constant only.
#ifndef HYST_HOST_TRANSPORT_H
#define HYST_HOST_TRANSPORT_H

#include "group_loss.h"

/// y - y^ over all input histories lies within [constant - below, constant + above], where `constant` is y -
/// y^ in negative saturation. Both ends are reached (worst_input.h).
///
/// The states as a function of the radius, lambda(r), are 1-Lipschitz, and lambda(limit) never changes, limit
/// being model_largest_moving_radius. Above negative saturation they stand lambda(r) - descending(input_min)
/// - r = integral of s from r to limit, with s between 0 and 2. So y - y^ = constant + integral of s G, G =
/// F_p - F_p^ the difference of the weights up to r, whether or not the two have the same total. above = 2
/// integral of G's positive part over [0, limit], below = 2 integral of its negative part.
typedef struct {
    double below, above; ///< output units, >= 0
} transport_t;

/// Radii beyond the limit count as the limit.
transport_t transport_between(const play_set_t* plays, const play_set_t* other, double limit);

/// The largest |y - y^|.
double transport_bound(transport_t transport, double constant);

/// The constant that makes the bound least. The bound is then (below + above) / 2, the Wasserstein distance
/// W1 = integral of |G| over [0, limit].
double transport_centre(transport_t transport);

/// Hands on the pieces of [0, limit] on which G has one value, in the order of the radii.
typedef void transport_piece_t(void* context, double from, double to, double excess);
void transport_pieces(const play_set_t* plays, const play_set_t* other, double limit,
                      transport_piece_t* piece, void* context);

#endif
