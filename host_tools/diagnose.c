#include "diagnose.h"

#include "diagnose_check.h"
#include "diagnose_structure.h"
#include "parallel.h"
#include "record_thin.h"
#include "resample.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SINGLES = 64, MAX_HYPOTHESES = 700 };
enum {
    SINGLE_EVALUATIONS = 40,
    PAIR_EVALUATIONS = 24,
    LEADING_SINGLES = 5,
    REFINED_PAIRS = 6,
    LAST_EVALUATIONS = 20
};

/// Part of the gap's energy that one more effect beside another must gain: what the first one's own physics,
/// a little other than the plant's, leaves is no second effect.
static const double further_part = 3e-3;
/// Samples by which a long record is judged, and those that the verdict's parameters are then fitted to.
static const size_t most_judged = 12000;
static const size_t most_fitted = 1000000;
/// Independent stretches that a record counts for at most when hypotheses are weighed against each other.
static const double most_evidence = 80;

/// What the verdict is weighed with, in squares of output units.
typedef struct {
    double noise;   ///< the sensor's
    double misfit;  ///< the model's own, as its calibration shows it
    double penalty; ///< what the first effect must gain
    double further; ///< what each further one must gain
    double doubt;   ///< how far the misfit may favour a wrong effect
} scale_t;

typedef struct {
    gap_t gap;
    const record_t* calibration; ///< or NULL
    scale_t scale;
    size_t count;
    hypothesis_t* hypothesis; ///< [MAX_HYPOTHESES], 0 is the plain model
    double evidence;          ///< independent pieces of evidence in the record
    size_t num_threads;
    size_t num_singles; ///< hypotheses 1 ... num_singles have one effect each
} work_t;

static double mean_square(const hypothesis_t* hypothesis)
{
    return hypothesis->held_out_rmse * hypothesis->held_out_rmse;
}

static double score(const work_t* w, const hypothesis_t* hypothesis)
{
    const size_t uses = hypothesis->num_uses;
    return mean_square(hypothesis) +
           (uses > 0 ? w->scale.penalty + w->scale.further * (double)(uses - 1) : 0);
}

/// here: the noise of the record itself.
static scale_t scale_of(const work_t* w, const diagnose_options_t* options, double here)
{
    const double noise = options->calibration_noise > 0 ? fmin(here, options->calibration_noise) : here;
    const double calibration = options->calibration_rmse * options->calibration_rmse;
    scale_t scale = {.noise = noise * noise};
    scale.misfit = fmax(calibration - scale.noise, 0);
    scale.penalty = 0.02 * scale.noise + 2 * scale.misfit;
    scale.further = scale.penalty + further_part * mean_square(&w->hypothesis[0]);
    scale.doubt = 0.01 * scale.noise + 0.6 * scale.misfit;
    return scale;
}

static double floor_square(const work_t* w)
{
    // A body that is no play model misfits more on other work than on its calibration (THEORY section 6).
    return w->scale.noise + 2 * w->scale.misfit;
}

static hypothesis_t* add(work_t* w, const effect_use_t* uses, size_t num_uses)
{
    hypothesis_t* hypothesis = &w->hypothesis[w->count++];
    *hypothesis = hypothesis_of(uses, num_uses);
    return hypothesis;
}

static double mean_of(const double* values, size_t count)
{
    double mean = 0;
    for (size_t i = 0; i < count; i++) {
        mean += values[i] / (double)count;
    }
    return mean;
}

/// Parameters that no gradient leads to: a disturbance's frequency, from the spectrum of what `predicted`
/// leaves.
static bool guess_parameters(const work_t* w, const double* predicted, effect_use_t* use)
{
    if (strcmp(use->effect->name, "periodic_disturbance") != 0) {
        return false;
    }
    const effect_run_t* run = w->gap.run;
    double* difference = xmalloc(run->num_samples * sizeof *difference);
    for (size_t t = 0; t < run->num_samples; t++) {
        difference[t] = w->gap.output[t] - predicted[t];
    }
    const sinusoid_t peak = strongest_sinusoid(run->time, difference, run->num_samples);
    free(difference);
    const double guess[] = {peak.frequency, peak.sine, peak.cosine};
    memcpy(use->parameter, guess, sizeof guess);
    return true;
}

