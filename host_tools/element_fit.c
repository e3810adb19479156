#include "element_fit.h"

#include "bounded.h"
#include "model.h"
#include "series.h"
#include <cblas.h>
#include <cminpack.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STARTS = 4, BRIEF_EVALUATIONS = 60, LAST_EVALUATIONS = 400, BENDS = ELEMENT_CURVE - 2 };
/// How far the curve may bend from spline to spline for the cost of an error of the noise's size, in parts of
/// the output's range.
static const double free_bend = 0.3;

typedef struct {
    bounds_t bounds;
    double start[STARTS];
} shape_t;

static const shape_t shapes[ELEMENT_KINDS][ELEMENT_SHAPES] = {
    [ELEMENT_BOUC_WEN] = {[BOUC_WEN_STEEPNESS] = {{0.3, 50, true}, {3, 8, 8, 20}},
                          [BOUC_WEN_ORDER] = {{0.5, 4, true}, {1, 1, 2, 1.5}},
                          [BOUC_WEN_FALLING] = {{0.25, 4, true}, {1, 1, 1, 1}},
                          [BOUC_WEN_RISING_BACK] = {{-2, 1, false}, {-0.4, -0.4, 0, -0.4}},
                          [BOUC_WEN_FALLING_BACK] = {{-2, 1, false}, {-0.4, -0.4, 0, -0.4}},
                          [ELEMENT_INPUT_AHEAD] = {{-1, 1, false}, {0, 0, 0, 0}},
                          [ELEMENT_STATE_AHEAD] = {{-1, 1, false}, {0, 0, 0, 0}}},
    [ELEMENT_JILES_ATHERTON] = {[ATHERTON_SHAPE] = {{0.03, 3, true}, {0.2, 0.2, 0.5, 0.5}},
                                [ATHERTON_PINNING] = {{0.01, 2, true}, {0.1, 0.3, 0.1, 0.3}},
                                [ATHERTON_COUPLING] = {{-0.5, 1.5, false}, {0.05, 0.05, 0.1, 0.1}},
                                [ATHERTON_BOWING] = {{0, 0.9, false}, {0.2, 0.2, 0.2, 0.2}},
                                [ATHERTON_CENTRE] = {{-0.5, 0.5, false}, {0, 0, 0, 0}},
                                [ELEMENT_INPUT_AHEAD] = {{-1, 1, false}, {0, 0, 0, 0}},
                                [ELEMENT_STATE_AHEAD] = {{-1, 1, false}, {0, 0, 0, 0}}},
};

/// Gain and curve are linear: for given shapes they are found by projection, so that only shapes are searched
/// (G. H. Golub, V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413).
typedef struct {
    const element_record_t* record;
    element_t element;
    size_t num_rows; ///< samples, then what the curve's bends cost
    double* splines; ///< [ELEMENT_CURVE][num_rows] the bends' rows included
    double* basis;   ///< [ELEMENT_CURVE][num_rows] orthonormal, of the same span
    double* output;  ///< [num_rows]
    double* wanted;  ///< [num_rows] the output but for what the curve can give
    double* state;   ///< [num_rows]
} fit_t;

static bool counts(const element_record_t* record, size_t sample)
{
    return record->carried == NULL || !record->carried[sample];
}

static void take_curve_out(const fit_t* f, double* series)
{
    const int m = (int)f->num_rows;
    double amount[ELEMENT_CURVE];
    cblas_dgemv(CblasColMajor, CblasTrans, m, ELEMENT_CURVE, 1, f->basis, m, series, 1, 0, amount, 1);
    cblas_dgemv(CblasColMajor, CblasNoTrans, m, ELEMENT_CURVE, -1, f->basis, m, amount, 1, 1, series, 1);
}

