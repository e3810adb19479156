/// The frame of the verbs that run a model over a record: hyst VERB MODEL RECORD -o RECORD.
#ifndef HYST_HOST_MODEL_RUN_H
#define HYST_HOST_MODEL_RUN_H

#include "command.h"
#include "effect.h"

typedef struct {
    const model_t* model;
    const record_t* record;
    start_t start;
    const char* model_path;
    const effect_use_t* uses; ///< [num_uses] the model's effects
    size_t num_uses;
    const char* output; ///< where the resulting record goes, as record_write takes it
    bool report;        ///< whether stdout is free for the result in words or, with `json`, in JSON
    bool json;
} model_run_t;

/// What the verb does with them.
typedef outcome_t model_run_work_t(const model_run_t* run);

/// OUTCOME_NUMERICAL with a message where a value is no number, which only effects with extreme parameters
/// bring about.
outcome_t model_run_check_finite(const model_run_t* run, const char* what, const double* values);

/// Parses the arguments, reads model and record (with the columns that `needs` asks for) and calls `work`.
outcome_t model_run(const command_t* command, record_options_t needs, model_run_work_t* work, int argc,
                    const char** argv);

#endif
