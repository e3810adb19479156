/// A diagnosis as CONTRACT's JSON.
#ifndef HYST_HOST_DIAGNOSE_JSON_H
#define HYST_HOST_DIAGNOSE_JSON_H

#include "diagnose.h"
#include "diagnose_budget.h"

/// "hyst-diagnosis", owned by the caller, as are the others.
json_t* diagnosis_to_json(const diagnosis_t* diagnosis);
/// Effects with their parameters, as a model's `effects` holds them.
json_t* parameters_to_json(const effect_use_t* uses, size_t num_uses);
/// [{"part", "rmse", "share"}], largest first.
json_t* budget_to_json(const budget_t* budget);

#endif