static fit_t fit_new(element_kind_t kind, const element_record_t* record)
{
    const size_t n = record->num_samples;
    const size_t m = n + BENDS;
    fit_t f = {.record = record,
               .element = {.kind = kind, .input_min = record->input_min, .input_max = record->input_max},
               .num_rows = m,
               .splines = xcalloc(m * ELEMENT_CURVE, sizeof(double)),
               .basis = xmalloc(m * ELEMENT_CURVE * sizeof(double)),
               .output = xcalloc(m, sizeof(double)),
               .wanted = xmalloc(m * sizeof(double)),
               .state = xmalloc(m * sizeof(double))};
    for (size_t t = 0; t < n; t++) {
        double spline[ELEMENT_CURVE];
        element_splines(element_part(&f.element, record->input[t]), spline);
        for (size_t k = 0; k < ELEMENT_CURVE; k++) {
            f.splines[k * m + t] = counts(record, t) ? spline[k] : 0;
        }
        f.output[t] = counts(record, t) ? record->output[t] : 0;
    }
    const double stiffness = record->noise / (free_bend * series_span(record->output, record->num_samples));
    for (size_t b = 0; b < BENDS; b++) {
        f.splines[b * m + n + b] = stiffness;
        f.splines[(b + 1) * m + n + b] = -2 * stiffness;
        f.splines[(b + 2) * m + n + b] = stiffness;
    }
    memcpy(f.basis, f.splines, m * ELEMENT_CURVE * sizeof(double));
    double factor[ELEMENT_CURVE];
    (void)LAPACKE_dgeqrf(LAPACK_COL_MAJOR, (int)m, ELEMENT_CURVE, f.basis, (int)m, factor);
    (void)LAPACKE_dorgqr(LAPACK_COL_MAJOR, (int)m, ELEMENT_CURVE, ELEMENT_CURVE, f.basis, (int)m, factor);
    memcpy(f.wanted, f.output, m * sizeof(double));
    take_curve_out(&f, f.wanted);
    return f;
}

static void fit_free(fit_t* f)
{
    free(f->splines);
    free(f->basis);
    free(f->output);
    free(f->wanted);
    free(f->state);
}

static void run_state(const element_t* element, const double* input, size_t num_samples, double* state)
{
    element_state_t s = element_saturated(element);
    for (size_t t = 0; t < num_samples; t++) {
        state[t] = element_step(&s, input[t]);
    }
}

/// The states where samples count, and 0 elsewhere.
static void states(const fit_t* f, double* state)
{
    memset(state, 0, f->num_rows * sizeof *state);
    run_state(&f->element, f->record->input, f->record->num_samples, state);
    for (size_t t = 0; t < f->record->num_samples; t++) {
        state[t] = counts(f->record, t) ? state[t] : 0;
    }
}

static void set_shapes(element_t* element, const double* theta)
{
    for (size_t k = 0; k < ELEMENT_SHAPES; k++) {
        element->shape[k] = bounded_from_free(shapes[element->kind][k].bounds, theta[k]);
    }
}

static int minpack_residual(void* context, int m, int n, const double* theta, double* residual, int task)
{
    (void)n;
    (void)task;
    fit_t* f = context;
    set_shapes(&f->element, theta);
    states(f, f->state);
    take_curve_out(f, f->state);
    const double energy = cblas_ddot(m, f->state, 1, f->state, 1);
    f->element.gain = energy > 0 ? cblas_ddot(m, f->state, 1, f->wanted, 1) / energy : 0;
    memcpy(residual, f->wanted, (size_t)m * sizeof *residual);
    cblas_daxpy(m, -f->element.gain, f->state, 1, residual, 1);
    return 0;
}

/// From theta on; the sum of squares that is left.
static double search(fit_t* f, double* theta, int evaluations)
{
    enum { N = ELEMENT_SHAPES };
    const size_t m = f->num_rows;
    double* work = xmalloc((2 * m + m * N) * sizeof *work);
    double vectors[5][N];
    int pivot[N];
    int done = 0;
    lmdif(minpack_residual, f, (int)m, N, theta, work, 1e-7, 1e-7, 0, evaluations, 1e-8, vectors[0], 1, 1, 0,
          &done, work + 2 * m, (int)m, pivot, vectors[1], vectors[2], vectors[3], vectors[4], work + m);
    (void)minpack_residual(f, (int)m, N, theta, work, 0);
    const double left = cblas_ddot((int)m, work, 1, work, 1);
    free(work);
    return left;
}

/// The curve beside the present shapes and gain; false where the record does not determine it.
static bool set_curve(fit_t* f)
{
    const int m = (int)f->num_rows;
    double gram[ELEMENT_CURVE * ELEMENT_CURVE];
    states(f, f->state);
    cblas_dscal(m, -f->element.gain, f->state, 1);
    cblas_daxpy(m, 1, f->output, 1, f->state, 1);
    cblas_dsyrk(CblasColMajor, CblasUpper, CblasTrans, ELEMENT_CURVE, m, 1, f->splines, m, 0, gram,
                ELEMENT_CURVE);
    cblas_dgemv(CblasColMajor, CblasTrans, m, ELEMENT_CURVE, 1, f->splines, m, f->state, 1, 0,
                f->element.curve, 1);
    return LAPACKE_dposv(LAPACK_COL_MAJOR, 'U', ELEMENT_CURVE, 1, gram, ELEMENT_CURVE, f->element.curve,
                         ELEMENT_CURVE) == 0 &&
           fabs(f->element.gain) > 0;
}

