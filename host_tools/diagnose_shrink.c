#include "diagnose_shrink.h"

#include "forecast.h"
#include "series.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void shrink_simulate(const gap_t* gap, const effect_run_t* run, const effect_use_t* uses, size_t num_uses,
                     double* output)
{
    effect_run_t alone = *run;
    alone.body = NULL;
    alone.everett = NULL;
    alone.body_middle = NULL;
    effect_simulate(&alone, gap->model, gap->start, uses, num_uses, output);
}

/// Sum of squares of each block between two series, over the judged samples.
static void block_distances(const gap_t* gap, const double* a, const double* b, double* square)
{
    size_t t = 0;
    for (size_t k = 0; k < HYPOTHESIS_BLOCKS; k++) {
        square[k] = 0;
        for (; t < gap->block_end[k]; t++) {
            const double e = gap_is_judged(gap, t) ? a[t] - b[t] : 0;
            square[k] += e * e;
        }
    }
}

void shrink_block_errors(const gap_t* gap, const effect_use_t* uses, size_t num_uses, double* error)
{
    double* predicted = xmalloc(gap->run->num_samples * sizeof *predicted);
    shrink_simulate(gap, gap->run, uses, num_uses, predicted);
    block_distances(gap, predicted, gap->output, error);
    free(predicted);
}

void shrink_average(const gap_t* gap, const cause_t* cause, size_t num_causes, double* average)
{
    const size_t n = gap->run->num_samples;
    double* predicted = xmalloc(n * sizeof *predicted);
    double total = 0;
    for (size_t t = 0; t < n; t++) {
        average[t] = 0;
    }
    for (size_t k = 0; k < num_causes; k++) {
        const hypothesis_t* h = cause[k].hypothesis;
        shrink_simulate(gap, gap->run, h->use, h->num_uses, predicted);
        total += cause[k].probability;
        for (size_t t = 0; t < n; t++) {
            average[t] += cause[k].probability / total * (predicted[t] - average[t]);
        }
    }
    free(predicted);
}

static effect_use_t for_another_record(const effect_use_t* fitted)
{
    effect_use_t use = *fitted;
    if (use.effect->for_another_record != NULL) {
        use.effect->for_another_record(use.parameter);
    }
    return use;
}

size_t cause_handed_out(const cause_t* cause, effect_use_t* uses)
{
    size_t count = 0;
    for (size_t i = 0; i < cause->hypothesis->num_uses; i++) {
        if (!cause->is_kept_back[i]) {
            uses[count] = for_another_record(&cause->hypothesis->use[i]);
            uses[count].is_of_one_record = cause->is_of_one_record[i] || !uses[count].effect->transferable;
            count++;
        }
    }
    return count;
}

size_t diagnosis_handed_out(const diagnosis_t* diagnosis, effect_use_t* uses)
{
    return diagnosis->is_unknown ? 0 : cause_handed_out(&diagnosis->cause[0], uses);
}

/// Likelihood ratio, chi-squared of one number, below which a record says nothing of it: 5 % level.
static const double no_evidence = 3.84;

static double left_by(const gap_t* gap, const hypothesis_t* h)
{
    double error[HYPOTHESIS_BLOCKS];
    shrink_block_errors(gap, h->use, h->num_uses, error);
    return series_sum(error, HYPOTHESIS_BLOCKS);
}

/// By golden section: the value, 0 ... 1, with which the model itself leaves least of the record.
static void fit_to_model(const gap_t* gap, hypothesis_t* hypothesis, double* parameter)
{
    enum { STEPS = 14 };
    const double part = 0.5 * (sqrt(5) - 1);
    double low = 0;
    double high = 1;
    double inner[2] = {1 - part, part};
    double left[2];
    for (size_t k = 0; k < 2; k++) {
        *parameter = inner[k];
        left[k] = left_by(gap, hypothesis);
    }
    for (int i = 0; i < STEPS; i++) {
        const size_t worse = left[0] > left[1] ? 0 : 1;
        const size_t better = 1 - worse;
        *(worse == 0 ? &low : &high) = inner[worse];
        inner[worse] = inner[better];
        left[worse] = left[better];
        inner[better] = low + high - inner[worse];
        *parameter = inner[better];
        left[better] = left_by(gap, hypothesis);
    }
    *parameter = left[0] < left[1] ? inner[0] : inner[1];
}

void shrink_settle(const gap_t* gap, hypothesis_t* hypothesis)
{
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        effect_use_t* use = &hypothesis->use[i];
        for (size_t p = 0; gap->run->body != NULL && p < use->effect->num_parameters; p++) {
            if (use->effect->parameter[p].of_model) {
                fit_to_model(gap, hypothesis, &use->parameter[p]);
            }
        }
    }
    const double left = left_by(gap, hypothesis);
    const double tells = left * no_evidence / (double)gap->num_judged;
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        effect_use_t* use = &hypothesis->use[i];
        for (size_t p = 0; p < use->effect->num_parameters; p++) {
            const double fitted = use->parameter[p];
            use->parameter[p] = effect_use_limits(gap->run, use, p).neutral;
            const bool is_wrong = use->effect->fault != NULL && use->effect->fault(use->parameter) != NULL;
            if (is_wrong || fabs(left_by(gap, hypothesis) - left) > tells) {
                use->parameter[p] = fitted;
            }
        }
    }
}