static void add_single(work_t* w, const effect_t* effect, const char* column)
{
    if (w->count > MAX_SINGLES) {
        return;
    }
    effect_use_t use = {.effect = effect};
    snprintf(use.column, sizeof use.column, "%s", column);
    for (size_t c = 0; w->calibration != NULL && c < w->calibration->num_auxiliary; c++) {
        if (strcmp(w->calibration->auxiliary[c].name, column) == 0) {
            use.has_reference = true;
            use.reference = mean_of(w->calibration->auxiliary[c].value, w->calibration->num_samples);
        }
    }
    (void)add(w, &use, 1);
}

static void try_single(void* context, size_t index)
{
    const work_t* w = context;
    hypothesis_t* hypothesis = &w->hypothesis[index + 1];
    const bool guessed = guess_parameters(w, w->hypothesis[0].predicted, &hypothesis->use[0]);
    hypothesis_search(hypothesis, &w->gap, guessed, SINGLE_EVALUATIONS);
    hypothesis_judge(hypothesis, &w->gap);
}

static void try_singles(work_t* w)
{
    const record_t* record = w->gap.run->record;
    for (size_t i = 0; i < effect_count(); i++) {
        const effect_t* effect = effect_at(i);
        if (!effect->needs_column) {
            add_single(w, effect, "");
        }
        for (size_t c = 0; effect->needs_column && record != NULL && c < record->num_auxiliary; c++) {
            add_single(w, effect, record->auxiliary[c].name);
        }
    }
    w->num_singles = w->count - 1;
    parallel_for(w->num_singles, w->num_threads, try_single, w, (parallel_progress_t){"diagnose", 0, 0.4});
}

static bool same_effect(const effect_use_t* a, const effect_use_t* b)
{
    return strcmp(a->effect->name, b->effect->name) == 0 && strcmp(a->column, b->column) == 0;
}

static int by_held_out(const void* a, const void* b)
{
    const double x = ((const hypothesis_t*)a)->held_out_rmse;
    const double y = ((const hypothesis_t*)b)->held_out_rmse;
    return (x > y) - (x < y);
}

/// The best mechanism of each name, best first: leaders[] of the hypotheses with one effect; returns how
/// many.
static size_t leading_singles(const work_t* w, hypothesis_t* leaders)
{
    size_t count = 0;
    for (size_t i = 1; i <= w->num_singles; i++) {
        size_t k = 0;
        while (k < count && !hypothesis_same_names(&leaders[k], &w->hypothesis[i])) {
            k++;
        }
        if (k == count) {
            leaders[count++] = w->hypothesis[i];
        } else if (w->hypothesis[i].held_out_rmse < leaders[k].held_out_rmse) {
            leaders[k] = w->hypothesis[i];
        }
    }
    qsort(leaders, count, sizeof *leaders, by_held_out);
    return count;
}

/// Two leading singles and, once tried, the pair of them.
typedef struct {
    const hypothesis_t* first;
    const hypothesis_t* second;
    hypothesis_t fitted;
} pair_t;

typedef struct {
    const work_t* w;
    pair_t* pair;
    hypothesis_t* refined; ///< [REFINED_PAIRS] in w, of the best pairs
} pairs_t;

static int by_fit(const void* a, const void* b)
{
    const double x = ((const pair_t*)a)->fitted.fit_rmse;
    const double y = ((const pair_t*)b)->fitted.fit_rmse;
    return (x > y) - (x < y);
}

/// Briefly.
static void try_pair(void* context, size_t index)
{
    const work_t* w = ((const pairs_t*)context)->w;
    pair_t* pair = &((const pairs_t*)context)->pair[index];
    const effect_use_t uses[] = {pair->first->use[0], pair->second->use[0]};
    pair->fitted = hypothesis_of(uses, 2);
    hypothesis_fit(&pair->fitted, &w->gap, -1, PAIR_EVALUATIONS);
    // The second effect from its start: beside the first it may be another size than alone.
    hypothesis_t from_start = hypothesis_of(uses, 2);
    hypothesis_set_start(&from_start, &w->gap, 0);
    from_start.use[0] = uses[0];
    (void)guess_parameters(w, pair->first->predicted, &from_start.use[1]);
    hypothesis_fit(&from_start, &w->gap, -1, PAIR_EVALUATIONS);
    pair->fitted = from_start.fit_rmse < pair->fitted.fit_rmse ? from_start : pair->fitted;
}

