#include "diagnose_trial.h"

#include "diagnose_shrink.h"
#include "effect_record.h"
#include "series.h"
#include <math.h>
#include <stdlib.h>

/// Mean squares over a record: what the plain and the augmented model leave of it, and what the effects add.
typedef struct {
    double before, after, added;
} squares_t;

/// Over the samples from `first` on. Of a record without an output: what the effects add alone.
static squares_t squares_over(const model_t* model, start_t start, const record_t* record, size_t first,
                              const effect_use_t* uses, size_t num_uses)
{
    const size_t n = record->num_samples;
    double* plain = effect_simulate_record(model, start, record, NULL, 0);
    double* augmented = effect_simulate_record(model, start, record, uses, num_uses);
    squares_t squares = {.added = series_mean_square(augmented + first, plain + first, n - first)};
    if (record->output != NULL) {
        squares.before = series_mean_square(plain + first, record->output + first, n - first);
        squares.after = series_mean_square(augmented + first, record->output + first, n - first);
    }
    free(plain);
    free(augmented);
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

/// Of a column's range, how far beyond it is still known: two records of the same work differ by as much.
static const double known_beyond = 0.1;

/// Marks the test record's samples in which the use's column, counted as its effect counts it, lies beyond
/// where the diagnosed record or, at the reference, the bench had it; with a warning.
static void mark_extrapolated(const effect_use_t* use, const record_t* record, const record_t* test,
                              bool* is_beyond)
{
    const double* known = record_find_auxiliary(record, use->column)->value;
    const double* value = record_find_auxiliary(test, use->column)->value;
    const double from_known = use->has_reference ? use->reference : known[0];
    const double from = use->has_reference ? use->reference : value[0];
    double low = 0;
    double high = 0;
    for (size_t t = 0; t < record->num_samples; t++) {
        low = fmin(low, known[t] - from_known);
        high = fmax(high, known[t] - from_known);
    }
    const double margin = known_beyond * (high - low);
    size_t count = 0;
    for (size_t t = 0; t < test->num_samples; t++) {
        const bool beyond = value[t] - from < low - margin || value[t] - from > high + margin;
        is_beyond[t] = is_beyond[t] || beyond;
        count += beyond;
    }
    if (count > 0) {
        message_warning((location_t){.file = test->path},
                        "in %zu of %zu samples the column \"%s\" lies outside %.9g ... %.9g, where bench and "
                        "diagnosed record have it: the effect is continued there",
                        count, test->num_samples, use->column, from + low, from + high);
    }
}

static double find_extrapolated(const effect_use_t* uses, size_t num_uses, const record_t* record,
                                const record_t* test)
{
    bool* is_beyond = xcalloc(test->num_samples, sizeof *is_beyond);
    for (size_t u = 0; u < num_uses; u++) {
        if (uses[u].effect->needs_column) {
            mark_extrapolated(&uses[u], record, test, is_beyond);
        }
    }
    size_t count = 0;
    for (size_t t = 0; t < test->num_samples; t++) {
        count += is_beyond[t];
    }
    free(is_beyond);
    return (double)count / (double)test->num_samples;
}

outcome_t trial_run(const model_t* model, start_t start, const diagnosis_t* diagnosis, const record_t* record,
                    const record_t* test, trial_t* trial)
{
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    const size_t num_uses = diagnosis_handed_out(diagnosis, uses);
    const outcome_t outcome = effect_check_columns(test, uses, num_uses);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    const squares_t here = squares_over(model, start, record, diagnosis->scope.first_judged, uses, num_uses);
    const size_t first = scope_of(model, NULL, test).first_judged;
    const squares_t there = squares_over(model, start, test, first, uses, num_uses);
    *trial = (trial_t){.is_measured = test->output != NULL,
                       .before = sqrt(there.before),
                       .after = sqrt(there.after),
                       .predicted = predict(&here, there.added),
                       .extrapolated = find_extrapolated(uses, num_uses, record, test)};
    return OUTCOME_OK;
}
