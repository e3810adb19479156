#include "identify.h"

#include "identify_fit.h"
#include "identify_samples.h"
#include "identify_start.h"
#include "reference.h"
#include "series.h"
#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Samples in the search for curves and in the final fit: the search costs a second, the final fit well below
/// one.
enum { SEARCH_SAMPLES = 2000, FINAL_SAMPLES = 12000 };
enum { NUM_KNOTS = 17, START_EVALUATIONS = 12, SEARCH_EVALUATIONS = 60, FINAL_EVALUATIONS = 8 };
enum { LEAST_SAMPLES = 20 };

/// A richer family must bring the error below this part of a simpler one's to be kept: tables can follow one
/// record in ways that say nothing of the next, so they must gain more.
static const double worthwhile_tanh = 0.9;
static const double worthwhile_table = 0.75;

/// Of the output's range: an error that no richer family needs to improve on.
static const double good_enough = 1e-4;

/// Just enough to choose between weights that the record hardly tells apart: raises no fit's error by 1 %.
static const double smoothness = 1e-3;

/// Half a loop's mean width, as a part of the output's range, from which it counts as clockwise rather than
/// as noise.
static const double clockwise_sense = 0.002;

typedef struct {
    const record_t* record;
    const identify_options_t* options;
    double centre, half_range; ///< of the model's input range
    double output_range;
    double knot[NUM_KNOTS];
    samples_t search;
    start_plan_t plan;
} problem_t;

const char* identify_curve_name(curve_type_t type)
{
    switch (type) {
    case CURVE_LINEAR:
        return "linear";
    case CURVE_TANH:
        return "tanh";
    case CURVE_TABLE:
        return "table";
    }
    return "unknown";
}

static void range_of(const double* values, size_t count, double* low, double* high)
{
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (size_t i = 0; i < count; i++) {
        *low = fmin(*low, values[i]);
        *high = fmax(*high, values[i]);
    }
}

/// Of the record's first `count` samples.
static size_t count_measured(const record_t* record, size_t count)
{
    size_t measured = 0;
    for (size_t t = 0; t < count; t++) {
        measured += !record_is_carried(record, t);
    }
    return measured;
}

/// What was put back may lie beyond what was measured, and nobody is to blame for it.
static void measured_input_range(const record_t* record, double* low, double* high)
{
    *low = HUGE_VAL;
    *high = -HUGE_VAL;
    for (size_t t = 0; t < record->num_samples; t++) {
        if (!record_is_carried(record, t)) {
            *low = fmin(*low, record->input[t]);
            *high = fmax(*high, record->input[t]);
        }
    }
}

static outcome_t check_record(problem_t* p)
{
    const location_t where = {.file = p->record->path};
    const size_t least = LEAST_SAMPLES;
    const size_t measured = count_measured(p->record, p->record->num_samples);
    if (measured < least) {
        return message_error(OUTCOME_BAD_INPUT, where,
                             "%zu samples are too few to identify a model, expected at least %zu", measured,
                             least);
    }
    double low;
    double high;
    range_of(p->record->output, p->record->num_samples, &low, &high);
    p->output_range = high - low;
    if (!(p->output_range > 0)) {
        return message_error(OUTCOME_BAD_INPUT, where,
                             "the output is %g throughout, expected one that answers the input", low);
    }
    range_of(p->record->input, p->record->num_samples, &low, &high);
    if (!(high > low)) {
        return message_error(OUTCOME_BAD_INPUT, where, "the input is %g throughout, expected one that moves",
                             low);
    }
    if (p->options->has_range) {
        measured_input_range(p->record, &low, &high);
        if (low < p->options->input_min || high > p->options->input_max) {
            return message_error(OUTCOME_BAD_INPUT, where,
                                 "the input runs from %g to %g, expected it within the given range %g to %g",
                                 low, high, p->options->input_min, p->options->input_max);
        }
        low = p->options->input_min;
        high = p->options->input_max;
    }
    p->centre = 0.5 * (low + high);
    p->half_range = 0.5 * (high - low);
    return OUTCOME_OK;
}