static double rmse_of(const element_t* element, const element_record_t* record)
{
    double* output = xmalloc(record->num_samples * sizeof *output);
    element_run(element, 0, record->input, record->num_samples, output);
    double sum = 0;
    size_t count = 0;
    for (size_t t = 0; t < record->num_samples; t++) {
        if (counts(record, t)) {
            sum += (output[t] - record->output[t]) * (output[t] - record->output[t]);
            count++;
        }
    }
    free(output);
    return sqrt(sum / (double)count);
}

element_t element_fit(element_kind_t kind, const element_record_t* record, double* rmse)
{
    fit_t f = fit_new(kind, record);
    double best[ELEMENT_SHAPES] = {0};
    double least = HUGE_VAL;
    for (size_t start = 0; start < STARTS; start++) {
        double theta[ELEMENT_SHAPES];
        for (size_t k = 0; k < ELEMENT_SHAPES; k++) {
            theta[k] = bounded_to_free(shapes[kind][k].bounds, shapes[kind][k].start[start]);
        }
        const double left = search(&f, theta, BRIEF_EVALUATIONS);
        if (left < least) {
            least = left;
            memcpy(best, theta, sizeof best);
        }
    }
    (void)search(&f, best, LAST_EVALUATIONS);
    *rmse = set_curve(&f) ? rmse_of(&f.element, record) : HUGE_VAL;
    const element_t element = f.element;
    fit_free(&f);
    return element;
}

/// A step within the bounds over which to take a difference.
static double difference_step(const element_t* element, size_t shape)
{
    const bounds_t b = shapes[element->kind][shape].bounds;
    const double value = element->shape[shape];
    const double step = 1e-4 * fmax(fabs(value), 0.01 * (b.high - b.low));
    return value + step <= b.high ? step : -step;
}

/// One column of the derivatives: how the states of `other`, which has a number `step` further, differ.
static void fill_column(const element_t* other, double step, const double* input, size_t num_samples,
                        const double* state, double* column)
{
    double* moved = xmalloc(num_samples * sizeof *moved);
    run_state(other, input, num_samples, moved);
    for (size_t t = 0; t < num_samples; t++) {
        column[t * ELEMENT_FREE] = other->gain * (moved[t] - state[t]) / step;
    }
    free(moved);
}

void element_derivatives(const element_t* element, const double* input, size_t num_samples,
                         double* derivatives)
{
    double* state = xmalloc(num_samples * sizeof *state);
    run_state(element, input, num_samples, state);
    for (size_t k = 0; k < ELEMENT_SHAPES; k++) {
        element_t other = *element;
        const double step = difference_step(element, k);
        other.shape[k] += step;
        fill_column(&other, step, input, num_samples, state, derivatives + k);
    }
    for (size_t t = 0; t < num_samples; t++) {
        double* row = &derivatives[t * ELEMENT_FREE];
        row[ELEMENT_SHAPES] = state[t];
        element_splines(element_part(element, input[t]), row + ELEMENT_SHAPES + 1);
    }
    free(state);
}

/// What is expected of a number before the record: a standard deviation.
static double expected(const element_t* element, const element_record_t* record, size_t number)
{
    if (number < ELEMENT_SHAPES) {
        const bounds_t b = shapes[element->kind][number].bounds;
        return b.high - b.low;
    }
    return series_span(record->output, record->num_samples);
}

void element_precision(const element_t* element, const element_record_t* record, double* precision)
{
    const size_t n = record->num_samples;
    double* rows = xmalloc(n * ELEMENT_FREE * sizeof *rows);
    element_derivatives(element, record->input, n, rows);
    for (size_t t = 0; t < n; t++) {
        cblas_dscal(ELEMENT_FREE, counts(record, t) ? 1 / record->noise : 0, rows + t * ELEMENT_FREE, 1);
    }
    cblas_dsyrk(CblasColMajor, CblasUpper, CblasNoTrans, ELEMENT_FREE, (int)n, 1, rows, ELEMENT_FREE, 0,
                precision, ELEMENT_FREE);
    free(rows);
    for (size_t k = 0; k < ELEMENT_FREE; k++) {
        const double wide = expected(element, record, k);
        precision[k * ELEMENT_FREE + k] += 1 / (wide * wide);
    }
}
