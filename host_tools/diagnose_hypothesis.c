#include "diagnose_hypothesis.h"

#include "bounded.h"
#include "extremes.h"
#include <cminpack.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_THETA = HYPOTHESIS_MAX_EFFECTS * EFFECT_MAX_PARAMETERS };

bool gap_is_judged(const gap_t* gap, size_t sample)
{
    return gap->carried == NULL || !gap->carried[sample];
}

/// Blocks of as many judged samples each.
static void set_blocks(gap_t* gap)
{
    const size_t n = gap->run->num_samples;
    for (size_t t = 0; t < n; t++) {
        gap->num_judged += gap_is_judged(gap, t);
    }
    size_t end = 0;
    size_t count = 0;
    for (size_t b = 0; b < HYPOTHESIS_BLOCKS; b++) {
        for (; end < n && count < gap->num_judged * (b + 1) / HYPOTHESIS_BLOCKS; end++) {
            count += gap_is_judged(gap, end);
        }
        gap->block_end[b] = b + 1 < HYPOTHESIS_BLOCKS ? end : n;
    }
}

gap_t gap_new(const model_t* model, const effect_run_t* run, start_t start, const double* output,
              const bool* carried, const nuisance_t* nuisance, double variance)
{
    gap_t gap = {.model = model,
                 .run = run,
                 .start = start,
                 .output = output,
                 .carried = carried,
                 .variance = variance};
    set_blocks(&gap);
    bool* counts = xmalloc(run->num_samples * sizeof *counts);
    for (size_t fold = 0; fold <= HYPOTHESIS_FOLDS; fold++) {
        for (size_t t = 0; t < run->num_samples; t++) {
            counts[t] = gap_block_of(&gap, t) % HYPOTHESIS_FOLDS != fold && gap_is_judged(&gap, t);
        }
        gap.filter[fold] = nuisance_filter_new(nuisance, variance, counts);
    }
    free(counts);
    return gap;
}

void gap_free(gap_t* gap)
{
    for (size_t fold = 0; fold <= HYPOTHESIS_FOLDS; fold++) {
        nuisance_filter_free(&gap->filter[fold]);
    }
}

size_t gap_block_of(const gap_t* gap, size_t sample)
{
    size_t block = 0;
    while (sample >= gap->block_end[block]) {
        block++;
    }
    return block;
}

hypothesis_t hypothesis_of(const effect_use_t* uses, size_t num_uses)
{
    hypothesis_t hypothesis = {.num_uses = num_uses, .fit_rmse = HUGE_VAL};
    for (size_t i = 0; i < num_uses; i++) {
        hypothesis.use[i] = uses[i];
    }
    return hypothesis;
}

void hypothesis_free(hypothesis_t* hypothesis)
{
    free(hypothesis->predicted);
    hypothesis->predicted = NULL;
}

bool hypothesis_names_use(const hypothesis_t* hypothesis, const effect_use_t* use)
{
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        if (strcmp(hypothesis->use[i].effect->name, use->effect->name) == 0 &&
            strcmp(hypothesis->use[i].column, use->column) == 0) {
            return true;
        }
    }
    return false;
}

const char* hypothesis_outside(const hypothesis_t* hypothesis)
{
    const char* outside = NULL;
    for (size_t i = 0; outside == NULL && i < hypothesis->num_uses; i++) {
        outside = hypothesis->use[i].effect->outside;
    }
    return outside;
}

bool hypothesis_same_names(const hypothesis_t* a, const hypothesis_t* b)
{
    bool same = a->num_uses == b->num_uses;
    for (size_t i = 0; same && i < a->num_uses; i++) {
        same = hypothesis_names_use(b, &a->use[i]);
    }
    return same;
}

void hypothesis_set_start(hypothesis_t* hypothesis, const gap_t* gap, int start)
{
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        effect_use_t* use = &hypothesis->use[i];
        for (size_t p = 0; p < use->effect->num_parameters; p++) {
            const effect_limits_t limits = effect_use_limits(gap->run, use, p);
            use->parameter[p] = start < 0 ? limits.neutral : limits.start[start];
        }
    }
}

