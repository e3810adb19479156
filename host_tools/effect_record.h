/// The model with effects over a record as its plant saw it.
#ifndef HYST_HOST_EFFECT_RECORD_H
#define HYST_HOST_EFFECT_RECORD_H

#include "effect.h"

/// The output at each of the record's samples, allocated. Where an output was measured, a logger may have
/// lost samples, which the plant saw: the run is over the record with them (record_fill.h). A command without
/// an output is what it says.
double* effect_simulate_record(const model_t* model, start_t start, const record_t* record,
                               const effect_use_t* uses, size_t num_uses);

#endif
