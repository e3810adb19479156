#include "diagnose_body.h"

#include "duhem_fit.h"
#include "element_fit.h"
#include "everett_fit.h"
#include "record_thin.h"
#include "reference.h"
#include "series.h"
#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Of what a Preisach body leaves, squared, what a Duhem body may leave: it has more free numbers than any
/// other and fits the loops it has seen; on other work of a plant of Preisach's kind it is several times
/// worse.
static const double clearly_less = 0.25;
/// Of what the model, or a Preisach body, leaves beyond the noise, squared, what an element may leave, which
/// holds in all loops;
static const double half = 0.5;
/// of all that it leaves, where the element is no further from the record than the model by this.
static const double less_with_few = 0.95;
static const double no_more = 1.05;
/// Samples of a long calibration that an element is fitted to.
static const size_t most_calibrated = 12000;
/// How much a body may be off on other work, in parts of what it differs from the model by.
static const double doubt_of_tables = 0.05;
static const double doubt_of_element[ELEMENT_KINDS] = {
    [ELEMENT_BOUC_WEN] = 0.001, [ELEMENT_JILES_ATHERTON] = 0.01};

/// Whether the body is at least as near to the record as the model, whatever else acts on it.
static bool is_near(const model_t* model, start_t start, const stand_in_t* body, const record_t* record)
{
    const size_t n = record->num_samples;
    double* output = xmalloc(n * sizeof *output);
    stand_in_run(body, model, start, 0, record->input, n, output);
    const double with = series_mean_square(output, record->output, n);
    reference_run(model, start, record->input, n, output);
    const double without = series_mean_square(output, record->output, n);
    free(output);
    return with <= no_more * without;
}

typedef struct {
    const body_t* body;
    const model_t* model;
    start_t start;
    const double* input;
    duhem_state_t state;
    double derivative[DUHEM_FREE];
    everett_past_t past;
    const double* model_output;
    const double* derivatives; ///< [samples][ELEMENT_FREE] of an element
} rows_t;

static void duhem_rows(void* context, size_t begin, size_t end, double* derivatives)
{
    rows_t* r = context;
    if (begin == 0) {
        r->state = duhem_start(&r->body->stand_in.duhem, r->model, r->start, r->input[0], r->derivative);
    }
    for (size_t t = begin; t < end; t++) {
        (void)duhem_step(&r->state, r->input[t]);
        memcpy(&derivatives[(t - begin) * DUHEM_FREE], r->derivative, sizeof r->derivative);
    }
}

static void element_rows(void* context, size_t begin, size_t end, double* derivatives)
{
    const rows_t* r = context;
    memcpy(derivatives, &r->derivatives[begin * ELEMENT_FREE],
           (end - begin) * ELEMENT_FREE * sizeof *derivatives);
}

static void everett_rows(void* context, size_t begin, size_t end, double* derivatives)
{
    rows_t* r = context;
    if (begin == 0) {
        r->past = everett_start(r->model);
    }
    for (size_t t = begin; t < end; t++) {
        everett_step(&r->past, r->input[t], r->model_output[t], &derivatives[(t - begin) * EVERETT_FREE]);
    }
}

/// Directions that add less than this to the record's squared error, in squared misfits, say nothing.
static const double least_energy = 1;

/// Where the calibration says nothing, a Preisach body differs from the model by no more than this many times
/// what it differs by on the calibration.
static const double few = 3;

static void scale(double* precision, size_t numbers, double factor)
{
    for (size_t column = 0; column < numbers; column++) {
        cblas_dscal((int)column + 1, factor, precision + column * numbers, 1);
    }
}

/// Of the noise's, the least size of one error of the calibration, and how many of them count as one.
static double errors_of(const body_t* body, const model_t* model, start_t start, const record_t* calibration)
{
    const size_t n = calibration->num_samples;
    double* residual = xmalloc(n * sizeof *residual);
    stand_in_run(&body->stand_in, model, start, 0, calibration->input, n, residual);
    for (size_t t = 0; t < n; t++) {
        residual[t] = calibration->output[t] - residual[t];
    }
    const double size = body->misfit / body->noise;
    const size_t measured = series_drop_carried(calibration->carried, residual, n);
    const double errors = size * size * series_correlation(residual, measured);
    free(residual);
    return errors;
}

/// Sets `stand_in`, `misfit`, `doubt` and `nuisance` where it is taken.
static void try_duhem(body_t* body, const model_t* model, start_t start, const record_t* calibration,
                      const record_t* record)
{
    double* precision = xmalloc((size_t)DUHEM_FREE * DUHEM_FREE * sizeof *precision);
    double left = HUGE_VAL;
    const stand_in_t found = {.duhem = duhem_fit(model, start, calibration, body->noise, &left, precision)};
    if (left * left < clearly_less * body->misfit * body->misfit && is_near(model, start, &found, record)) {
        nuisance_free(&body->nuisance);
        body->has_everett = false;
        body->stands_in = true;
        body->stand_in = found;
        body->misfit = left;
        body->doubt = doubt_of_tables;
        scale(precision, DUHEM_FREE, 1 / errors_of(body, model, start, calibration));
        rows_t rows = {.body = body, .model = model, .start = start, .input = record->input};
        body->nuisance = nuisance_new(precision, DUHEM_FREE, record->num_samples, least_energy * left * left,
                                      duhem_rows, &rows);
    }
    free(precision);
}