/// One free number of the search: a parameter within its bounds.
typedef struct {
    double* value;
    bounds_t bounds;
    double scatter; ///< as in effect_parameter_t
} free_t;

typedef struct {
    const gap_t* gap;
    hypothesis_t* hypothesis;
    size_t num_free;
    free_t free[MAX_THETA];
    int held_out;
    const nuisance_filter_t* filter;
    double* amount;                ///< [filter's directions] of the nuisance, found with the last residual
    double* plays;                 ///< [num_samples] output of drive side and hysteresis with `before_body`
    double before_body[MAX_THETA]; ///< the parameters that it depends on, at the last step's end
    double* simulated;             ///< [num_samples]
} search_t;

static bool acts_before_body(const effect_t* effect)
{
    return effect->stage == EFFECT_DRIVE || effect->configure != NULL;
}

bool hypothesis_is_behind_plays(const hypothesis_t* hypothesis)
{
    bool behind = true;
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        behind = behind && !acts_before_body(hypothesis->use[i].effect);
    }
    return behind;
}

bool hypothesis_ends_behind_plays(const hypothesis_t* hypothesis)
{
    return hypothesis->num_uses > 0 && !hypothesis_is_behind_plays(hypothesis) &&
           !acts_before_body(hypothesis->use[hypothesis->num_uses - 1].effect);
}

/// The parameters of all effects up to the plays.
static size_t list_before_body(const hypothesis_t* hypothesis, double* parameter)
{
    size_t count = 0;
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        const effect_use_t* use = &hypothesis->use[i];
        for (size_t p = 0; acts_before_body(use->effect) && p < use->effect->num_parameters; p++) {
            parameter[count++] = use->parameter[p];
        }
    }
    return count;
}

/// Runs the plays for the present parameters, and keeps that: differences in what acts behind them need no
/// run of their own.
static void run_plays(search_t* s)
{
    const gap_t* gap = s->gap;
    (void)list_before_body(s->hypothesis, s->before_body);
    effect_simulate_hysteresis(gap->run, gap->model, gap->start, s->hypothesis->use, s->hypothesis->num_uses,
                               s->plays);
}

static bool plays_are_kept(const search_t* s)
{
    double now[MAX_THETA];
    const size_t count = list_before_body(s->hypothesis, now);
    return memcmp(now, s->before_body, count * sizeof *now) == 0;
}

/// Of the parameters of effects from `first` on.
static search_t search_from(hypothesis_t* hypothesis, size_t first, const gap_t* gap, int held_out)
{
    search_t s = {.gap = gap, .hypothesis = hypothesis, .held_out = held_out};
    for (size_t i = first; i < hypothesis->num_uses; i++) {
        effect_use_t* use = &hypothesis->use[i];
        for (size_t p = 0; p < use->effect->num_parameters; p++) {
            const effect_limits_t limits = effect_use_limits(gap->run, use, p);
            if (use->effect->parameter[p].is_unit) {
                use->parameter[p] = limits.neutral;
                continue;
            }
            free_t* f = &s.free[s.num_free++];
            f->value = &use->parameter[p];
            f->bounds = (bounds_t){limits.low, limits.high, limits.logarithmic};
            f->scatter = use->effect->parameter[p].scatter;
        }
    }
    s.filter = &gap->filter[held_out < 0 ? HYPOTHESIS_FOLDS : held_out];
    s.amount = xcalloc(s.filter->nuisance->count + 1, sizeof *s.amount);
    s.simulated = xmalloc(gap->run->num_samples * sizeof *s.simulated);
    s.plays = xmalloc(gap->run->num_samples * sizeof *s.plays);
    run_plays(&s);
    return s;
}

static search_t search_new(hypothesis_t* hypothesis, const gap_t* gap, int held_out)
{
    return search_from(hypothesis, 0, gap, held_out);
}

static void search_free(search_t* s)
{
    free(s->amount);
    free(s->simulated);
    free(s->plays);
}

static void simulate(search_t* s, bool is_step)
{
    const hypothesis_t* h = s->hypothesis;
    const gap_t* gap = s->gap;
    const bool kept = plays_are_kept(s);
    if (!kept && is_step) {
        run_plays(s);
    }
    if (kept || is_step) {
        memcpy(s->simulated, s->plays, gap->run->num_samples * sizeof *s->plays);
        effect_simulate_rest(gap->run, h->use, h->num_uses, s->simulated);
    } else {
        effect_simulate(gap->run, gap->model, gap->start, h->use, h->num_uses, s->simulated);
    }
}

