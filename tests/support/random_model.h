/// Random valid models and inputs, for properties that must hold for every one of them.
#ifndef HYST_TESTS_RANDOM_MODEL_H
#define HYST_TESTS_RANDOM_MODEL_H

#include "model.h"
#include "random.h"

/// Linear, tanh or table envelopes (each model a mix), 1 to 40 plays, some of weight 0, some of equal radius,
/// some that never move.
model_t random_model(random_t* random);
/// A classical PI model: both envelopes the identity, D linear.
model_t random_classical_model(random_t* random);
/// Ramps, jumps and holds within the model's input range.
void random_input(random_t* random, const model_t* model, double* input, size_t num_samples);

/// What rounding may do to an output: every envelope value and state is right to 4 eps of the largest
/// magnitude that enters it, and a sum of n terms adds at most n eps of the sum of their magnitudes.
double output_rounding(const model_t* model);
/// Likewise for one play's state.
double state_rounding(const model_t* model);
/// The largest slope of the curve.
double curve_steepness(const curve_t* curve);

#endif
