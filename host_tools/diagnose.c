#include "diagnose.h"

#include "diagnose_body.h"
#include "diagnose_check.h"
#include "diagnose_grid.h"
#include "diagnose_scope.h"
#include "diagnose_search.h"
#include "diagnose_shrink.h"
#include "diagnose_verdict.h"
#include "parallel.h"
#include "record_thin.h"
#include "series.h"
#include "white_noise.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LAST_EVALUATIONS = 20 };

/// Samples by which a long record is judged, and those that the verdict's parameters are then fitted to.
static const size_t most_judged = 12000;
static const size_t most_fitted = 1000000;
/// What a body's own misfit leaves is alike from sample to sample: a record weighs against the calibration as
/// this many independent samples.
static const double independent_pieces = 150;

typedef struct {
    const diagnose_options_t* options;
    const record_t* record;
    scope_t scope;
    effect_run_t whole; ///< over the record
    record_t thinned;
    effect_run_t run; ///< over what is judged
    body_t body;
    loop_middle_t* body_middle; ///< or NULL, where the model's plays are all there is
    gap_t gap;
    candidates_t candidates;
    scale_t scale;     ///< of the output's errors
    scale_t judged;    ///< of those that hypotheses are weighed by: beyond half a converter's step
    double correction; ///< mean square of what the body adds to the model over the judged samples
    grid_step_t grid;  ///< that the output lies on and the calibration's does not
    double plain_error[HYPOTHESIS_BLOCKS]; ///< of the model alone: sum of squares of each block
    double plain_rmse;
} work_t;

/// The converter, which add_grid put last, is known: no fit looks for it.
static hypothesis_t without_grid(const work_t* w, const hypothesis_t* h)
{
    hypothesis_t searched = *h;
    searched.num_uses -= w->grid.step > 0 ? 1 : 0;
    return searched;
}

static bool has_another_body(const work_t* w)
{
    return w->run.body != NULL || w->run.everett != NULL;
}

/// The cause's hypothesis where the search keeps it.
static hypothesis_t* own(const work_t* w, const cause_t* cause)
{
    return &w->candidates.hypothesis[cause->hypothesis - w->candidates.hypothesis];
}

typedef struct {
    const work_t* w;
    const diagnosis_t* d;
} judging_t;

static void judge_cause(void* context, size_t index)
{
    const judging_t* j = context;
    hypothesis_t* hypothesis = own(j->w, &j->d->cause[index]);
    hypothesis_t searched = without_grid(j->w, hypothesis);
    hypothesis_judge(&searched, &j->w->gap);
    memcpy(hypothesis->block_error, searched.block_error, sizeof hypothesis->block_error);
}

/// Held-out errors of the causes, where they are what is reported.
static void judge_causes(const work_t* w, const diagnosis_t* d)
{
    if (!has_another_body(w)) {
        judging_t judging = {w, d};
        parallel_for(d->num_causes, w->candidates.num_threads, judge_cause, &judging,
                     (parallel_progress_t){"diagnose", 0.8, 0.9});
    }
}

/// How far each cause shrinks the gap; a verdict that is not sure hands out nothing where the gap is no more
/// than the model is known to leave, nothing that hardly helps, and no course of this record.
static void forecast_causes(const work_t* w, diagnosis_t* d)
{
    const bool held_out = !has_another_body(w) && !(w->grid.step > 0);
    double* average = xmalloc(w->run.num_samples * sizeof *average);
    shrink_settle(&w->gap, own(w, &d->cause[0]));
    shrink_average(&w->gap, d->cause, d->num_causes, average);
    const hypothesis_t* verdict = d->cause[0].hypothesis;
    for (size_t i = 0; i < verdict->num_uses; i++) {
        d->cause[0].is_kept_back[i] =
            !d->confident && (!(d->closable > 0) || !verdict->use[i].effect->transferable);
    }
    for (size_t k = 0; k < d->num_causes; k++) {
        shrink_find(&w->gap, w->plain_error, held_out, k == 0 ? average : NULL, &d->cause[k]);
    }
    if (!d->confident) {
        shrink_mind_doubt(&w->gap, w->plain_error, &d->cause[0]);
    }
    free(average);
}

/// Where the model fails on work that it was not identified for, no effect can be named with confidence. An
/// element holds in all loops.
static void mind_scope(const work_t* w, diagnosis_t* d)
{
    const bool has_element = w->body.stands_in && w->body.stand_in.is_element;
    if (!d->is_none && !has_element && !scope_is_known(&w->scope)) {
        d->confident = false;
        scope_advise(&w->scope, w->gap.model, d->advice, sizeof d->advice);
    }
}

