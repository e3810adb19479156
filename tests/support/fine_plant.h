/// The effect cases' plant computed another way: forward Euler, play by play, 20 steps between two samples,
/// sharing nothing with the effects but the model's numbers.
#ifndef HYST_TESTS_FINE_PLANT_H
#define HYST_TESTS_FINE_PLANT_H

#include "effect_cases.h"

enum { FINE_STEPS = 20 };

/// output[record->num_samples] of the case's plant; the record without further samples.
void fine_plant(const effect_case_t* of, const model_t* model, const record_t* record, double* output);

#endif
