#include "duhem_fit.h"

#include "reference.h"
#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SERIES = 2, ELSEWHERE = 4000, MOST_ITERATIONS = 30, MOST_TRIALS = 6, MOST_ROWS = 6000 };
/// How far the slope may bend from node to node for the cost of an error of the noise's size, in parts of the
/// steepest.
static const double free_bend = 0.03;
/// Weight of an error against the model where the record never was, beside one against the record; the
/// model's own misfit is its unit.
static const double trust_in_model = 0.01;

/// A series to follow.
typedef struct {
    const double* input;
    const double* output;
    const bool* carried; ///< [num_samples] or NULL: no error is counted there
    double* modelled;    ///< the model's own output
    size_t num_samples;
    size_t stride; ///< errors are counted at every stride-th sample
    start_t start;
    double weight; ///< of a squared error
} series_t;

static size_t rows_of(const series_t* series)
{
    return (series->num_samples + series->stride - 1) / series->stride;
}

static bool counts(const series_t* series, size_t sample)
{
    return sample % series->stride == 0 && (series->carried == NULL || !series->carried[sample]);
}

static size_t count_errors(const series_t* series)
{
    size_t count = 0;
    for (size_t t = 0; t < series->num_samples; t++) {
        count += counts(series, t);
    }
    return count;
}

typedef struct {
    const model_t* model;
    series_t series[SERIES]; ///< the record, and the model itself over an input that goes everywhere
    bool is_guided;          ///< slopes are taken along `modelled`: what is left is linear
    double stiffness;        ///< weight of a squared second difference of neighbouring slopes
    double* residual;        ///< [rows of all series]
    double* jacobian;        ///< [rows of all series][DUHEM_FREE]
} fit_t;

static double* free_number(duhem_t* d, size_t k)
{
    return k == DUHEM_FREE - 1 ? &d->saturated : &d->slope[k / DUHEM_NODES][k % DUHEM_NODES];
}

/// Sum of squared weighted errors; fills residual and, where there is one, jacobian.
static double follow(const fit_t* f, const series_t* series, const duhem_t* d, double* residual,
                     double* jacobian)
{
    double derivative[DUHEM_FREE];
    const double scale = sqrt(series->weight);
    duhem_state_t s =
        duhem_start(d, f->model, series->start, series->input[0], jacobian != NULL ? derivative : NULL);
    double guide[2] = {d->saturated, d->saturated};
    s.guide = f->is_guided ? guide : NULL;
    double sum = 0;
    for (size_t t = 0; t < series->num_samples; t++) {
        guide[0] = guide[1];
        guide[1] = series->modelled[t];
        const double output = duhem_step(&s, series->input[t]);
        if (t % series->stride != 0) {
            continue;
        }
        const double weight = counts(series, t) ? scale : 0;
        const double error = weight * (series->output[t] - output);
        const size_t row = t / series->stride;
        residual[row] = error;
        sum += error * error;
        for (size_t k = 0; jacobian != NULL && k < DUHEM_FREE; k++) {
            jacobian[row * DUHEM_FREE + k] = weight * derivative[k];
        }
    }
    return sum;
}

/// Three nodes in a row: their second difference joins the cost and, where there are any, the normal
/// equations.
static double stiffen(const fit_t* f, duhem_t* d, size_t first, size_t stride, double* gram, double* right)
{
    const size_t at[] = {first, first + stride, first + 2 * stride};
    static const double by[] = {1, -2, 1};
    double bend = 0;
    for (size_t a = 0; a < 3; a++) {
        bend += by[a] * *free_number(d, at[a]);
    }
    for (size_t a = 0; gram != NULL && a < 3; a++) {
        right[at[a]] -= f->stiffness * by[a] * bend;
        for (size_t b = 0; b < 3; b++) {
            gram[at[a] * DUHEM_FREE + at[b]] += f->stiffness * by[a] * by[b];
        }
    }
    return f->stiffness * bend * bend;
}

static double stiffen_all(const fit_t* f, duhem_t* d, double* gram, double* right)
{
    double sum = 0;
    for (size_t k = 0; k < DUHEM_FREE - 1; k++) {
        const size_t column = k % DUHEM_NODES / DUHEM_ROWS;
        const size_t row = k % DUHEM_ROWS;
        sum += column + 2 < DUHEM_COLUMNS ? stiffen(f, d, k, DUHEM_ROWS, gram, right) : 0;
        sum += row + 2 < DUHEM_ROWS ? stiffen(f, d, k, 1, gram, right) : 0;
    }
    return sum;
}

static double cost(const fit_t* f, duhem_t* d, double* jacobian)
{
    double sum = stiffen_all(f, d, NULL, NULL);
    size_t done = 0;
    for (size_t k = 0; k < SERIES; k++) {
        sum += follow(f, &f->series[k], d, f->residual + done,
                      jacobian != NULL ? jacobian + done * DUHEM_FREE : NULL);
        done += rows_of(&f->series[k]);
    }
    return sum;
}

/// The normal equations at d.
static void linearise(const fit_t* f, duhem_t* d, double* gram, double* right)
{
    const int rows = (int)(rows_of(&f->series[0]) + rows_of(&f->series[1]));
    memset(gram, 0, (size_t)DUHEM_FREE * DUHEM_FREE * sizeof *gram);
    (void)cost(f, d, f->jacobian);
    cblas_dsyrk(CblasColMajor, CblasUpper, CblasNoTrans, DUHEM_FREE, rows, 1, f->jacobian, DUHEM_FREE, 0,
                gram, DUHEM_FREE);
    cblas_dgemv(CblasColMajor, CblasNoTrans, DUHEM_FREE, rows, 1, f->jacobian, DUHEM_FREE, f->residual, 1, 0,
                right, 1);
    (void)stiffen_all(f, d, gram, right);
}

