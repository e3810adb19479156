#include "diagnose_search.h"

#include "diagnose_guess.h"
#include "parallel.h"
#include "series.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ITERATIONS = 20, BRIEF_EVALUATIONS = 24, LEADING_SINGLES = 6, REFINED = 6, MOST_FURTHER = 3 };
/// Pairs once, and triples once.
enum { MOST_JOINT = 2 * REFINED };

/// A fit this much above what it contains has not yet arrived; below, there is nothing to arrive at.
static const double hardly_worse = 1.001;

static hypothesis_t* add(candidates_t* c, const effect_use_t* uses, size_t num_uses)
{
    hypothesis_t* hypothesis = &c->hypothesis[c->count++];
    *hypothesis = hypothesis_of(uses, num_uses);
    return hypothesis;
}

/// One of each mechanism, or one for each column that it may follow.
static size_t most_singles(const gap_t* gap)
{
    const record_t* record = gap->run->record;
    size_t count = 0;
    for (size_t i = 0; i < effect_count(); i++) {
        count += !effect_at(i)->needs_column ? 1 : record != NULL ? record->num_auxiliary : 0;
    }
    return count;
}

candidates_t candidates_new(const gap_t* gap, const record_t* calibration, size_t num_threads)
{
    candidates_t c = {.gap = gap, .calibration = calibration, .num_threads = num_threads};
    c.hypothesis = xcalloc(1 + most_singles(gap) + MOST_JOINT, sizeof *c.hypothesis);
    hypothesis_t* plain = add(&c, NULL, 0);
    hypothesis_search(plain, gap, false, 1);
    return c;
}

/// An iteration takes one evaluation and one for each parameter's difference.
static int evaluations_of(const hypothesis_t* hypothesis)
{
    int evaluations = ITERATIONS;
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        evaluations += ITERATIONS * (int)hypothesis->use[i].effect->num_parameters;
    }
    return evaluations;
}

static void add_single(candidates_t* c, const effect_t* effect, const char* column)
{
    // How coarse a converter is stands in the record's own values (diagnose_grid.h).
    if (effect->superseded || effect->rounds) {
        return;
    }
    effect_use_t use = {.effect = effect};
    snprintf(use.column, sizeof use.column, "%s", column);
    for (size_t k = 0; c->calibration != NULL && k < c->calibration->num_auxiliary; k++) {
        if (strcmp(c->calibration->auxiliary[k].name, column) == 0) {
            use.has_reference = true;
            use.reference = series_mean(c->calibration->auxiliary[k].value, c->calibration->num_samples);
        }
    }
    (void)add(c, &use, 1);
}

static void try_single(void* context, size_t index)
{
    const candidates_t* c = context;
    hypothesis_t* hypothesis = &c->hypothesis[index + 1];
    const bool guessed = guess_parameters(c->gap, c->hypothesis[0].predicted, &hypothesis->use[0]);
    hypothesis_search(hypothesis, c->gap, guessed, evaluations_of(hypothesis));
}

void candidates_add_singles(candidates_t* c)
{
    const record_t* record = c->gap->run->record;
    for (size_t i = 0; i < effect_count(); i++) {
        const effect_t* effect = effect_at(i);
        if (!effect->needs_column) {
            add_single(c, effect, "");
        }
        for (size_t k = 0; effect->needs_column && record != NULL && k < record->num_auxiliary; k++) {
            add_single(c, effect, record->auxiliary[k].name);
        }
    }
    c->num_singles = c->count - 1;
    parallel_for(c->num_singles, c->num_threads, try_single, c, (parallel_progress_t){"diagnose", 0, 0.4});
}

static int by_mean_square(const void* a, const void* b)
{
    const double x = hypothesis_mean_square(a);
    const double y = hypothesis_mean_square(b);
    return (x > y) - (x < y);
}

/// Where the plays run once for all, a fit may take longer.
static int brief_evaluations(const hypothesis_t* hypothesis)
{
    return hypothesis_is_behind_plays(hypothesis) ? 3 * BRIEF_EVALUATIONS : BRIEF_EVALUATIONS;
}

/// Whether one mechanism stands better than another of its name.
static bool is_better_mechanism(const hypothesis_t* a, const hypothesis_t* b)
{
    return hypothesis_mean_square(a) * exp(hypothesis_price(a)) <
           hypothesis_mean_square(b) * exp(hypothesis_price(b));
}

