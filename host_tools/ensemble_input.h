/// The ensemble of inputs that `ensemble` averages over: seeded reversal inputs within a model's range.
#ifndef HYST_HOST_ENSEMBLE_INPUT_H
#define HYST_HOST_ENSEMBLE_INPUT_H

#include "model.h"

/// The inputs one after the other, as the plays see them. Each begins with a fall to input_min, which is
/// negative saturation whatever was before. Envelope values v are scaled to (v - level) / unit, so that
/// radii, divided by the unit, are below 1, whatever the model's magnitudes.
typedef struct {
    double level, unit; ///< descending(input_min) and the largest moving radius
    size_t num_samples;
    double* ascending;  ///< [num_samples] ascending envelope at the input, scaled, owned
    double* descending; ///< [num_samples] descending envelope
} drive_t;

/// 96 inputs of 24 reversals, a sample every 1/40 of the range along each ramp, so that all stretches of the
/// way count alike. Of four inputs two have reversal points uniform over the range; one alternates about
/// uniform centres with amplitudes whose square root is uniform, so that small loops occur at all levels; one
/// consists of nested loops, each 0.5 ... 0.95 times as wide as the one before, begun anew when below 1/50.
/// The model has a play that moves.
drive_t drive_new(const model_t* model);
/// One given input, from negative saturation; its reversals may lie anywhere in the range.
drive_t drive_of(const model_t* model, const double* input, size_t num_samples);
void drive_free(drive_t* drive);

/// The scaled states of the play with this scaled radius, counted from negative saturation:
/// state[num_samples], 0 ... 2. slope[num_samples], unless NULL, gets their derivatives in the radius: -2
/// where the ascending envelope moved the play last, 0 where the descending did.
void drive_states(const drive_t* drive, double radius, double* state, double* slope);

#endif