/// Knots at equal steps of arc length along the record's mean curve, half by input and half by output, so
/// that steep stretches get more of them.
static void place_knots(problem_t* p)
{
    enum { BINS = 128 };
    double sum[BINS + 1] = {0};
    double count[BINS + 1] = {0};
    for (size_t i = 0; i < p->search.num_samples; i++) {
        const double at = 0.5 * (p->search.u[i] + 1) * BINS;
        const size_t bin = at <= 0 ? 0 : at >= BINS ? BINS : (size_t)lround(at);
        sum[bin] += p->search.y[i];
        count[bin] += 1;
    }
    double length[BINS + 1] = {0};
    double last = HUGE_VAL;
    for (size_t bin = 0; bin <= BINS; bin++) {
        double rise = 0;
        if (count[bin] > 0) {
            const double mean = sum[bin] / count[bin];
            rise = isfinite(last) ? fabs(mean - last) / p->output_range : 0;
            last = mean;
        }
        length[bin] = (bin > 0 ? length[bin - 1] : 0) + 1.0 / BINS + 0.7 * rise;
    }
    size_t bin = 0;
    for (size_t k = 0; k < NUM_KNOTS; k++) {
        const double wanted = length[0] + (length[BINS] - length[0]) * (double)k / (NUM_KNOTS - 1);
        while (bin + 1 < BINS && length[bin + 1] < wanted) {
            bin++;
        }
        const double part = (wanted - length[bin]) / (length[bin + 1] - length[bin]);
        p->knot[k] = -1 + 2 * ((double)bin + part) / BINS;
    }
    p->knot[0] = -1;
    p->knot[NUM_KNOTS - 1] = 1;
}

/// Mean scaled input at which a branch passes the middle of the output's range.
static double branch_centre(const samples_t* s, bool rising)
{
    double low;
    double high;
    range_of(s->y, s->num_samples, &low, &high);
    const double middle = 0.5 * (low + high);
    double sum = 0;
    double count = 0;
    for (size_t i = 1; i < s->num_samples; i++) {
        const bool crosses = (s->y[i - 1] < middle) != (s->y[i] < middle);
        if (crosses && (s->u[i] > s->u[i - 1]) == rising) {
            sum += 0.5 * (s->u[i] + s->u[i - 1]);
            count += 1;
        }
    }
    return count > 0 ? sum / count : 0;
}

static fit_samples_t fit_samples_of(const samples_t* samples, const start_plan_t* plan)
{
    return (fit_samples_t){.num_samples = samples->num_samples,
                           .u = samples->u,
                           .y = samples->y,
                           .used = samples->used,
                           .start = plan->start,
                           .fraction = plan->fraction,
                           .smoothness = smoothness};
}

/// Keeps in `best` what is better in `trial`.
static void keep_better(fit_t* best, const fit_t* trial)
{
    if (trial->rmse < best->rmse) {
        fit_assign(best, trial);
    }
}

/// Short searches from several steepnesses, then a long one from the best of them.
static outcome_t search_from_several(const problem_t* p, fit_t* fit)
{
    static const double steepness[] = {0.5, 1, 2, 4, 8, 16};
    const double ascending = branch_centre(&p->search, true);
    const double descending = branch_centre(&p->search, false);
    const fit_samples_t samples = fit_samples_of(&p->search, &p->plan);
    fit_t trial = fit_new(fit->shape, fit->num_plays);
    outcome_t outcome = OUTCOME_OK;
    for (size_t i = 0; i < sizeof steepness / sizeof *steepness && outcome == OUTCOME_OK; i++) {
        // An ascending envelope right of the descending one lets the play of radius 0 carry the loop.
        shape_start(fit->shape, steepness[i],
                    0.5 * (ascending + descending) + 0.25 * fabs(ascending - descending),
                    0.5 * (ascending + descending) - 0.25 * fabs(ascending - descending), trial.theta);
        outcome = fit_search(&trial, &samples, START_EVALUATIONS);
        keep_better(fit, &trial);
    }
    if (outcome == OUTCOME_OK) {
        outcome = fit_search(fit, &samples, SEARCH_EVALUATIONS);
    }
    fit_free(&trial);
    return outcome;
}