/// From all starts, and judged.
static void refine_pair(void* context, size_t index)
{
    const pairs_t* pairs = context;
    const work_t* w = pairs->w;
    const hypothesis_t* brief = &pairs->pair[index].fitted;
    hypothesis_t* hypothesis = &pairs->refined[index];
    hypothesis_search(hypothesis, &w->gap, false, SINGLE_EVALUATIONS);
    if (brief->fit_rmse < hypothesis->fit_rmse) {
        memcpy(hypothesis->use, brief->use, sizeof hypothesis->use);
        hypothesis_fit(hypothesis, &w->gap, -1, SINGLE_EVALUATIONS);
        effect_simulate(w->gap.run, w->gap.model, w->gap.start, hypothesis->use, 2, hypothesis->predicted);
    }
    hypothesis_judge(hypothesis, &w->gap);
}

/// Every pair that has one of the leading singles in it; the best of them are refined.
static void try_pairs(work_t* w)
{
    hypothesis_t leader[MAX_SINGLES];
    const size_t singles = leading_singles(w, leader);
    pairs_t pairs = {.w = w, .pair = xcalloc(singles * LEADING_SINGLES + 1, sizeof *pairs.pair)};
    size_t count = 0;
    for (size_t i = 0; i < singles && i < LEADING_SINGLES; i++) {
        for (size_t j = i + 1; j < singles; j++) {
            pairs.pair[count++] = (pair_t){.first = &leader[i], .second = &leader[j]};
        }
    }
    parallel_for(count, w->num_threads, try_pair, &pairs, (parallel_progress_t){"diagnose", 0.4, 0.7});
    qsort(pairs.pair, count, sizeof *pairs.pair, by_fit);
    const size_t num_refined = count < REFINED_PAIRS ? count : REFINED_PAIRS;
    pairs.refined = &w->hypothesis[w->count];
    for (size_t k = 0; k < num_refined; k++) {
        (void)add(w, pairs.pair[k].fitted.use, 2);
    }
    parallel_for(num_refined, w->num_threads, refine_pair, &pairs,
                 (parallel_progress_t){"diagnose", 0.7, 0.9});
    free(pairs.pair);
}

static size_t best_of(const work_t* w)
{
    size_t best = 0;
    for (size_t i = 1; i < w->count; i++) {
        best = score(w, &w->hypothesis[i]) < score(w, &w->hypothesis[best]) ? i : best;
    }
    return best;
}

static bool contains(const hypothesis_t* large, const hypothesis_t* small)
{
    size_t found = 0;
    for (size_t i = 0; i < small->num_uses; i++) {
        for (size_t j = 0; j < large->num_uses; j++) {
            found += same_effect(&small->use[i], &large->use[j]);
        }
    }
    return large->num_uses > small->num_uses && found == small->num_uses;
}

/// How far hypothesis h trails the best, in standard deviations: the logarithm of the scores' ratio over what
/// stretches and misfit leave in doubt, for as many independent pieces of evidence as the residual's
/// correlation leaves.
static double trailing(const work_t* w, const hypothesis_t* h, const hypothesis_t* best)
{
    const double ratio = (score(w, h) + w->scale.doubt) / (score(w, best) + w->scale.doubt);
    return sqrt(fmax(w->evidence * log(ratio), 0));
}

static double rms_distance(const double* a, const double* b, size_t n)
{
    double sum = 0;
    for (size_t t = 0; t < n; t++) {
        sum += (a[t] - b[t]) * (a[t] - b[t]);
    }
    return sqrt(sum / (double)n);
}

/// Shrink with its 90 % interval over resampled stretches.
static void set_shrink(const work_t* w, cause_t* cause)
{
    const hypothesis_t* plain = &w->hypothesis[0];
    const interval_t left =
        resample_ratio(cause->hypothesis->block_error, plain->block_error, HYPOTHESIS_BLOCKS, 1);
    cause->rmse_after = cause->hypothesis->held_out_rmse;
    cause->shrink = 1 - cause->rmse_after / plain->held_out_rmse;
    cause->shrink_low = fmin(1 - sqrt(left.high), cause->shrink);
    cause->shrink_high = fmax(1 - sqrt(left.low), cause->shrink);
}

static int by_probability(const void* a, const void* b)
{
    const double x = ((const cause_t*)a)->probability;
    const double y = ((const cause_t*)b)->probability;
    return (x < y) - (x > y);
}

