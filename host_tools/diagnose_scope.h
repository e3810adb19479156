/// What of a record a model can be judged by: from where on its memory is known, how much of its input lies
/// where the model was identified, and whether that input is periodic.
#ifndef HYST_HOST_DIAGNOSE_SCOPE_H
#define HYST_HOST_DIAGNOSE_SCOPE_H

#include "effect.h"

/// How many samples at the record's start are not to be judged by. Where identify left out the calibration's
/// start, since no memory that it can assume explains it, the same plant's record is left out likewise, to
/// where both ends of its own input range were visited; 0 where that takes too much of the record.
size_t scope_first_judged(const model_t* model, const record_t* record);
/// The part of the samples, 0 ... 1, whose input lies beyond the model's range: what the model says there was
/// never measured.
double scope_beyond(const model_t* model, const record_t* record);
/// The frequency of the line that carries more than half of the input's variance, of at least four periods;
/// 0: there is none.
double scope_input_frequency(const effect_run_t* run);

#endif