static outcome_t search_table(const problem_t* p, fit_t* fit, const fit_t* former)
{
    const fit_samples_t samples = fit_samples_of(&p->search, &p->plan);
    shape_start_like(fit->shape, former->shape, former->theta, fit->theta);
    return fit_search(fit, &samples, SEARCH_EVALUATIONS);
}

/// The families in order of complexity.
static const struct {
    curve_type_t envelope, nonhysteretic;
} family[] = {
    {CURVE_LINEAR, CURVE_LINEAR}, {CURVE_LINEAR, CURVE_TABLE}, {CURVE_TANH, CURVE_LINEAR},
    {CURVE_TANH, CURVE_TANH},     {CURVE_TANH, CURVE_TABLE},   {CURVE_TABLE, CURVE_TABLE},
};
enum { NUM_FAMILIES = sizeof family / sizeof *family };

static bool wanted_family(identify_envelope_t envelope, size_t index)
{
    switch (envelope) {
    case IDENTIFY_LINEAR:
        return family[index].envelope == CURVE_LINEAR;
    case IDENTIFY_TANH:
        return family[index].envelope == CURVE_TANH;
    case IDENTIFY_TABLE:
        // The tanh family is where the table's search starts.
        return index >= 4;
    case IDENTIFY_AUTO:
        break;
    }
    return true;
}

typedef struct {
    shape_t shape[NUM_FAMILIES];
    fit_t fit[NUM_FAMILIES];
    bool tried[NUM_FAMILIES];
} families_t;

static outcome_t try_family(const problem_t* p, families_t* f, size_t index)
{
    f->shape[index] = shape_new(family[index].envelope, family[index].nonhysteretic, p->knot, NUM_KNOTS);
    f->fit[index] = fit_new(&f->shape[index], p->options->num_plays);
    f->tried[index] = true;
    fit_t* fit = &f->fit[index];
    const fit_samples_t samples = fit_samples_of(&p->search, &p->plan);
    if (family[index].envelope == CURVE_LINEAR) {
        return fit_search(fit, &samples, SEARCH_EVALUATIONS);
    }
    if (family[index].envelope == CURVE_TABLE) {
        return search_table(p, fit, &f->fit[index - 1]);
    }
    return search_from_several(p, fit);
}

/// The simplest family that no richer one beats clearly.
static size_t choose_family(const families_t* f, identify_envelope_t envelope, double output_range)
{
    size_t chosen = NUM_FAMILIES;
    for (size_t i = 0; i < NUM_FAMILIES; i++) {
        const bool allowed = f->tried[i] && (envelope != IDENTIFY_TABLE || family[i].envelope == CURVE_TABLE);
        const bool has_table = family[i].envelope == CURVE_TABLE || family[i].nonhysteretic == CURVE_TABLE;
        const double worthwhile = has_table ? worthwhile_table : worthwhile_tanh;
        if (allowed && (chosen == NUM_FAMILIES || (f->fit[chosen].rmse > good_enough * output_range &&
                                                   f->fit[i].rmse < worthwhile * f->fit[chosen].rmse))) {
            chosen = i;
        }
    }
    return chosen;
}

static void families_free(families_t* f)
{
    for (size_t i = 0; i < NUM_FAMILIES; i++) {
        fit_free(&f->fit[i]);
        shape_free(&f->shape[i]);
    }
}

/// Fits all families on the thinned record; *chosen is the one to keep.
static outcome_t search_families(const problem_t* p, families_t* f, identify_result_t* result, size_t* chosen)
{
    outcome_t outcome = OUTCOME_OK;
    for (size_t i = 0; i < NUM_FAMILIES && outcome == OUTCOME_OK; i++) {
        if (!wanted_family(p->options->envelope, i)) {
            continue;
        }
        message_progress("identify", (double)i / NUM_FAMILIES);
        outcome = try_family(p, f, i);
        result->candidate[result->num_candidates++] =
            (identify_candidate_t){family[i].envelope, family[i].nonhysteretic, f->fit[i].rmse};
    }
    message_progress_done();
    *chosen = choose_family(f, p->options->envelope, p->output_range);
    return outcome;
}