/// One cause for each set of names, the better mechanism's; weight exp(-z^2 / 2) by how far it trails the
/// best.
static void weigh(work_t* w, size_t best, diagnosis_t* d)
{
    const hypothesis_t* leader = &w->hypothesis[best];
    d->cause = xcalloc(w->count, sizeof *d->cause);
    double total = 0;
    for (size_t i = 0; i < w->count; i++) {
        const hypothesis_t* h = &w->hypothesis[i];
        bool shadowed = i != best && (contains(h, leader) || !isfinite(h->held_out_rmse));
        for (size_t k = 0; k < w->count && !shadowed; k++) {
            shadowed = k != i && hypothesis_same_names(h, &w->hypothesis[k]) &&
                       (score(w, &w->hypothesis[k]) < score(w, h) ||
                        (k < i && score(w, &w->hypothesis[k]) <= score(w, h)));
        }
        if (shadowed) {
            continue;
        }
        const double z = i == best ? 0 : fmax(trailing(w, h, leader), 0);
        cause_t* cause = &d->cause[d->num_causes++];
        *cause = (cause_t){.hypothesis = h, .probability = exp(-0.5 * z * z)};
        cause->closeness = rms_distance(h->predicted, leader->predicted, w->gap.run->num_samples);
        total += cause->probability;
        set_shrink(w, cause);
    }
    for (size_t k = 0; k < d->num_causes; k++) {
        d->cause[k].probability /= total;
    }
    qsort(d->cause, d->num_causes, sizeof *d->cause, by_probability);
}

static void conclude(work_t* w, size_t best, diagnosis_t* d)
{
    const size_t n = w->gap.run->num_samples;
    const hypothesis_t* plain = &w->hypothesis[0];
    const hypothesis_t* leader = &w->hypothesis[best];
    const double floor = floor_square(w);
    const double above = mean_square(plain) - floor;
    const double left = above > 0 ? (mean_square(leader) - floor) / above : 0;
    double* residual = xmalloc(n * sizeof *residual);
    for (size_t t = 0; t < n; t++) {
        residual[t] = w->gap.output[t] - leader->predicted[t];
    }
    d->structure = structure_found(&w->gap, leader->predicted, residual);
    free(residual);
    d->is_unknown = mean_square(leader) > 1.5 * floor && left > 0.15 && (left > 0.4 || d->structure > 0.3);
    d->is_none = best == 0 && !d->is_unknown;
    for (size_t k = 1; k < d->num_causes && d->num_indistinguishable < 8; k++) {
        if (d->cause[k].probability > 0.2 * d->cause[0].probability && !d->is_unknown) {
            d->indistinguishable[d->num_indistinguishable++] = k;
        }
    }
    d->confident = d->is_unknown ? left > 0.6 : d->cause[0].probability >= 0.8 && !(left > 0.1 && left < 0.3);
}

/// What to do next: the input that separates the verdict from its strongest rival, by simulation of both.
static void advise(const work_t* w, diagnosis_t* d)
{
    if (d->is_none || d->num_causes < 2 || (d->confident && d->num_indistinguishable == 0)) {
        return;
    }
    d->next = next_input_find(&w->gap, d->cause[0].hypothesis, d->cause[1].hypothesis);
    snprintf(d->advice, sizeof d->advice,
             "apply %s: there the two leading explanations differ by %.3g in the output (noise and known "
             "misfit: %.3g)",
             d->next.what, d->next.separation, d->noise_floor);
}

static void describe_gap(const work_t* w, diagnosis_t* d)
{
    const double floor = sqrt(floor_square(w));
    d->rmse = w->hypothesis[0].held_out_rmse;
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (size_t t = 0; t < w->gap.run->num_samples; t++) {
        low = fmin(low, w->gap.output[t]);
        high = fmax(high, w->gap.output[t]);
    }
    d->relative = d->rmse / (high - low);
    d->noise = sqrt(w->scale.noise);
    d->noise_floor = floor;
    d->closable = fmax(0, 1 - floor / d->rmse);
}

/// The gap of the plain model over the whole record, allocated.
static double* whole_gap(const model_t* model, const effect_run_t* run, start_t start, const double* output)
{
    double* difference = xmalloc(run->num_samples * sizeof *difference);
    effect_simulate(run, model, start, NULL, 0, difference);
    for (size_t t = 0; t < run->num_samples; t++) {
        difference[t] = output[t] - difference[t];
    }
    return difference;
}