/// The best mechanism of each name of the catalogue, best first: leaders[] of the hypotheses with one effect;
/// returns how many.
static size_t leading_singles(const candidates_t* c, hypothesis_t* leaders)
{
    size_t count = 0;
    for (size_t i = 1; i <= c->num_singles; i++) {
        if (hypothesis_outside(&c->hypothesis[i]) != NULL) {
            continue;
        }
        size_t k = 0;
        while (k < count && !hypothesis_same_names(&leaders[k], &c->hypothesis[i])) {
            k++;
        }
        if (k == count) {
            leaders[count++] = c->hypothesis[i];
        } else if (is_better_mechanism(&c->hypothesis[i], &leaders[k])) {
            leaders[k] = c->hypothesis[i];
        }
    }
    qsort(leaders, count, sizeof *leaders, by_mean_square);
    return count;
}

/// A hypothesis and one more effect, and once tried what became of them together.
typedef struct {
    const hypothesis_t* base;
    const hypothesis_t* further; ///< with one effect
    hypothesis_t fitted;
} extension_t;

typedef struct {
    const candidates_t* c;
    extension_t* extension;
    hypothesis_t* refined; ///< [REFINED] in c, of the best extensions
} extensions_t;

static int by_fit(const void* a, const void* b)
{
    return by_mean_square(&((const extension_t*)a)->fitted, &((const extension_t*)b)->fitted);
}

static hypothesis_t joined(const hypothesis_t* base, const hypothesis_t* further)
{
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    memcpy(uses, base->use, base->num_uses * sizeof *uses);
    uses[base->num_uses] = further->use[0];
    return hypothesis_of(uses, base->num_uses + 1);
}

/// Of what the base leaves, the energy that goes along what the trial changes of the base's output.
static double promise_of(const gap_t* gap, const hypothesis_t* base, const double* base_output,
                         const hypothesis_t* trial, double* output)
{
    effect_simulate(gap->run, gap->model, gap->start, trial->use, trial->num_uses, output);
    double along = 0;
    double square = 0;
    for (size_t t = 0; t < gap->run->num_samples; t++) {
        const double change = gap_is_judged(gap, t) ? output[t] - base_output[t] : 0;
        along += change * (gap->output[t] - base->predicted[t]);
        square += change * change;
    }
    return square > 0 ? along * fabs(along) / square : 0;
}

static hypothesis_t from_start(const candidates_t* c, const hypothesis_t* base, const hypothesis_t* further,
                               int start)
{
    hypothesis_t joint = joined(base, further);
    hypothesis_set_start(&joint, c->gap, start);
    memcpy(joint.use, base->use, base->num_uses * sizeof *joint.use);
    return joint;
}

/// The base and the further effect by those of its mechanisms that act behind the base's plays, of which a
/// brief fit with the base as it is costs next to nothing: what that leaves least of. False: there is none.
static bool best_behind_plays(const candidates_t* c, const extension_t* e, hypothesis_t* best)
{
    best->fit_rmse = HUGE_VAL;
    for (size_t i = 1; i <= c->num_singles; i++) {
        const bool is_named = hypothesis_names_use(&c->hypothesis[i], &e->further->use[0]);
        for (int start = 0; is_named && start < 3; start++) {
            hypothesis_t trial = from_start(c, e->base, &c->hypothesis[i], start);
            if (!hypothesis_ends_behind_plays(&trial)) {
                break;
            }
            // A guess is the same from every start.
            start = guess_parameters(c->gap, e->base->predicted, &trial.use[e->base->num_uses]) ? 2 : start;
            hypothesis_fit_last(&trial, c->gap, BRIEF_EVALUATIONS);
            *best = by_mean_square(&trial, best) < 0 ? trial : *best;
        }
    }
    return isfinite(hypothesis_mean_square(best));
}

/// The base and the further effect by the mechanism and from the start that promise most.
static hypothesis_t most_promising(const candidates_t* c, const extension_t* e)
{
    const gap_t* gap = c->gap;
    const size_t n = gap->run->num_samples;
    double* base_output = xmalloc(2 * n * sizeof *base_output);
    effect_simulate(gap->run, gap->model, gap->start, e->base->use, e->base->num_uses, base_output);
    hypothesis_t best = joined(e->base, e->further);
    double most = -HUGE_VAL;
    for (size_t i = 1; i <= c->num_singles; i++) {
        const bool is_named = hypothesis_names_use(&c->hypothesis[i], &e->further->use[0]);
        for (int start = 0; is_named && start < 3; start++) {
            const hypothesis_t trial = from_start(c, e->base, &c->hypothesis[i], start);
            const double promise = promise_of(gap, e->base, base_output, &trial, base_output + n);
            best = promise > most ? trial : best;
            most = fmax(most, promise);
        }
    }
    free(base_output);
    return best;
}

static void fit_briefly(const candidates_t* c, hypothesis_t* trial, hypothesis_t* best)
{
    hypothesis_fit(trial, c->gap, -1, brief_evaluations(trial));
    *best = by_mean_square(trial, best) < 0 ? *trial : *best;
}

