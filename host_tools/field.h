/// What the hysteretic part of a material sees of the input when the field inside lags behind the one
/// applied: by diffusion across a conductor (eddy currents) and by the excess field that moving walls take.
///     diffusion: heat equation across a lamination, its mean: sum_k a_k LP_k(v), a_k = 8 / (pi (2k+1))^2,
///                LP_k a first-order lag of tau / (2k+1)^2
///     excess:    d seen/dt = ((v - seen) / excess)^2, signed: on a ramp it trails by excess * sqrt(rate)
/// Both exact for the input between the samples, but for the modes beyond the sixth, 3 % of the weight with
/// time constants below tau / 169, which are taken as instantaneous, and for an excess field behind a
/// diffusion, whose course is taken to go straight. Sources: G. Bertotti,
/// IEEE Trans. Magn. 24 (1988) 621 (classical and excess field).
#ifndef HYST_HOST_FIELD_H
#define HYST_HOST_FIELD_H

#include "lag_step.h"
#include <stdbool.h>

enum { FIELD_MODES = 6 };

typedef struct {
    double diffusion; ///< [s] time constant of the slowest mode, 0: none
    double excess;    ///< [input units / sqrt(input units/s)], 0: none
    double share;     ///< of the nonhysteretic part that sees this field too; the rest sees the input itself
    double hold;      ///< how far the input is on its way as a sample begins: 0, it goes straight; 1, it is
                      ///< there at once
} field_t;

bool field_is_neutral(const field_t* field);

typedef struct {
    double input;
    double mode[FIELD_MODES];
    lag_kept_t lag[FIELD_MODES];
    double diffused; ///< the mean across the lamination
    double seen;     ///< behind the excess field: what the hysteretic part sees
} field_state_t;

/// At rest at the input.
field_state_t field_start(double input);
/// The input moves to `input` in `step` seconds; of the same field as the last. Behind a diffusion the excess
/// field's input goes straight.
void field_move(const field_t* field, field_state_t* state, double input, double step);

#endif
