#include "diagnose_trial.h"

#include "diagnose_shrink.h"
#include <math.h>
#include <stdlib.h>

/// Mean squares over a record: what the plain and the augmented model leave of it, and what the effects add.
typedef struct {
    double before, after, added;
} squares_t;

static double mean_square_between(const double* a, const double* b, size_t n)
{
    double sum = 0;
    for (size_t t = 0; t < n; t++) {
        sum += (a[t] - b[t]) * (a[t] - b[t]);
    }
    return sum / (double)n;
}

static squares_t squares_over(const model_t* model, start_t start, const record_t* record,
                              const effect_use_t* uses, size_t num_uses)
{
    const size_t n = record->num_samples;
    effect_run_t run = effect_run_new(model, record);
    double* plain = xmalloc(n * sizeof *plain);
    double* augmented = xmalloc(n * sizeof *augmented);
    effect_simulate(&run, model, start, NULL, 0, plain);
    effect_simulate(&run, model, start, uses, num_uses, augmented);
    const squares_t squares = {mean_square_between(plain, record->output, n),
                               mean_square_between(augmented, record->output, n),
                               mean_square_between(augmented, plain, n)};
    free(plain);
    free(augmented);
    effect_run_free(&run);
    return squares;
}

/// What the augmented model leaves is expected to be the record's, and to go with what the effects add as it
/// does there: before^2 = after^2 + added^2 + 2 correlation * after * added.
static double predict(const squares_t* here, double added)
{
    const double after = sqrt(here->after);
    const double crossed = here->before - here->after - here->added;
    const double both = 2 * sqrt(here->after * here->added);
    const double correlation = both > 0 ? fmin(fmax(crossed / both, -1), 1) : 0;
    const double before = here->after + added + 2 * correlation * sqrt(here->after * added);
    return before > 0 ? 1 - after / sqrt(before) : 0;
}

/// What of the verdict holds on another record.
static size_t uses_elsewhere(const diagnosis_t* d, effect_use_t* uses)
{
    const size_t num_uses = d->is_unknown ? 0 : cause_handed_out(&d->cause[0], uses);
    size_t count = 0;
    for (size_t i = 0; i < num_uses; i++) {
        if (!uses[i].is_of_one_record) {
            uses[count++] = uses[i];
        }
    }
    return count;
}

outcome_t trial_run(const model_t* model, start_t start, const diagnosis_t* diagnosis, const record_t* record,
                    const record_t* test, trial_t* trial)
{
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    const size_t num_uses = uses_elsewhere(diagnosis, uses);
    const outcome_t outcome = effect_check_columns(test, uses, num_uses);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    const squares_t here = squares_over(model, start, record, uses, num_uses);
    const squares_t there = squares_over(model, start, test, uses, num_uses);
    *trial = (trial_t){sqrt(there.before), sqrt(there.after), predict(&here, there.added)};
    return OUTCOME_OK;
}
