/// What a model's output spans between its two saturations.
#ifndef HYST_HOST_OUTPUT_RANGE_H
#define HYST_HOST_OUTPUT_RANGE_H

#include "model.h"

/// The output at the end of a descent to input_min, and of an ascent to input_max from there: every output of
/// a run from negative saturation lies between the two.
double model_output_min(const model_t* model);
double model_output_max(const model_t* model);

#endif