/// With one effect more no record is met worse: a fit that says so was cut short, and goes on.
static void go_on_while_worse(const candidates_t* c, extension_t* e)
{
    for (int more = 0; more < MOST_FURTHER && e->fitted.fit_rmse > hardly_worse * e->base->fit_rmse; more++) {
        hypothesis_fit(&e->fitted, c->gap, -1, brief_evaluations(&e->fitted));
    }
}

/// Whether that holds for every mechanism of the further effect.
static bool is_always_behind_plays(const candidates_t* c, const extension_t* e)
{
    bool always = true;
    for (size_t i = 1; i <= c->num_singles; i++) {
        if (hypothesis_names_use(&c->hypothesis[i], &e->further->use[0])) {
            const hypothesis_t joint = joined(e->base, &c->hypothesis[i]);
            always = always && hypothesis_ends_behind_plays(&joint);
        }
    }
    return always;
}

static void fit_from_starts(const candidates_t* c, extension_t* e)
{
    hypothesis_t first = from_start(c, e->base, e->further, 0);
    (void)guess_parameters(c->gap, e->base->predicted, &first.use[e->base->num_uses]);
    fit_briefly(c, &first, &e->fitted);
    hypothesis_t promising = most_promising(c, e);
    if (promising.use[e->base->num_uses].effect != first.use[e->base->num_uses].effect) {
        fit_briefly(c, &promising, &e->fitted);
    }
}

/// Briefly: from what each was alone, and from starts, since beside the others the further effect may be of
/// another size or mechanism than alone.
static void try_extension(void* context, size_t index)
{
    const candidates_t* c = ((const extensions_t*)context)->c;
    extension_t* e = &((const extensions_t*)context)->extension[index];
    e->fitted = joined(e->base, e->further);
    hypothesis_fit(&e->fitted, c->gap, -1, brief_evaluations(&e->fitted));
    if (!is_always_behind_plays(c, e)) {
        fit_from_starts(c, e);
    }
    hypothesis_t behind = e->fitted;
    if (best_behind_plays(c, e, &behind)) {
        hypothesis_fit_last(&behind, c->gap, 3 * BRIEF_EVALUATIONS);
        fit_briefly(c, &behind, &e->fitted);
    }
    go_on_while_worse(c, e);
}

/// A freer mechanism in place of one that alone was the better follows what the body misses, too: it must be
/// worth its price twice.
static bool is_worth_changing(const hypothesis_t* trial, const hypothesis_t* best)
{
    const double dearer = fmax(hypothesis_price(trial) - hypothesis_price(best), 0);
    return hypothesis_mean_square(trial) * exp(2 * dearer) < hypothesis_mean_square(best);
}

/// Whether two mechanisms are described by the same parameters.
static bool says_the_same(const effect_t* a, const effect_t* b)
{
    bool same = a->num_parameters == b->num_parameters;
    for (size_t p = 0; same && p < a->num_parameters; p++) {
        same = strcmp(a->parameter[p].name, b->parameter[p].name) == 0;
    }
    return same;
}

static void try_mechanism(const candidates_t* c, size_t place, const effect_use_t* use, hypothesis_t* best)
{
    hypothesis_t trial = *best;
    trial.use[place] = *use;
    hypothesis_fit(&trial, c->gap, -1, brief_evaluations(&trial));
    const bool is_last = place + 1 == best->num_uses;
    if (is_last ? is_better_mechanism(&trial, best) : is_worth_changing(&trial, best)) {
        *best = trial;
    }
}

/// Which mechanism of a name fits best beside other effects need not be the one that did alone.
static void try_other_mechanisms(const candidates_t* c, size_t place, hypothesis_t* best)
{
    const effect_use_t found = best->use[place];
    for (size_t i = 1; i <= c->num_singles; i++) {
        effect_use_t other = c->hypothesis[i].use[0];
        if (other.effect == found.effect || !hypothesis_names_use(&c->hypothesis[i], &found)) {
            continue;
        }
        try_mechanism(c, place, &other, best);
        if (says_the_same(other.effect, found.effect)) {
            memcpy(other.parameter, found.parameter, sizeof other.parameter);
            try_mechanism(c, place, &other, best);
        }
    }
}

/// The same effects as another search found them.
static void adopt(hypothesis_t* hypothesis, const hypothesis_t* found, const gap_t* gap)
{
    memcpy(hypothesis->use, found->use, sizeof hypothesis->use);
    hypothesis->fit_rmse = found->fit_rmse;
    hypothesis->is_another = found->is_another;
    hypothesis_predict(hypothesis, gap);
}

