#include "effect_record.h"

#include "record_thin.h"
#include "series.h"
#include <stdlib.h>

static double* simulate_over(const model_t* model, start_t start, const record_t* record,
                             const effect_use_t* uses, size_t num_uses)
{
    double* output = xcalloc(record->num_samples, sizeof *output);
    effect_run_t run = effect_run_new(model, record, num_uses > 0);
    effect_simulate(&run, model, start, uses, num_uses, output);
    effect_run_free(&run);
    return output;
}

double* effect_simulate_record(const model_t* model, start_t start, const record_t* record,
                               const effect_use_t* uses, size_t num_uses)
{
    if (record->output == NULL) {
        return simulate_over(model, start, record, uses, num_uses);
    }
    record_t measured = *record;
    measured.carried = NULL; // so that what is carried of the whole is what was lost
    record_t whole = record_thin(&measured, record->num_samples, 0);
    double* output = simulate_over(model, start, &whole, uses, num_uses);
    (void)series_drop_carried(whole.carried, output, whole.num_samples);
    record_free(&whole);
    return output;
}
