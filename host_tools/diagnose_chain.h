/// --chain: the models between the identified one and the firmware, and the error budget over them.
#ifndef HYST_HOST_DIAGNOSE_CHAIN_H
#define HYST_HOST_DIAGNOSE_CHAIN_H

#include "diagnose.h"
#include "diagnose_budget.h"

/// How --help names the option's three words.
#define CHAIN_ARGUMENTS "FULL.json COMPRESSED.json f32|q31|q15"

/// The option's words, as they stand in argv; full is NULL where the option was not given.
typedef struct {
    const char* full;
    const char* compressed;
    const char* scalar;
} chain_paths_t;

typedef struct {
    chain_paths_t paths;
    scalar_t scalar;
    model_t full;
    model_t compressed;
} chain_t;

/// Takes "--chain A B C" (or "--chain=A B C") out of argv[argc], which popt could not read, and copies the
/// others to rest[argc + 1]; returns how many. A --chain with fewer words stays.
int chain_take(int argc, const char** argv, const char** rest, chain_paths_t* paths);

/// Reads both models and checks that firmware can be made of them. Free what it holds whatever it returns.
outcome_t chain_read(const chain_paths_t* paths, chain_t* chain);
void chain_free(chain_t* chain);

/// A model's RMSE on the record it was identified from, and in *noise that record's own.
double chain_misfit(const model_t* model, start_t start, const record_t* calibration, double* noise);

/// The budget on the record, with the diagnosis's verdict as the unmodelled effects.
outcome_t chain_budget(const chain_t* chain, const record_t* record, const diagnose_options_t* options,
                       const diagnosis_t* diagnosis, budget_t* budget);

#endif