/// What was found outside the catalogue, or cannot be told from the verdict, can be named once it is
/// measured.
static void mind_outside(diagnosis_t* d)
{
    const char* looks = hypothesis_outside(d->cause[0].hypothesis);
    for (size_t k = 0; looks == NULL && k < d->num_indistinguishable; k++) {
        looks = hypothesis_outside(d->cause[d->indistinguishable[k]].hypothesis);
    }
    if (looks != NULL) {
        const size_t length = strlen(d->advice);
        snprintf(d->advice + length, sizeof d->advice - length,
                 "%sit may be %s: record the temperature as a column and diagnose again",
                 length > 0 ? "; then " : "", looks);
    }
}

/// The input that shows more of what nothing explains.
static void advise_on_unknown(const work_t* w, diagnosis_t* d)
{
    if (d->num_regions == 0) {
        return;
    }
    char region[200];
    const model_t* model = w->gap.model;
    where_describe(&d->region[0], model->input_unit, model->output_unit, region, sizeof region);
    const size_t length = strlen(d->advice);
    d->next = next_input_along(&w->gap, d->region[0].axis);
    snprintf(d->advice + length, sizeof d->advice - length,
             "%sno effect of the catalogue explains it; apply %s, since %s, and diagnose that",
             length > 0 ? "; " : "", d->next.what, region);
}

/// What to do next: the input that separates the verdict from its strongest rival, by simulation of both.
static void advise(const work_t* w, diagnosis_t* d)
{
    const bool is_outside = hypothesis_outside(d->cause[0].hypothesis) != NULL;
    if (d->is_unknown && !is_outside) {
        advise_on_unknown(w, d);
        return;
    }
    if ((d->is_none && d->num_indistinguishable == 0) || d->num_causes < 2 || is_outside ||
        hypothesis_outside(d->cause[1].hypothesis) != NULL ||
        (d->confident && d->num_indistinguishable == 0)) {
        return;
    }
    d->next = next_input_find(&w->gap, d->cause[0].hypothesis, d->cause[1].hypothesis);
    const size_t length = strlen(d->advice);
    char* text = d->advice + length;
    const size_t room = sizeof d->advice - length;
    const char* joint = length > 0 ? "; then " : "";
    if (d->next.separation > 0) {
        snprintf(text, room,
                 "%sapply %s: there the two leading explanations differ by %.3g in the output (noise and "
                 "known misfit: %.3g)",
                 joint, d->next.what, d->next.separation, d->noise_floor);
    } else {
        snprintf(text, room, "%sapply %s: one of the two leading explanations follows it", joint,
                 d->next.what);
    }
}

/// The gap of the model over the whole record, none where it is not judged at the start; allocated.
static double* whole_gap(const work_t* w)
{
    const size_t n = w->whole.num_samples;
    double* difference = xmalloc(n * sizeof *difference);
    shrink_simulate(&w->gap, &w->whole, NULL, 0, difference);
    for (size_t t = 0; t < n; t++) {
        difference[t] = t >= w->scope.first_judged ? w->record->output[t] - difference[t] : 0;
    }
    return difference;
}

/// Mean square of what the body adds to the model over the judged samples.
static double correction_of(const work_t* w)
{
    if (!has_another_body(w)) {
        return 0;
    }
    const size_t n = w->run.num_samples;
    double* body = xmalloc(n * sizeof *body);
    double* model = xmalloc(n * sizeof *model);
    effect_simulate(&w->run, w->gap.model, w->gap.start, NULL, 0, body);
    shrink_simulate(&w->gap, &w->run, NULL, 0, model);
    const double square = series_mean_square(body, model, n);
    free(body);
    free(model);
    return square;
}

static void describe_gap(const work_t* w, diagnosis_t* d)
{
    const double floor = sqrt(w->scale.floor + w->correction);
    d->num_samples = w->record->num_samples;
    d->num_judged = w->gap.num_judged;
    d->scope = w->scope;
    d->rmse = w->plain_rmse;
    d->relative = d->rmse / series_span(w->record->output, w->record->num_samples);
    d->noise = sqrt(w->scale.noise);
    d->noise_floor = floor;
    d->closable = fmax(0, 1 - floor / d->rmse);
}