/// The fit in physical units. Linear envelopes are the identity of the input itself, the others keep their
/// own scale.
static model_t build_model(const problem_t* p, const fit_t* fit)
{
    const double scale = fit->shape->envelope == CURVE_LINEAR ? p->half_range : 1;
    model_t model = model_new("model");
    model.input_min = p->centre - p->half_range;
    model.input_max = p->centre + p->half_range;
    double* raw = xcalloc(fit->shape->num_raw + 1, sizeof *raw);
    shape_raw(fit->shape, fit->theta, raw);
    curve_free(&model.ascending);
    curve_free(&model.descending);
    curve_free(&model.nonhysteretic);
    model.ascending = shape_curve_ascending(fit->shape, raw, p->centre, p->half_range);
    model.descending = shape_curve_descending(fit->shape, raw, p->centre, p->half_range);
    double constant = fit->constant;
    model_set_num_plays(&model, fit->num_plays);
    // The search saw the envelopes at the samples and knots only; between them they may come closer by a
    // trifle.
    const double least = model_least_radius(&model);
    for (size_t j = 0; j < fit->num_plays; j++) {
        model.radius[j] = fmax(scale * fit->radius[j], least);
        model.weight[j] = fit->weight[j] / scale;
        // The scaled identity is (v - centre) / half_range.
        constant -= fit->shape->envelope == CURVE_LINEAR ? fit->weight[j] * p->centre / scale : 0;
    }
    model.nonhysteretic =
        shape_curve_nonhysteretic(fit->shape, raw, fit->coefficient, constant, p->centre, p->half_range);
    free(raw);
    return model;
}

/// Mean of y, weighted by du: negative for a loop whose ascending branch lies below the descending one, as
/// any play's does. Half the loop's mean width, in output units.
static double loop_sense(const record_t* record, size_t first)
{
    const double* input = record->input;
    const double* output = record->output;
    const size_t last = record->num_samples - 1;
    double area = 0;
    double travel = 0;
    const double closing = input[first] - input[last];
    for (size_t t = first + 1; t <= last; t++) {
        const double step = input[t] - input[t - 1];
        area += 0.5 * (output[t] + output[t - 1]) * step;
        travel += fabs(step);
    }
    // The way back along the straight chord closes the path, so that an offset of y cancels.
    area += 0.5 * (output[first] + output[last]) * closing;
    return area / (travel + fabs(closing));
}

/// Figures of the finished model over the samples of the record from `first` on.
static void measure(const problem_t* p, size_t first, identify_result_t* result)
{
    const record_t* record = p->record;
    double* error = xmalloc(record->num_samples * sizeof *error);
    const start_t start = result->model.initial != NULL ? START_MODEL : result->start;
    reference_run(&result->model, start, record->input, record->num_samples, error);
    for (size_t t = 0; t < record->num_samples; t++) {
        error[t] -= record->output[t];
    }
    result->num_samples = series_drop_carried(record->carried, error, record->num_samples);
    result->first_fitted = count_measured(record, first);
    double sum = 0;
    for (size_t t = result->first_fitted; t < result->num_samples; t++) {
        sum += error[t] * error[t];
        result->max_error = fmax(result->max_error, fabs(error[t]));
    }
    free(error);
    result->rmse = sqrt(sum / (double)(result->num_samples - result->first_fitted));
    result->relative = result->rmse / p->output_range;
    result->output_range = p->output_range;
    result->clockwise = loop_sense(record, first) > clockwise_sense * p->output_range;
    result->monotone_floor = monotone_floor(record, first);
}