/// What thinning left open: the verdict's parameters by all samples (up to most_fitted), and the courses of
/// it and of the plain model over the whole record.
static void finish_on_whole(const work_t* w, const effect_run_t* run, const cause_t* verdict)
{
    thinned_t fitted = record_thin(run->record, most_fitted);
    effect_run_t fitted_run = effect_run_new(w->gap.model, &fitted.record);
    fitted_run.fast = run->fast;
    gap_t gap = gap_new(w->gap.model, &fitted_run, w->gap.start, fitted.record.output);
    gap_leave_out(&gap, fitted.carried);
    for (size_t i = 0; i < w->count; i++) {
        hypothesis_t* h = &w->hypothesis[i];
        if (i > 0 && h == verdict->hypothesis) {
            hypothesis_fit(h, &gap, -1, LAST_EVALUATIONS);
        }
        if (i == 0 || h == verdict->hypothesis) {
            h->predicted = xrealloc(h->predicted, run->num_samples * sizeof *h->predicted);
            effect_simulate(run, w->gap.model, w->gap.start, h->use, h->num_uses, h->predicted);
        }
    }
    effect_run_free(&fitted_run);
    thinned_free(&fitted);
}

static void judge_all(work_t* w, const diagnose_options_t* options, double noise)
{
    w->hypothesis = xcalloc(MAX_HYPOTHESES, sizeof *w->hypothesis);
    hypothesis_t* plain = add(w, NULL, 0);
    hypothesis_search(plain, &w->gap, false, 1);
    hypothesis_judge(plain, &w->gap);
    w->scale = scale_of(w, options, noise);
    try_singles(w);
    // A pair can win only where more is left above the noise than the second effect must gain.
    if (mean_square(&w->hypothesis[best_of(w)]) > w->scale.noise + w->scale.further) {
        try_pairs(w);
    }
}

outcome_t diagnose(const model_t* model, const record_t* record, const diagnose_options_t* options,
                   diagnosis_t* diagnosis)
{
    *diagnosis = (diagnosis_t){0};
    const outcome_t outcome = diagnose_check(model, record);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    fast_plays_t* fast = fast_plays_new(model, options->start);
    effect_run_t whole = effect_run_new(model, record);
    whole.fast = fast;
    double* difference = whole_gap(model, &whole, options->start, record->output);
    thinned_t thinned = record_thin(record, most_judged);
    effect_run_t run = effect_run_new(model, &thinned.record);
    run.fast = fast;
    work_t w = {.gap = gap_new(model, &run, options->start, thinned.record.output),
                .calibration = options->calibration,
                .num_threads = options->num_threads > 0 ? options->num_threads : parallel_processors()};
    gap_leave_out(&w.gap, thinned.carried);
    diagnosis->num_samples = record->num_samples;
    diagnosis->num_judged = w.gap.num_judged;
    judge_all(&w, options, white_noise(difference, record->num_samples));
    const size_t best = best_of(&w);
    w.evidence = fmin((double)run.num_samples / 20, most_evidence);
    describe_gap(&w, diagnosis);
    weigh(&w, best, diagnosis);
    conclude(&w, best, diagnosis);
    advise(&w, diagnosis);
    message_progress("diagnose", 0.9);
    if (thinned.carried != NULL) {
        finish_on_whole(&w, &whole, &diagnosis->cause[0]);
    }
    diagnosis->num_regions =
        where_find(&whole, record->output, difference, diagnosis->noise, diagnosis->region);
    message_progress_done();
    diagnosis->hypothesis = w.hypothesis;
    diagnosis->num_hypotheses = w.count;
    free(difference);
    effect_run_free(&run);
    thinned_free(&thinned);
    effect_run_free(&whole);
    fast_plays_free(fast);
    return OUTCOME_OK;
}

void diagnosis_free(diagnosis_t* diagnosis)
{
    for (size_t i = 0; i < diagnosis->num_hypotheses; i++) {
        hypothesis_free(&diagnosis->hypothesis[i]);
    }
    free(diagnosis->hypothesis);
    free(diagnosis->cause);
    next_input_free(&diagnosis->next);
    *diagnosis = (diagnosis_t){0};
}