/// The verdict's parameters by all samples of a thinned record (up to most_fitted), from what the search
/// found.
static void fit_on_whole(const work_t* w, const cause_t* verdict, const hypothesis_t* found)
{
    const nuisance_t nothing = {0};
    record_t fitted = record_thin(w->record, most_fitted, w->scope.first_judged);
    effect_run_t run = effect_run_new(w->gap.model, &fitted, true);
    run.fast = w->run.fast;
    run.body = w->run.body;
    run.everett = w->run.everett;
    run.body_middle = w->run.body_middle;
    gap_t gap = gap_new(w->gap.model, &run, w->gap.start, fitted.output, fitted.carried, &nothing,
                        w->gap.variance * fmax((double)fitted.num_samples / (double)w->run.num_samples, 1));
    gap.dead_zone = w->gap.dead_zone;
    hypothesis_t* hypothesis = own(w, verdict);
    hypothesis_t searched = without_grid(w, found);
    hypothesis_fit(&searched, &gap, -1, LAST_EVALUATIONS);
    shrink_settle(&gap, &searched);
    memcpy(hypothesis->use, searched.use, searched.num_uses * sizeof *searched.use);
    gap_free(&gap);
    effect_run_free(&run);
    record_free(&fitted);
}

static void prepare(work_t* w, const model_t* model, const fast_plays_t* fast)
{
    const diagnose_options_t* options = w->options;
    w->scope = scope_of(model, options->calibration, w->record);
    w->whole = effect_run_new(model, w->record, true);
    w->whole.fast = fast;
    w->thinned = record_thin(w->record, most_judged, w->scope.first_judged);
    w->run = effect_run_new(model, &w->thinned, true);
    w->run.fast = fast;
    w->run.input_frequency = scope_input_frequency(&w->run);
    w->body = (body_t){.misfit = options->calibration_rmse, .noise = options->calibration_noise};
    // A body cannot be learned from loops whose past is unknown, nor for a range that they have none of.
    if (options->calibration != NULL && scope_first_fitted(model) == 0 && scope_is_within(&w->scope)) {
        w->body = body_find(model, options->start, options->calibration, options->calibration_rmse,
                            options->calibration_noise, scope_is_known(&w->scope), &w->thinned);
        w->run.body = w->body.stands_in ? &w->body.stand_in : NULL;
        w->run.everett = w->body.has_everett ? &w->body.everett : NULL;
    }
    if (has_another_body(w)) {
        w->body_middle = effect_run_find_middle(&w->run, model, options->start);
        w->run.body_middle = w->body_middle;
    }
    w->gap = gap_new(model, &w->run, options->start, w->thinned.output, w->thinned.carried, &w->body.nuisance,
                     fmax(w->body.misfit * w->body.misfit, DBL_MIN) *
                         fmax((double)w->run.num_samples / independent_pieces, 1));
    shrink_block_errors(&w->gap, NULL, 0, w->plain_error);
    w->plain_rmse = sqrt(series_sum(w->plain_error, HYPOTHESIS_BLOCKS) / (double)w->gap.num_judged);
}

/// A converter's steps that can be told from noise and that the bench did not have are a fact, whatever else
/// acts.
static void find_grid(work_t* w, double noise)
{
    const record_t* bench = w->options->calibration;
    const grid_step_t found = grid_step_of(w->record->output, w->record->num_samples);
    const grid_step_t known =
        bench != NULL ? grid_step_of(bench->output, bench->num_samples) : (grid_step_t){0};
    if (found.step > noise && known.step < 0.5 * found.step) {
        w->grid = found;
        w->gap.dead_zone = 0.5 * found.step;
    }
}

/// Every hypothesis then has the converter in it.
static void add_grid(work_t* w)
{
    for (size_t i = 0; i < effect_count(); i++) {
        if (!effect_at(i)->rounds) {
            continue;
        }
        const effect_use_t use = {.effect = effect_at(i), .parameter = {w->grid.step, w->grid.offset}};
        for (size_t k = 0; k < w->candidates.count; k++) {
            hypothesis_t* h = &w->candidates.hypothesis[k];
            if (h->num_uses < HYPOTHESIS_MAX_EFFECTS) {
                h->use[h->num_uses++] = use;
            }
        }
    }
}

static double least_left(const candidates_t* c)
{
    double least = HUGE_VAL;
    for (size_t i = 0; i < c->count; i++) {
        least = fmin(least, hypothesis_mean_square(&c->hypothesis[i]));
    }
    return least;
}

/// Mean square above the floor beyond which a further effect is looked for, in grains: a pair is worth its
/// price where it leaves far less than the floor, which is known no better.
static const double worth_grains = 0.2;

