/// The verdict on a record that the diagnosis has not seen, or on work that is only planned.
#ifndef HYST_HOST_DIAGNOSE_TRIAL_H
#define HYST_HOST_DIAGNOSE_TRIAL_H

#include "diagnose.h"

typedef struct {
    bool is_measured;     ///< whether the test record has an output; else before and after are 0
    double before, after; ///< RMSE of the plain and of the augmented model over what of the test record is
                          ///< judged (diagnose_scope.h)
    double predicted;     ///< shrink expected for the test record's input, its output not looked at
    double
        extrapolated; ///< part of the test record's samples in which a column that an effect follows lies
                      ///< well outside of where bench and record had it, so that its law is continued there
} trial_t;

/// diagnosis: of `record` and `model`, from `start`. Warns of columns that go further than in `record`.
/// OUTCOME_BAD_INPUT (reported) where the test record lacks a column that an effect follows.
outcome_t trial_run(const model_t* model, start_t start, const diagnosis_t* diagnosis, const record_t* record,
                    const record_t* test, trial_t* trial);

#endif
