/// Whether a record can be diagnosed at all.
#ifndef HYST_HOST_DIAGNOSE_CHECK_H
#define HYST_HOST_DIAGNOSE_CHECK_H

#include "model.h"
#include "record.h"

/// OUTCOME_BAD_INPUT (reported) for a record that is too short, whose input or output is constant, or whose
/// time has gaps.
outcome_t diagnose_check(const model_t* model, const record_t* record);

#endif