static void lower_floors(work_t* w)
{
    scale_lower(&w->scale, least_left(&w->candidates));
    scale_lower(&w->judged, least_left(&w->candidates));
}

/// Searches until one more effect cannot be worth its price.
static void search(work_t* w, double noise)
{
    candidates_t* c = &w->candidates;
    find_grid(w, noise);
    *c = candidates_new(&w->gap, w->options->calibration,
                        w->options->num_threads > 0 ? w->options->num_threads : parallel_processors());
    w->correction = correction_of(w);
    w->scale = scale_new(
        noise * noise, w->body.misfit * w->body.misfit, w->body.doubt * w->correction,
        fmax(hypothesis_mean_square(&c->hypothesis[0]), w->plain_rmse * w->plain_rmse - w->correction));
    w->judged = w->grid.step > 0
                    ? scale_behind_steps(&w->scale, w->grid.step, hypothesis_mean_square(&c->hypothesis[0]),
                                         w->gap.num_judged)
                    : w->scale;
    candidates_add_singles(c);
    lower_floors(w);
    const double pair_from = worth_grains * w->judged.grain + scale_least_floor(&w->judged);
    if (hypothesis_mean_square(&c->hypothesis[verdict_best(&w->judged, c)]) > pair_from) {
        candidates_add_pairs(c);
        lower_floors(w);
        const double worth = worth_grains * w->judged.grain + w->judged.floor;
        const hypothesis_t* best = &c->hypothesis[verdict_best(&w->judged, c)];
        if (best->num_uses == 2 && !(w->grid.step > 0) && hypothesis_mean_square(best) > worth) {
            candidates_add_triples(c);
        }
    }
    if (w->grid.step > 0) {
        add_grid(w);
    }
}

outcome_t diagnose(const model_t* model, const record_t* record, const diagnose_options_t* options,
                   diagnosis_t* d)
{
    *d = (diagnosis_t){0};
    const outcome_t outcome = diagnose_check(model, record);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    fast_plays_t* fast = fast_plays_new(model, options->start);
    work_t w = {.options = options, .record = record};
    prepare(&w, model, fast);
    double* difference = whole_gap(&w);
    const double here =
        white_noise(difference + w.scope.first_judged, record->num_samples - w.scope.first_judged);
    const double noise = options->calibration_noise > 0 ? fmin(here, options->calibration_noise) : here;
    search(&w, noise);
    describe_gap(&w, d);
    verdict_find(&w.judged, &w.candidates, d);
    judge_causes(&w, d);
    mind_scope(&w, d);
    mind_outside(d);
    const hypothesis_t found = *d->cause[0].hypothesis;
    forecast_causes(&w, d);
    d->num_regions = where_find(&w.whole, record->output, difference, d->noise, d->region);
    advise(&w, d);
    message_progress("diagnose", 0.9);
    if (w.gap.num_judged < record->num_samples - w.scope.first_judged && !d->is_unknown && !d->is_none) {
        fit_on_whole(&w, &d->cause[0], &found);
    }
    d->before = xmalloc(record->num_samples * sizeof *d->before);
    d->after = xmalloc(record->num_samples * sizeof *d->after);
    effect_use_t handed_out[HYPOTHESIS_MAX_EFFECTS];
    const size_t num_handed_out = diagnosis_handed_out(d, handed_out);
    shrink_simulate(&w.gap, &w.whole, NULL, 0, d->before);
    shrink_simulate(&w.gap, &w.whole, handed_out, num_handed_out, d->after);
    message_progress_done();
    d->hypothesis = w.candidates.hypothesis;
    d->num_hypotheses = w.candidates.count;
    free(difference);
    gap_free(&w.gap);
    body_free(&w.body);
    loop_middle_free(w.body_middle);
    effect_run_free(&w.run);
    record_free(&w.thinned);
    effect_run_free(&w.whole);
    fast_plays_free(fast);
    return isfinite(d->rmse)
               ? OUTCOME_OK
               : message_error(OUTCOME_NUMERICAL, (location_t){.file = record->path},
                               "the gap's mean square is beyond a double's range, expected outputs of the "
                               "model and the record in a unit that leaves room for their squares");
}

void diagnosis_free(diagnosis_t* diagnosis)
{
    for (size_t i = 0; i < diagnosis->num_hypotheses; i++) {
        hypothesis_free(&diagnosis->hypothesis[i]);
    }
    free(diagnosis->hypothesis);
    free(diagnosis->cause);
    free(diagnosis->before);
    free(diagnosis->after);
    next_input_free(&diagnosis->next);
    *diagnosis = (diagnosis_t){0};
}