/// Further from there and from all starts.
static void refine(void* context, size_t index)
{
    const extensions_t* extensions = context;
    const gap_t* gap = extensions->c->gap;
    hypothesis_t* hypothesis = &extensions->refined[index];
    hypothesis_t brief = extensions->extension[index].fitted;
    for (size_t place = brief.num_uses; place-- > 0;) {
        try_other_mechanisms(extensions->c, place, &brief);
    }
    hypothesis_fit(&brief, gap, -1, evaluations_of(&brief));
    hypothesis_retry_inside(&brief, gap, evaluations_of(&brief));
    hypothesis_search(hypothesis, gap, false, evaluations_of(hypothesis));
    if (is_better_mechanism(&brief, hypothesis)) {
        adopt(hypothesis, &brief, gap);
    }
}

static void add_best(candidates_t* c, extension_t* extension, size_t count, parallel_progress_t brief,
                     parallel_progress_t long_one)
{
    extensions_t extensions = {c, extension, &c->hypothesis[c->count]};
    parallel_for(count, c->num_threads, try_extension, &extensions, brief);
    qsort(extension, count, sizeof *extension, by_fit);
    const size_t num_refined = count < REFINED ? count : REFINED;
    for (size_t k = 0; k < num_refined; k++) {
        (void)add(c, extension[k].fitted.use, extension[k].fitted.num_uses);
    }
    parallel_for(num_refined, c->num_threads, refine, &extensions, long_one);
}

static bool has_mechanism(const hypothesis_t* hypothesis, const effect_use_t* use)
{
    bool found = false;
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        found = found || hypothesis->use[i].effect == use->effect;
    }
    return found;
}

/// The one of the same mechanisms; else one of the same names, or NULL.
static hypothesis_t* same_as(candidates_t* c, const hypothesis_t* wanted)
{
    hypothesis_t* named = NULL;
    for (size_t i = 0; i < c->count; i++) {
        if (!hypothesis_same_names(&c->hypothesis[i], wanted)) {
            continue;
        }
        bool same = true;
        for (size_t k = 0; same && k < wanted->num_uses; k++) {
            same = has_mechanism(&c->hypothesis[i], &wanted->use[k]);
        }
        if (same) {
            return &c->hypothesis[i];
        }
        named = &c->hypothesis[i];
    }
    return named;
}

/// Beside another effect a search may find what it did not find alone, or by another mechanism: each of the
/// combinations from `first` on without one of its effects, from there.
static void refit_parts(candidates_t* c, size_t first)
{
    for (size_t i = first; i < c->count; i++) {
        for (size_t out = 0; out < c->hypothesis[i].num_uses; out++) {
            hypothesis_t part = c->hypothesis[i];
            part.num_uses--;
            memmove(&part.use[out], &part.use[out + 1], (part.num_uses - out) * sizeof *part.use);
            hypothesis_t* own = same_as(c, &part);
            if (own != NULL && own->num_uses > 0) {
                hypothesis_fit(&part, c->gap, -1, brief_evaluations(&part));
                if (is_better_mechanism(&part, own)) {
                    adopt(own, &part, c->gap);
                }
            }
        }
    }
}

void candidates_add_pairs(candidates_t* c)
{
    hypothesis_t* leader = xcalloc(c->num_singles, sizeof *leader);
    const size_t singles = leading_singles(c, leader);
    extension_t* pair = xcalloc(singles * LEADING_SINGLES + 1, sizeof *pair);
    size_t count = 0;
    for (size_t i = 0; i < singles && i < LEADING_SINGLES; i++) {
        for (size_t j = i + 1; j < singles; j++) {
            pair[count++] = (extension_t){.base = &leader[i], .further = &leader[j]};
        }
    }
    add_best(c, pair, count, (parallel_progress_t){"diagnose", 0.4, 0.6},
             (parallel_progress_t){"diagnose", 0.6, 0.7});
    free(pair);
    free(leader);
    refit_parts(c, 1 + c->num_singles);
}

void candidates_add_triples(candidates_t* c)
{
    hypothesis_t* leader = xcalloc(c->num_singles, sizeof *leader);
    const size_t singles = leading_singles(c, leader);
    const hypothesis_t* best = NULL;
    for (size_t i = c->num_singles + 1; i < c->count; i++) {
        if (c->hypothesis[i].num_uses == 2 &&
            (best == NULL || hypothesis_mean_square(&c->hypothesis[i]) < hypothesis_mean_square(best))) {
            best = &c->hypothesis[i];
        }
    }
    extension_t* triple = xcalloc(singles + 1, sizeof *triple);
    const size_t first = c->count;
    size_t count = 0;
    for (size_t j = 0; best != NULL && j < singles; j++) {
        if (!hypothesis_names_use(best, &leader[j].use[0])) {
            triple[count++] = (extension_t){.base = best, .further = &leader[j]};
        }
    }
    add_best(c, triple, count, (parallel_progress_t){"diagnose", 0.7, 0.75},
             (parallel_progress_t){"diagnose", 0.75, 0.8});
    free(triple);
    free(leader);
    refit_parts(c, first);
}
