/// How far the outputs of two models can come apart that differ in their plays only.
#ifndef HYST_HOST_TRANSPORT_H
#define HYST_HOST_TRANSPORT_H

#include "group_loss.h"

/// A bound on |y - y^| over every input history from negative saturation, where the plays p and p^ carry the
/// same total weight and a constant makes the outputs equal in negative saturation.
///
/// The states as a function of the radius, lambda(r), are 1-Lipschitz; above negative saturation they stand
/// mu(r) = lambda(r) - descending(input_min) - r, with mu' in [-2, 0]. The constant leaves y - y^ =
/// integral mu d(p - p^), by parts -integral mu' G dr with G = F_p - F_p^ (0 at both ends): at most
/// 2 max(integral of G's positive part, integral of its negative part) = W1(p, p^) + |integral r d(p - p^)|.
/// It is W1 itself where the centre of gravity is kept.
double transport_bound(const play_set_t* plays, const play_set_t* other);

#endif