static void predict_without(const gap_t* gap, const hypothesis_t* h, const bool* is_out, double* predicted)
{
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    size_t count = 0;
    for (size_t i = 0; i < h->num_uses; i++) {
        if (!is_out[i]) {
            uses[count++] = for_another_record(&h->use[i]);
        }
    }
    shrink_simulate(gap, gap->run, uses, count, predicted);
}

/// Of the mean square without it, what a converter's rounding may leave to be handed out. Where the model
/// misses the output by a part x of a step, its rounding falls to another code than the plant's as often as
/// that is crossed: 0.8 x of a step's square is left instead of x^2 + 1/12. From x = 0.12 on rounding does
/// harm, and at 0.07, where it leaves this part, another record's x may be that.
static const double rounding_helps = 0.64;

static bool is_nearer(const gap_t* gap, const double* a, const double* b, double part, const double* target)
{
    double of_a[HYPOTHESIS_BLOCKS];
    double of_b[HYPOTHESIS_BLOCKS];
    block_distances(gap, a, target, of_a);
    block_distances(gap, b, target, of_b);
    return part * series_sum(of_a, HYPOTHESIS_BLOCKS) < series_sum(of_b, HYPOTHESIS_BLOCKS);
}

/// Takes out the first effect that does harm beside the others: without it the record is met better, or what
/// is expected of all causes together. Returns whether there was one.
static bool take_one_out(const gap_t* gap, const double* average, const hypothesis_t* h, bool* is_out)
{
    const size_t n = gap->run->num_samples;
    double* with = xmalloc(n * sizeof *with);
    double* without = xmalloc(n * sizeof *without);
    bool taken = false;
    predict_without(gap, h, is_out, with);
    for (size_t i = 0; !taken && i < h->num_uses; i++) {
        if (is_out[i]) {
            continue;
        }
        is_out[i] = true;
        predict_without(gap, h, is_out, without);
        const double part = h->use[i].effect->rounds ? rounding_helps : 1;
        taken = is_nearer(gap, without, with, part, gap->output) ||
                (average != NULL && is_nearer(gap, without, with, 1, average));
        is_out[i] = taken;
    }
    free(with);
    free(without);
    return taken;
}

/// What was fitted beside a course of this record alone may only make up for it: it holds elsewhere if it
/// helps without that.
static void bind_to_record(const gap_t* gap, cause_t* cause)
{
    const hypothesis_t* h = cause->hypothesis;
    bool is_out[HYPOTHESIS_MAX_EFFECTS] = {false};
    for (size_t i = 0; i < h->num_uses; i++) {
        is_out[i] = cause->is_kept_back[i] || !h->use[i].effect->transferable;
    }
    while (take_one_out(gap, NULL, h, is_out)) {
    }
    for (size_t i = 0; i < h->num_uses; i++) {
        cause->is_of_one_record[i] = is_out[i] && !cause->is_kept_back[i];
    }
}

void shrink_find(const gap_t* gap, const double* plain, bool held_out, const double* average, cause_t* cause)
{
    double left[HYPOTHESIS_BLOCKS];
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    while (take_one_out(gap, average, cause->hypothesis, cause->is_kept_back)) {
    }
    bind_to_record(gap, cause);
    const size_t count = cause_handed_out(cause, uses);
    bool is_fitted = count == cause->hypothesis->num_uses;
    for (size_t i = 0; i < count; i++) {
        is_fitted = is_fitted && memcmp(uses[i].parameter, cause->hypothesis->use[i].parameter,
                                        sizeof uses[i].parameter) == 0;
    }
    if (held_out && is_fitted) {
        memcpy(left, cause->hypothesis->block_error, sizeof left);
    } else {
        shrink_block_errors(gap, uses, count, left);
    }
    const forecast_t forecast = forecast_shrink(left, plain, HYPOTHESIS_BLOCKS);
    cause->rmse_after = sqrt(series_sum(left, HYPOTHESIS_BLOCKS) / (double)gap->num_judged);
    cause->shrink = forecast.shrink;
    cause->shrink_low = forecast.low;
    cause->shrink_high = forecast.high;
}

/// What is forecast for another record's own input is off by this in the median.
static const double forecasts_are_off = 0.02;

void shrink_mind_doubt(const gap_t* gap, const double* plain, cause_t* cause)
{
    if (cause->shrink < forecasts_are_off) {
        for (size_t i = 0; i < cause->hypothesis->num_uses; i++) {
            cause->is_kept_back[i] = true;
        }
        shrink_find(gap, plain, false, NULL, cause);
    }
}
