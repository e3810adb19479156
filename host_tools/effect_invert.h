/// The inverse of a model with effects.
#ifndef HYST_HOST_EFFECT_INVERT_H
#define HYST_HOST_EFFECT_INVERT_H

#include "effect.h"

/// Whether every use has an inverse; else OUTCOME_BAD_INPUT with the effect's name and the reason.
outcome_t effect_check_inverse(const char* model_path, const effect_use_t* uses, size_t num_uses);

/// The command within the model's range whose effect_simulate gives wanted[num_samples]; every use has an
/// inverse. The whole wanted course is known, so that lags are met by leads. clamped[num_samples]: 1 where a
/// stage could not reach what was asked of it, else 0. run->input is not read.
void effect_invert(const effect_run_t* run, const model_t* model, start_t start, const effect_use_t* uses,
                   size_t num_uses, const double* wanted, double* input, double* clamped);

#endif