/// What the calibration leaves open of an element.
static nuisance_t element_nuisance(const body_t* body, const element_record_t* calibration, double errors,
                                   const record_t* record)
{
    const element_t* element = &body->stand_in.element;
    double precision[ELEMENT_FREE * ELEMENT_FREE];
    double* derivatives = xmalloc(record->num_samples * ELEMENT_FREE * sizeof *derivatives);
    element_precision(element, calibration, precision);
    scale(precision, ELEMENT_FREE, 1 / errors);
    element_derivatives(element, record->input, record->num_samples, derivatives);
    rows_t rows = {.derivatives = derivatives};
    const nuisance_t nuisance = nuisance_new(precision, ELEMENT_FREE, record->num_samples,
                                             least_energy * body->misfit * body->misfit, element_rows, &rows);
    free(derivatives);
    return nuisance;
}

/// Sets `everett`, `misfit`, `doubt` and `nuisance`.
static void add_everett(body_t* body, const model_t* model, const record_t* calibration,
                        const record_t* record)
{
    double* precision = xmalloc((size_t)EVERETT_FREE * EVERETT_FREE * sizeof *precision);
    double* model_output = xmalloc(record->num_samples * sizeof *model_output);
    const double beyond_noise = body->misfit * body->misfit - body->noise * body->noise;
    double left;
    body->everett = everett_fit(model, calibration, few * sqrt(beyond_noise), precision, &left);
    body->has_everett = true;
    body->misfit = fmin(left, body->misfit);
    body->doubt = doubt_of_tables;
    scale(precision, EVERETT_FREE, 1 / (left * left));
    reference_run(model, START_NEGATIVE_SATURATION, record->input, record->num_samples, model_output);
    rows_t rows = {.model = model, .input = record->input, .model_output = model_output};
    body->nuisance = nuisance_new(precision, EVERETT_FREE, record->num_samples, least_energy * left * left,
                                  everett_rows, &rows);
    free(precision);
    free(model_output);
}

/// Without a look at the record, which an effect may have moved further than the bodies differ by.
static bool explains_bench(const body_t* body, double left)
{
    const double noise = body->noise * body->noise;
    return left < body->misfit && left * left - noise < half * (body->misfit * body->misfit - noise);
}

/// The better of both kinds of elements; sets `stand_in`, `misfit`, `doubt` and `nuisance` by one that is
/// taken. From negative saturation only.
static void try_elements(body_t* body, const model_t* model, double model_misfit, const record_t* calibration,
                         const record_t* record)
{
    record_t thinned = record_thin(calibration, most_calibrated, 0);
    const element_record_t fitted = {.input = thinned.input,
                                     .output = thinned.output,
                                     .carried = thinned.carried,
                                     .num_samples = thinned.num_samples,
                                     .input_min = model->input_min,
                                     .input_max = model->input_max,
                                     .noise = body->noise};
    const double other_misfit = body->misfit;
    double least = HUGE_VAL;
    stand_in_t best = {.is_element = true};
    for (element_kind_t kind = 0; kind < ELEMENT_KINDS; kind++) {
        double left;
        const element_t element = element_fit(kind, &fitted, &left);
        best.element = left < least ? element : best.element;
        least = fmin(left, least);
    }
    if (explains_bench(body, least) || (least * least < less_with_few * other_misfit * other_misfit &&
                                        is_near(model, START_NEGATIVE_SATURATION, &best, record))) {
        nuisance_free(&body->nuisance);
        body->has_everett = false;
        body->stands_in = true;
        body->stand_in = best;
        body->misfit = least;
    }
    if (body->stands_in) {
        const double missed = fmax(body->misfit * body->misfit - body->noise * body->noise, 0);
        body->doubt = missed / (model_misfit * model_misfit - body->misfit * body->misfit) +
                      doubt_of_element[best.element.kind];
        const double errors = errors_of(body, model, START_NEGATIVE_SATURATION, &thinned);
        body->nuisance = element_nuisance(body, &fitted, errors, record);
    }
    record_free(&thinned);
}

body_t body_find(const model_t* model, start_t start, const record_t* calibration, double model_misfit,
                 double noise, bool is_visited, const record_t* record)
{
    body_t body = {.misfit = model_misfit, .noise = noise};
    if (!(noise > 0 && model_misfit > noise && calibration->num_samples > 2 * DUHEM_FREE)) {
        return body;
    }
    if (start == START_NEGATIVE_SATURATION) {
        if (is_visited) {
            add_everett(&body, model, calibration, record);
        }
        try_elements(&body, model, model_misfit, calibration, record);
    }
    if (is_visited && !body.stands_in && clearly_less * body.misfit * body.misfit > noise * noise) {
        try_duhem(&body, model, start, calibration, record);
    }
    return body;
}

void body_free(body_t* body)
{
    nuisance_free(&body->nuisance);
    *body = (body_t){0};
}
