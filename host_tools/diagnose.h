/// Diagnosis of the gap between a model and a record: where it lies, which effect causes it, how far it
/// shrinks.
#ifndef HYST_HOST_DIAGNOSE_H
#define HYST_HOST_DIAGNOSE_H

#include "diagnose_hypothesis.h"
#include "diagnose_next.h"
#include "diagnose_scope.h"
#include "diagnose_where.h"

typedef struct {
    start_t start;
    double
        calibration_rmse; ///< the model's misfit on the record it was identified from [output], 0: not known
    double calibration_noise; ///< that record's own noise [output], 0: not known
    /// That record, or NULL: for the body that the plant has and what is open about it, the loops that were
    /// made, its converter's steps and the auxiliary columns' values then.
    const record_t* calibration;
    size_t num_threads; ///< for the searches, which find the same on any number; 0: one a processor
} diagnose_options_t;

enum { DIAGNOSIS_MOST_CAUSES = 12 };

/// A candidate explanation as reported.
typedef struct {
    const hypothesis_t* hypothesis;
    double probability;
    /// Of the model with the effects handed out, over what is judged: by fits to other stretches where the
    /// model's own plays are judged, without a converter's steps, and all its effects are handed out; else by
    /// the fit to the whole.
    double rmse_after;
    double shrink, shrink_low, shrink_high;        ///< with the effects that are handed out
    bool is_kept_back[HYPOTHESIS_MAX_EFFECTS];     ///< an effect of it that would not help another record
    bool is_of_one_record[HYPOTHESIS_MAX_EFFECTS]; ///< an effect of it that holds for this record alone
} cause_t;

typedef struct {
    size_t num_samples; ///< of the record
    size_t num_judged;  ///< that the causes were judged by: all, or those of its stretches (record_thin.h)
    scope_t scope;
    double rmse, relative, noise, noise_floor, closable;
    size_t num_regions;
    region_t region[WHERE_MAX_REGIONS];
    size_t num_causes; ///< at most DIAGNOSIS_MOST_CAUSES
    cause_t* cause;    ///< [num_causes] the verdict's, then the likeliest first
    size_t num_hypotheses;
    hypothesis_t* hypothesis; ///< owns what the causes point to
    double* before;           ///< [num_samples] the model's output
    double* after;            ///< [num_samples] with the effects that the verdict hands out
    bool is_unknown;          ///< the verdict is ["unknown"]
    bool is_none;             ///< the verdict is []
    bool confident;
    size_t num_indistinguishable;
    size_t indistinguishable[8]; ///< indices into cause
    char advice[800];
    next_input_t next; ///< the experiment that the advice names; no samples where there is none
} diagnosis_t;

/// record: time or none, input and output; path is for messages. OUTCOME_BAD_INPUT (reported) for a record
/// that cannot be judged: too short, constant input or output, gaps in time. OUTCOME_NUMERICAL (reported)
/// where the gap's square is beyond a double's range. Free what it holds whatever it returns.
outcome_t diagnose(const model_t* model, const record_t* record, const diagnose_options_t* options,
                   diagnosis_t* diagnosis);
void diagnosis_free(diagnosis_t* diagnosis);

#endif