static bool is_held_out(const search_t* s, size_t block)
{
    return s->held_out >= 0 && block % HYPOTHESIS_FOLDS == (size_t)s->held_out;
}

static size_t num_residuals(const search_t* s)
{
    return s->gap->run->num_samples + s->filter->nuisance->count + s->num_free;
}

static void keep_fitted(const search_t* s, double* residual)
{
    size_t t = 0;
    for (size_t b = 0; b < HYPOTHESIS_BLOCKS; b++) {
        const bool skip = is_held_out(s, b);
        for (; t < s->gap->block_end[b]; t++) {
            residual[t] = skip || !gap_is_judged(s->gap, t) ? 0 : residual[t];
        }
    }
}

/// What lmdif evaluates for: a step (1), or a difference for its derivatives.
enum { STEP = 1 };
/// What lmdif returns when it ends for want of evaluations.
enum { OUT_OF_EVALUATIONS = 5 };

/// What it costs that parameters are off where plants have them, in what an independent piece of the record
/// counts.
static void price_scatter(const search_t* s, double* residual)
{
    for (size_t i = 0; i < s->num_free; i++) {
        const free_t* f = &s->free[i];
        residual[i] = f->scatter > 0 ? sqrt(s->gap->variance) * *f->value / f->scatter : 0;
    }
}

/// Errors at all samples, but for what the nuisance explains of the fitted ones; then the price of that and
/// of the parameters.
static void residual_of(search_t* s, bool is_step, double* residual)
{
    const size_t n = s->gap->run->num_samples;
    simulate(s, is_step);
    for (size_t t = 0; t < n; t++) {
        residual[t] = s->simulated[t] - s->gap->output[t];
    }
    const double dead_zone = s->gap->dead_zone;
    for (size_t t = 0; dead_zone > 0 && t < n; t++) {
        residual[t] -= smaller(larger(residual[t], -dead_zone), dead_zone);
    }
    if (s->filter->nuisance->count > 0) {
        // The nuisance is found on what is fitted and taken out everywhere.
        double* all = s->simulated;
        memcpy(all, residual, n * sizeof *all);
        keep_fitted(s, residual);
        nuisance_filter_find(s->filter, residual, s->amount);
        memcpy(residual, all, n * sizeof *all);
        nuisance_take(s->filter->nuisance, s->amount, residual);
    }
    for (size_t k = 0; k < s->filter->nuisance->count; k++) {
        residual[n + k] = sqrt(s->filter->variance) * s->amount[k];
    }
    price_scatter(s, &residual[n + s->filter->nuisance->count]);
}

static int minpack_residual(void* context, int m, int n, const double* theta, double* residual, int task)
{
    (void)m;
    search_t* s = context;
    for (int i = 0; i < n; i++) {
        *s->free[i].value = bounded_from_free(s->free[i].bounds, theta[i]);
    }
    residual_of(s, task == STEP, residual);
    keep_fitted(s, residual);
    return 0;
}

static size_t count_fitted(const search_t* s)
{
    size_t count = 0;
    size_t t = 0;
    for (size_t b = 0; b < HYPOTHESIS_BLOCKS; b++) {
        for (; t < s->gap->block_end[b]; t++) {
            count += !is_held_out(s, b) && gap_is_judged(s->gap, t);
        }
    }
    return count;
}

static bool is_another(const hypothesis_t* hypothesis, const effect_run_t* run)
{
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        const effect_t* effect = hypothesis->use[i].effect;
        const double* parameter = hypothesis->use[i].parameter;
        if ((effect->is_another != NULL && effect->is_another(run, parameter)) ||
            (effect->follows_input != NULL && effect->follows_input(run, parameter))) {
            return true;
        }
    }
    return false;
}

