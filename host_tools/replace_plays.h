/// Other plays in the place of a model's own, and what that may change.
#ifndef HYST_HOST_REPLACE_PLAYS_H
#define HYST_HOST_REPLACE_PLAYS_H

#include "model.h"
#include "transport.h"

/// What takes the place of a model's moving plays.
typedef struct {
    play_set_t plays;       ///< radii within those of the moving plays; num_plays may be 0
    double envelope_weight; ///< weight moved to r = 0: added to the non-hysteretic part as that much envelope
    bool centred;           ///< the constant makes the error bound least
    double constant;        ///< otherwise: y - y^ in negative saturation
} replacement_t;

/// Plays that do not move (r >= model_largest_moving_radius) come last.
size_t model_count_moving(const model_t* model);
/// Whether the envelope itself can go into the non-hysteretic part: equal envelopes, and a sum that is a
/// curve.
bool model_takes_envelope(const model_t* model);

/// The model with these plays: what does not move becomes part of the constant, `initial` is interpolated in
/// the radius; without plays one of weight 0 remains.
model_t replace_plays(const model_t* model, const replacement_t* replacement);

/// What the replacement may change over all inputs within the range, from negative saturation; from any start
/// (CONTRACT, --initial) where no radius is above the limit. transport_bound with the replacement's constant
/// bounds |y - y^|, but for the rounding of the constant.
transport_t replacement_transport(const model_t* model, const replacement_t* replacement);

/// transport_pieces of the same.
void replacement_pieces(const model_t* model, const replacement_t* replacement, transport_piece_t* piece,
                        void* context);

#endif