/// One damped Gauss-Newton step; false where it gains less than a thousandth.
static bool improve(const fit_t* f, duhem_t* d, double* present, double* damping)
{
    const size_t size = (size_t)DUHEM_FREE * DUHEM_FREE * sizeof(double);
    double* gram = xmalloc(size);
    double* factor = xmalloc(size);
    double right[DUHEM_FREE];
    const double before = *present;
    linearise(f, d, gram, right);
    for (int trial = 0; trial < MOST_TRIALS && !(*present < before); trial++) {
        double move[DUHEM_FREE];
        memcpy(factor, gram, size);
        memcpy(move, right, sizeof move);
        for (size_t k = 0; k < DUHEM_FREE; k++) {
            factor[k * DUHEM_FREE + k] *= 1 + *damping;
        }
        duhem_t tried = *d;
        double reached = HUGE_VAL;
        if (LAPACKE_dposv(LAPACK_COL_MAJOR, 'U', DUHEM_FREE, 1, factor, DUHEM_FREE, move, DUHEM_FREE) == 0) {
            for (size_t k = 0; k < DUHEM_FREE; k++) {
                *free_number(&tried, k) += move[k];
            }
            reached = cost(f, &tried, NULL);
        }
        *damping *= reached < before ? 0.1 : 10;
        if (reached < before) {
            *present = reached;
            *d = tried;
        }
    }
    free(gram);
    free(factor);
    return *present < before * (1 - 1e-3);
}

/// Reversals all over the range, as a quasi-random sequence has them.
static void go_everywhere(const model_t* model, double* input, size_t num_samples)
{
    const double span = model->input_max - model->input_min;
    double part = 0;
    double target = 1;
    double turn = 0;
    for (size_t t = 0; t < num_samples; t++) {
        input[t] = model->input_min + part * span;
        part += fmin(fmax(target - part, -0.02), 0.02);
        if (!(fabs(target - part) > 0)) {
            turn += 1;
            target = fmod(turn * 0.6180339887498949 + turn * turn * 0.4142135623730951, 1);
        }
    }
}

/// The fit of prepared series.
static duhem_t fit(fit_t* f)
{
    duhem_t d = duhem_new(f->model);
    double steepest = 0;
    for (size_t k = 0; k < DUHEM_NODES; k++) {
        steepest = fmax(steepest, fabs(d.slope[1][k]));
    }
    f->stiffness = 1 / (free_bend * steepest * free_bend * steepest);
    double damping = 1e-6;
    f->is_guided = true;
    double present = cost(f, &d, NULL);
    (void)improve(f, &d, &present, &damping);
    f->is_guided = false;
    present = cost(f, &d, NULL);
    damping = 1e-3;
    int iteration = 0;
    while (iteration < MOST_ITERATIONS && improve(f, &d, &present, &damping)) {
        iteration++;
    }
    return d;
}

/// Of what the model leaves of the samples that were measured.
static double model_mean_square(const record_t* bench, const double* modelled)
{
    double sum = 0;
    double count = 0;
    for (size_t t = 0; t < bench->num_samples; t++) {
        if (!record_is_carried(bench, t)) {
            sum += (bench->output[t] - modelled[t]) * (bench->output[t] - modelled[t]);
            count += 1;
        }
    }
    return sum / count;
}

duhem_t duhem_fit(const model_t* model, start_t start, const record_t* bench, double noise, double* rmse,
                  double* precision)
{
    const size_t num_samples = bench->num_samples;
    double* elsewhere = xmalloc(ELSEWHERE * sizeof *elsewhere);
    double* modelled = xmalloc((num_samples + ELSEWHERE) * sizeof *modelled);
    go_everywhere(model, elsewhere, ELSEWHERE);
    reference_run(model, start, bench->input, num_samples, modelled);
    reference_run(model, START_NEGATIVE_SATURATION, elsewhere, ELSEWHERE, modelled + num_samples);
    const double misfit = noise * noise + model_mean_square(bench, modelled);
    const series_t record = {.input = bench->input,
                             .output = bench->output,
                             .carried = bench->carried,
                             .modelled = modelled,
                             .num_samples = num_samples,
                             .stride = num_samples / MOST_ROWS + 1,
                             .start = start,
                             .weight = 1 / (noise * noise)};
    const series_t everywhere = {.input = elsewhere,
                                 .output = modelled + num_samples,
                                 .modelled = modelled + num_samples,
                                 .num_samples = ELSEWHERE,
                                 .stride = 1,
                                 .start = START_NEGATIVE_SATURATION,
                                 .weight = trust_in_model / misfit};
    const size_t rows = rows_of(&record) + rows_of(&everywhere);
    fit_t f = {.model = model,
               .series = {record, everywhere},
               .residual = xmalloc(rows * sizeof(double)),
               .jacobian = xmalloc(rows * DUHEM_FREE * sizeof(double))};
    duhem_t d = fit(&f);
    double right[DUHEM_FREE];
    linearise(&f, &d, precision, right);
    *rmse = noise * sqrt(follow(&f, &record, &d, f.residual, NULL) / (double)count_errors(&record));
    free(f.residual);
    free(f.jacobian);
    free(elsewhere);
    free(modelled);
    return d;
}