static void fit(search_t* search, int max_evaluations)
{
    const size_t m = num_residuals(search);
    const size_t n = search->num_free;
    hypothesis_t* hypothesis = search->hypothesis;
    double* work = xcalloc(2 * m + m * (n + 1) + 6 * (n + 1), sizeof *work);
    double* residual = work;
    if (n > 0 && m > n) {
        double theta[MAX_THETA];
        int pivot[MAX_THETA];
        int evaluations = 0;
        for (size_t i = 0; i < n; i++) {
            theta[i] = bounded_to_free(search->free[i].bounds, *search->free[i].value);
        }
        double* vectors = residual + m;
        double* jacobian = vectors + m;
        double* v = jacobian + m * n;
        // A wide difference step: delays, clips and steps are not smooth at the scale of rounding.
        const int info = lmdif(minpack_residual, search, (int)m, (int)n, theta, residual, 1e-6, 1e-6, 0,
                               max_evaluations, 1e-6, v, 1, 1, 0, &evaluations, jacobian, (int)m, pivot,
                               v + n, v + 2 * n, v + 3 * n, v + 4 * n, vectors);
        hypothesis->cut_short = info == OUT_OF_EVALUATIONS;
        for (size_t i = 0; i < n; i++) {
            *search->free[i].value = bounded_from_free(search->free[i].bounds, theta[i]);
        }
    }
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        effect_use_normalise(&hypothesis->use[i]);
    }
    residual_of(search, true, residual);
    keep_fitted(search, residual);
    double sum = 0;
    for (size_t t = 0; t < m; t++) {
        sum += residual[t] * residual[t];
    }
    hypothesis->fit_rmse = sqrt(sum / (double)count_fitted(search));
    hypothesis->is_another = is_another(hypothesis, search->gap->run);
    free(work);
}

void hypothesis_fit(hypothesis_t* hypothesis, const gap_t* gap, int held_out, int max_evaluations)
{
    search_t search = search_new(hypothesis, gap, held_out);
    fit(&search, max_evaluations);
    search_free(&search);
}

void hypothesis_fit_last(hypothesis_t* hypothesis, const gap_t* gap, int max_evaluations)
{
    search_t search = search_from(hypothesis, hypothesis->num_uses - 1, gap, -1);
    fit(&search, max_evaluations);
    search_free(&search);
}

/// The best of evenly spread values of an effect's first parameter, the others as they are: thresholds and
/// delays give no gradient where they do not act.
static hypothesis_t scan(const hypothesis_t* hypothesis, const gap_t* gap, int max_evaluations)
{
    enum { POINTS = 48 };
    hypothesis_t trial = *hypothesis;
    hypothesis_t best = *hypothesis;
    search_t s = search_new(&trial, gap, -1);
    double* residual = xmalloc(num_residuals(&s) * sizeof *residual);
    double least = HUGE_VAL;
    for (size_t k = 0; k < POINTS; k++) {
        const double part = 2 * ((double)k + 0.5) / POINTS - 1;
        const double theta = asin(part);
        double sum = 0;
        (void)minpack_residual(&s, 0, 1, &theta, residual, STEP);
        for (size_t t = 0; t < num_residuals(&s); t++) {
            sum += residual[t] * residual[t];
        }
        if (sum < least) {
            least = sum;
            memcpy(best.use, trial.use, sizeof best.use);
        }
    }
    free(residual);
    search_free(&s);
    hypothesis_fit(&best, gap, -1, max_evaluations);
    return best;
}

/// A scan leaves the other parameters near their bounds, from where a search with one effect more hardly
/// moves them: a fit from the inside that is as good is taken instead.
static const double as_good = 1.001;
/// A third of the evaluations tells which start is worth the rest.
enum { PART_OF_START = 3 };

static int count_starts(const hypothesis_t* hypothesis)
{
    int count = 1;
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        count = hypothesis->use[i].effect->is_linear ? count : 3;
    }
    return count;
}

