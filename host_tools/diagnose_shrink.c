#include "diagnose_shrink.h"

#include "forecast.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// An effect of a doubtful cause is not handed out where it might make another record worse by more than
/// this.
static const double bearable = 0.02;

void shrink_simulate(const gap_t* gap, const effect_run_t* run, const effect_use_t* uses, size_t num_uses,
                     double* output)
{
    effect_run_t alone = *run;
    alone.body = NULL;
    alone.correction = NULL;
    effect_simulate(&alone, gap->model, gap->start, uses, num_uses, output);
}

void shrink_block_errors(const gap_t* gap, const effect_use_t* uses, size_t num_uses, double* error)
{
    double* predicted = xmalloc(gap->run->num_samples * sizeof *predicted);
    shrink_simulate(gap, gap->run, uses, num_uses, predicted);
    size_t t = 0;
    for (size_t b = 0; b < HYPOTHESIS_BLOCKS; b++) {
        error[b] = 0;
        for (; t < gap->block_end[b]; t++) {
            const double e = gap_is_judged(gap, t) ? predicted[t] - gap->output[t] : 0;
            error[b] += e * e;
        }
    }
    free(predicted);
}

size_t cause_handed_out(const cause_t* cause, effect_use_t* uses)
{
    size_t count = 0;
    for (size_t i = 0; i < cause->hypothesis->num_uses; i++) {
        if (!cause->is_kept_back[i]) {
            uses[count++] = cause->hypothesis->use[i];
        }
    }
    return count;
}

static double sum_of(const double* values)
{
    double sum = 0;
    for (size_t b = 0; b < HYPOTHESIS_BLOCKS; b++) {
        sum += values[b];
    }
    return sum;
}

/// What the effects still handed out leave.
static void errors_of(const gap_t* gap, const cause_t* cause, double* error)
{
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    const size_t count = cause_handed_out(cause, uses);
    shrink_block_errors(gap, uses, count, error);
}

/// Keeps back the first effect that does harm: without it the record itself is met better (an output rounded
/// like the plant's is only nearer to it where the model is off by less than half a step), or, of a doubtful
/// cause, another record may be made worse. Returns whether there was one.
static bool keep_one_back(const gap_t* gap, bool doubtful, cause_t* cause)
{
    double with[HYPOTHESIS_BLOCKS];
    double without[HYPOTHESIS_BLOCKS];
    errors_of(gap, cause, with);
    for (size_t i = 0; i < cause->hypothesis->num_uses; i++) {
        if (cause->is_kept_back[i]) {
            continue;
        }
        cause->is_kept_back[i] = true;
        errors_of(gap, cause, without);
        const forecast_t own = forecast_shrink(with, without, HYPOTHESIS_BLOCKS);
        if (own.shrink < 0 || (doubtful && own.low < -bearable)) {
            return true;
        }
        cause->is_kept_back[i] = false;
    }
    return false;
}

void shrink_find(const gap_t* gap, const double* plain, bool held_out, bool doubtful, cause_t* cause)
{
    double left[HYPOTHESIS_BLOCKS];
    bool is_whole = true;
    while (keep_one_back(gap, doubtful, cause)) {
        is_whole = false;
    }
    if (held_out && is_whole) {
        memcpy(left, cause->hypothesis->block_error, sizeof left);
    } else {
        errors_of(gap, cause, left);
    }
    const forecast_t forecast = forecast_shrink(left, plain, HYPOTHESIS_BLOCKS);
    cause->rmse_after = sqrt(sum_of(left) / (double)gap->num_judged);
    cause->shrink = forecast.shrink;
    cause->shrink_low = forecast.low;
    cause->shrink_high = forecast.high;
}
