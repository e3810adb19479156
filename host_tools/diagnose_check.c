#include "diagnose_check.h"

#include <math.h>

enum { LEAST_SAMPLES = 200 };

outcome_t diagnose_check(const model_t* model, const record_t* record)
{
    const location_t where = {.file = record->path};
    if (record->num_samples < LEAST_SAMPLES) {
        return message_error(OUTCOME_BAD_INPUT, where,
                             "%zu samples are too few to diagnose, expected at least %d", record->num_samples,
                             LEAST_SAMPLES);
    }
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    double least = HUGE_VAL;
    double largest = -HUGE_VAL;
    double step = 0;
    for (size_t t = 0; t < record->num_samples; t++) {
        low = fmin(low, record->input[t]);
        high = fmax(high, record->input[t]);
        least = fmin(least, record->output[t]);
        largest = fmax(largest, record->output[t]);
        step = fmax(step, t > 0 && record->time != NULL ? record->time[t] - record->time[t - 1] : 0);
    }
    if (!(largest > least)) {
        return message_error(OUTCOME_BAD_INPUT, where,
                             "the output is %g throughout, expected one that answers the input", least);
    }
    if (!(high - low > 0.01 * (model->input_max - model->input_min))) {
        return message_error(
            OUTCOME_BAD_INPUT, where,
            "the input stays within %g ... %g, expected excitation of at least 1 %% of the model's range",
            low, high);
    }
    if (record->time != NULL && step > 0.1 * (record->time[record->num_samples - 1] - record->time[0])) {
        return message_error(
            OUTCOME_BAD_INPUT, where,
            "the time has a gap of %g s, more than a tenth of the record, expected a continuous record",
            step);
    }
    return OUTCOME_OK;
}