void hypothesis_search(hypothesis_t* hypothesis, const gap_t* gap, bool guessed, int max_evaluations)
{
    hypothesis_t best = *hypothesis;
    best.fit_rmse = HUGE_VAL;
    double to_beat = 1;
    const int evaluations = max_evaluations / PART_OF_START;
    if (hypothesis->num_uses == 1 &&
        (hypothesis->use[0].effect->has_threshold || hypothesis->use[0].effect->num_parameters == 1)) {
        hypothesis_t neutral = *hypothesis;
        hypothesis_set_start(&neutral, gap, -1);
        best = scan(&neutral, gap, evaluations);
        to_beat = as_good;
    }
    for (int start = guessed ? -1 : 0; start < count_starts(hypothesis); start++) {
        hypothesis_t trial = *hypothesis;
        if (start >= 0) {
            hypothesis_set_start(&trial, gap, start);
        }
        hypothesis_fit(&trial, gap, -1, evaluations);
        if (trial.fit_rmse < to_beat * best.fit_rmse) {
            best = trial;
            to_beat = 1;
        }
    }
    if (best.cut_short) {
        hypothesis_fit(&best, gap, -1, max_evaluations);
    }
    *hypothesis = best;
    hypothesis_predict(hypothesis, gap);
}

/// How near to a bound, over a sine, counts as at it.
static const double at_bound = 0.98;

/// Moves those parameters that are at a bound to where the first start has them; whether there are any.
static bool leave_bounds(hypothesis_t* hypothesis, const gap_t* gap)
{
    bool moved = false;
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        effect_use_t* use = &hypothesis->use[i];
        for (size_t p = 0; p < use->effect->num_parameters; p++) {
            const effect_limits_t limits = effect_use_limits(gap->run, use, p);
            const bounds_t bounds = {limits.low, limits.high, limits.logarithmic};
            const double start = limits.start[0];
            if (!use->effect->parameter[p].is_unit &&
                fabs(sin(bounded_to_free(bounds, use->parameter[p]))) > at_bound &&
                fabs(sin(bounded_to_free(bounds, start))) < at_bound) {
                use->parameter[p] = start;
                moved = true;
            }
        }
    }
    return moved;
}

void hypothesis_retry_inside(hypothesis_t* hypothesis, const gap_t* gap, int max_evaluations)
{
    hypothesis_t trial = *hypothesis;
    if (leave_bounds(&trial, gap)) {
        hypothesis_fit(&trial, gap, -1, max_evaluations);
        if (hypothesis_mean_square(&trial) < hypothesis_mean_square(hypothesis)) {
            *hypothesis = trial;
        }
    }
}

void hypothesis_predict(hypothesis_t* hypothesis, const gap_t* gap)
{
    search_t s = search_new(hypothesis, gap, -1);
    hypothesis->predicted =
        xrealloc(hypothesis->predicted, num_residuals(&s) * sizeof *hypothesis->predicted);
    residual_of(&s, true, hypothesis->predicted);
    for (size_t t = 0; t < gap->run->num_samples; t++) {
        hypothesis->predicted[t] += gap->output[t];
    }
    search_free(&s);
}

/// Of what is left above the floor, an effect more must take away at least this part: less than that another
/// effect's free parameters take from a body's own misfit, or from the first effect's physics being a little
/// other than the plant's.
static const double part_to_gain = 0.4;

double hypothesis_price(const hypothesis_t* hypothesis)
{
    double price = 0;
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        price += 1 + hypothesis->use[i].effect->covers;
    }
    return -log(1 - part_to_gain) * price;
}

double hypothesis_mean_square(const hypothesis_t* hypothesis)
{
    return hypothesis->is_another ? HUGE_VAL : hypothesis->fit_rmse * hypothesis->fit_rmse;
}

void hypothesis_judge(hypothesis_t* hypothesis, const gap_t* gap)
{
    for (int fold = 0; fold < HYPOTHESIS_FOLDS; fold++) {
        hypothesis_t trial = *hypothesis;
        hypothesis_fit(&trial, gap, fold, 30);
        search_t s = search_new(&trial, gap, fold);
        double* residual = xmalloc(num_residuals(&s) * sizeof *residual);
        residual_of(&s, true, residual);
        size_t t = 0;
        for (size_t b = 0; b < HYPOTHESIS_BLOCKS; b++) {
            double error = 0;
            for (; t < gap->block_end[b]; t++) {
                error += gap_is_judged(gap, t) ? residual[t] * residual[t] : 0;
            }
            if (is_held_out(&s, b)) {
                hypothesis->block_error[b] = error;
            }
        }
        search_free(&s);
        free(residual);
    }
}