/// Refines the chosen fit on more of the record and settles what to do with its first stretch.
static outcome_t finish(problem_t* p, fit_t* fit, identify_result_t* result)
{
    samples_t final = samples_new(p->record, p->centre, p->half_range, FINAL_SAMPLES);
    fit_samples_t samples = fit_samples_of(&final, &p->plan);
    samples_use_from(&final, p->plan.leave_out ? final.wiped : 0);
    outcome_t outcome = fit_search(fit, &samples, FINAL_EVALUATIONS);
    if (outcome == OUTCOME_OK && p->plan.leave_out) {
        start_try_assumptions(&p->plan, fit, &final);
        samples = fit_samples_of(&final, &p->plan);
        outcome = fit_weights(fit, &samples);
    }
    if (outcome == OUTCOME_OK) {
        result->model = build_model(p, fit);
        result->memory = p->plan.leave_out              ? MEMORY_LEFT_OUT
                         : p->plan.start == START_MODEL ? MEMORY_ESTIMATED
                                                        : MEMORY_ASSUMED;
        result->start = p->plan.start == START_MODEL ? START_NEGATIVE_SATURATION : p->plan.start;
        result->undetermined = xcalloc(fit->num_plays, sizeof *result->undetermined);
        for (size_t j = 0; j < fit->num_plays; j++) {
            result->undetermined[j] = !fit->moved[j];
            result->num_undetermined += !fit->moved[j];
        }
        if (p->plan.start == START_MODEL) {
            start_write_initial(&p->plan, &result->model, p->record->input[0]);
        }
        measure(p, p->plan.leave_out ? final.index[final.wiped] : 0, result);
    }
    samples_free(&final);
    return outcome;
}

/// The memory's start is unknown and matters for much of the record: estimate it with linear envelopes, then
/// go on.
static outcome_t plan_start(problem_t* p)
{
    start_plan_choose(&p->plan, &p->search, p->options->num_plays);
    samples_use_from(&p->search, p->plan.leave_out ? p->search.wiped : 0);
    if (p->plan.start != START_MODEL) {
        return OUTCOME_OK;
    }
    shape_t shape = shape_new(CURVE_LINEAR, CURVE_TABLE, p->knot, NUM_KNOTS);
    fit_t fit = fit_new(&shape, p->options->num_plays);
    outcome_t outcome = OUTCOME_OK;
    for (size_t round = 0; round < 3 && outcome == OUTCOME_OK; round++) {
        const fit_samples_t samples = fit_samples_of(&p->search, &p->plan);
        outcome = fit_weights(&fit, &samples);
        if (outcome == OUTCOME_OK) {
            start_estimate(&p->plan, &fit, &p->search);
        }
    }
    fit_free(&fit);
    shape_free(&shape);
    return outcome;
}

outcome_t identify(const record_t* record, const identify_options_t* options, identify_result_t* result)
{
    *result = (identify_result_t){0};
    problem_t p = {.record = record, .options = options};
    outcome_t outcome = check_record(&p);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    // Small matrices: threads cost more than they gain, and one thread gives the same bits each time.
    openblas_set_num_threads(1);
    p.search = samples_new(record, p.centre, p.half_range, SEARCH_SAMPLES);
    place_knots(&p);
    families_t families = {0};
    size_t chosen = 0;
    outcome = plan_start(&p);
    if (outcome == OUTCOME_OK) {
        outcome = search_families(&p, &families, result, &chosen);
    }
    if (outcome == OUTCOME_OK && p.plan.start == START_MODEL) {
        start_estimate(&p.plan, &families.fit[chosen], &p.search);
    }
    if (outcome == OUTCOME_OK) {
        outcome = finish(&p, &families.fit[chosen], result);
    }
    if (outcome == OUTCOME_NUMERICAL) {
        message_error(outcome, (location_t){.file = record->path},
                      "the least-squares fit did not settle, expected a record with finite, distinct values");
    }
    families_free(&families);
    samples_free(&p.search);
    start_plan_free(&p.plan);
    return outcome;
}

void identify_result_free(identify_result_t* result)
{
    model_free(&result->model);
    free(result->undetermined);
    *result = (identify_result_t){0};
}
