#include "everett_fit.h"

#include "reference.h"
#include "series.h"
#include <cblas.h>
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FOLDS = 24, ROWS = 64, STRENGTHS = 11, SIZE = EVERETT_FREE * EVERETT_FREE };

/// Of the penalty on third differences, on the coefficients' own squares, so that it has a determinant; and,
/// of the samples, on every coefficient, so that all have one.
static const double own_part = 1e-4;
static const double least_part = 1e-10;

/// The normal equations of one fold's samples.
typedef struct {
    double gram[SIZE]; ///< upper triangle
    double right[EVERETT_FREE];
    double energy;
    double count;
} equations_t;

static void add_to(equations_t* sum, const equations_t* one, double factor)
{
    cblas_daxpy(SIZE, factor, one->gram, 1, sum->gram, 1);
    cblas_daxpy(EVERETT_FREE, factor, one->right, 1, sum->right, 1);
    sum->energy += factor * one->energy;
    sum->count += factor * one->count;
}

/// rows[count][EVERETT_FREE] and what they are to give.
static void add_rows(equations_t* e, const double* rows, const double* wanted, size_t count)
{
    cblas_dsyrk(CblasColMajor, CblasUpper, CblasNoTrans, EVERETT_FREE, (int)count, 1, rows, EVERETT_FREE, 1,
                e->gram, EVERETT_FREE);
    cblas_dgemv(CblasColMajor, CblasNoTrans, EVERETT_FREE, (int)count, 1, rows, EVERETT_FREE, wanted, 1, 1,
                e->right, 1);
    e->energy += cblas_ddot((int)count, wanted, 1, wanted, 1);
    e->count += (double)count;
}

/// fold[FOLDS]: one stretch each.
static void set_equations(equations_t* fold, const model_t* model, const record_t* record,
                          const double* model_output, const double* difference)
{
    double* rows = xmalloc((size_t)ROWS * EVERETT_FREE * sizeof *rows);
    double wanted[ROWS];
    everett_past_t past = everett_start(model);
    size_t block = 0;
    size_t count = 0;
    for (size_t t = 0; t < record->num_samples; t++) {
        everett_step(&past, record->input[t], model_output[t], &rows[count * EVERETT_FREE]);
        wanted[count] = difference[t];
        count += !record_is_carried(record, t);
        const size_t next = (t + 1) * FOLDS / record->num_samples;
        if (next != block || count == ROWS) {
            add_rows(&fold[block], rows, wanted, count);
            block = next;
            count = 0;
        }
    }
    free(rows);
}

/// Adds (third difference from (alpha, beta) on, towards alpha + da, beta + db)^2.
static void stiffen(double* gram, size_t alpha, size_t beta, size_t da, size_t db)
{
    static const double by[] = {1, -3, 3, -1};
    for (size_t p = 0; p < 4; p++) {
        for (size_t q = 0; q < 4; q++) {
            const size_t a[] = {alpha + p * da, alpha + q * da};
            const size_t b[] = {beta + p * db, beta + q * db};
            if (a[0] > b[0] && a[1] > b[1]) {
                gram[everett_node(a[0], b[0]) * EVERETT_FREE + everett_node(a[1], b[1])] += by[p] * by[q];
            }
        }
    }
}

/// penalty[EVERETT_FREE][EVERETT_FREE]: 0 for the constant and the share.
static void set_penalty(double* penalty)
{
    memset(penalty, 0, SIZE * sizeof *penalty);
    for (size_t alpha = 0; alpha < EVERETT_BASIS; alpha++) {
        for (size_t beta = 0; beta <= alpha; beta++) {
            if (alpha + 3 < EVERETT_BASIS) {
                stiffen(penalty, alpha, beta, 1, 0);
            }
            if (beta + 3 <= alpha) {
                stiffen(penalty, alpha, beta, 0, 1);
            }
        }
    }
    for (size_t k = 0; k < EVERETT_NODES; k++) {
        penalty[k * EVERETT_FREE + k] += own_part;
    }
}

/// gram += strength * penalty, and the little on the diagonal.
static void regularise(double* gram, const double* penalty, double strength, double count)
{
    cblas_daxpy(SIZE, strength * count, penalty, 1, gram, 1);
    for (size_t k = 0; k < EVERETT_FREE; k++) {
        gram[k * EVERETT_FREE + k] += least_part * count;
    }
}

/// The coefficients; the logarithm of the regularised matrix's determinant. Where that is not positive
/// definite in this arithmetic, all 0 and infinity.
static double solve(const equations_t* e, const double* penalty, double strength, double* value)
{
    double* gram = xmalloc(sizeof e->gram);
    memcpy(gram, e->gram, sizeof e->gram);
    memcpy(value, e->right, EVERETT_FREE * sizeof *value);
    regularise(gram, penalty, strength, e->count);
    const bool is_solved =
        LAPACKE_dposv(LAPACK_COL_MAJOR, 'U', EVERETT_FREE, 1, gram, EVERETT_FREE, value, EVERETT_FREE) == 0;
    double determinant = 0;
    if (!is_solved) {
        memset(value, 0, EVERETT_FREE * sizeof *value);
        determinant = HUGE_VAL;
    }
    for (size_t k = 0; is_solved && k < EVERETT_FREE; k++) {
        determinant += 2 * log(gram[k * EVERETT_FREE + k]);
    }
    free(gram);
    return determinant;
}

/// Logarithm of how probable such samples are, all coefficients together, up to a constant; error and
/// coefficients' scale are the most probable ones.
static double evidence(const equations_t* e, const double* penalty, double strength)
{
    double value[EVERETT_FREE];
    const double determinant = solve(e, penalty, strength, value);
    const double left = e->energy - cblas_ddot(EVERETT_FREE, e->right, 1, value, 1);
    return 0.5 * (EVERETT_NODES * log(strength * e->count) - determinant -
                  e->count * log(fmax(left, DBL_EPSILON * e->energy) / e->count));
}

static double most_probable_strength(const equations_t* e, const double* penalty)
{
    double most = -HUGE_VAL;
    double strength = 0;
    for (size_t s = 0; s < STRENGTHS; s++) {
        const double tried = pow(10, 1 - (double)s);
        const double found = evidence(e, penalty, tried);
        strength = found > most ? tried : strength;
        most = fmax(found, most);
    }
    return strength;
}

/// Squared error of the coefficients on the equations' samples.
static double error_on(const equations_t* e, const double* value)
{
    double product[EVERETT_FREE];
    cblas_dsymv(CblasColMajor, CblasUpper, EVERETT_FREE, 1, e->gram, EVERETT_FREE, value, 1, 0, product, 1);
    return e->energy - 2 * cblas_ddot(EVERETT_FREE, e->right, 1, value, 1) +
           cblas_ddot(EVERETT_FREE, product, 1, value, 1);
}

/// Mean square left of each fold by the others.
static double held_out_error(const equations_t* fold, const equations_t* all, const double* penalty,
                             double strength)
{
    double error = 0;
    double value[EVERETT_FREE];
    equations_t* rest = xmalloc(sizeof *rest);
    for (size_t k = 0; k < FOLDS; k++) {
        memcpy(rest, all, sizeof *rest);
        add_to(rest, &fold[k], -1);
        (void)solve(rest, penalty, strength, value);
        error += error_on(&fold[k], value);
    }
    free(rest);
    return fmax(error, 0) / all->count;
}

/// Of what the coefficients leave, how many neighbouring samples count as one.
static double correlation_left(const everett_t* everett, const record_t* record, const double* model_output,
                               const double* difference)
{
    const size_t num_samples = record->num_samples;
    double* residual = xmalloc(num_samples * sizeof *residual);
    for (size_t t = 0; t < num_samples; t++) {
        residual[t] = -difference[t];
    }
    everett_add(everett, NULL, 0, record->input, model_output, num_samples, residual);
    const size_t measured = series_drop_carried(record->carried, residual, num_samples);
    const double correlation = series_correlation(residual, measured);
    free(residual);
    return correlation;
}

/// What the record has beyond the model, about its mean, which is returned.
static double find_difference(const model_t* model, const record_t* record, double* model_output,
                              double* difference)
{
    const size_t num_samples = record->num_samples;
    reference_run(model, START_NEGATIVE_SATURATION, record->input, num_samples, model_output);
    for (size_t t = 0; t < num_samples; t++) {
        difference[t] = record->output[t] - model_output[t];
    }
    double mean = 0;
    double measured = 0;
    for (size_t t = 0; t < num_samples; t++) {
        mean += record_is_carried(record, t) ? 0 : difference[t];
        measured += record_is_carried(record, t) ? 0 : 1;
    }
    mean /= measured;
    for (size_t t = 0; t < num_samples; t++) {
        difference[t] -= mean;
    }
    return mean;
}

everett_t everett_fit(const model_t* model, const record_t* record, double largest, double* precision,
                      double* left)
{
    const size_t num_samples = record->num_samples;
    equations_t* fold = xcalloc(FOLDS + 2, sizeof *fold);
    equations_t* all = &fold[FOLDS];
    equations_t* independent = &fold[FOLDS + 1];
    double* penalty = xmalloc(SIZE * sizeof *penalty);
    double* model_output = xmalloc(2 * num_samples * sizeof *model_output);
    double* difference = model_output + num_samples;
    const double mean = find_difference(model, record, model_output, difference);
    set_penalty(penalty);
    set_equations(fold, model, record, model_output, difference);
    for (size_t k = 0; k < FOLDS; k++) {
        add_to(all, &fold[k], 1);
    }
    everett_t everett = everett_none(model);
    (void)solve(all, penalty, most_probable_strength(all, penalty), everett.value);
    // Coloured noise is not to be followed.
    add_to(independent, all, 1 / correlation_left(&everett, record, model_output, difference));
    const double strength = most_probable_strength(independent, penalty);
    (void)solve(independent, penalty, strength, everett.value);
    const double error = held_out_error(fold, all, penalty, strength);
    memcpy(precision, independent->gram, sizeof independent->gram);
    regularise(precision, penalty, strength, independent->count);
    for (size_t k = 0; k < EVERETT_FREE; k++) {
        precision[k * EVERETT_FREE + k] += error / (largest * largest);
    }
    everett.value[EVERETT_CONSTANT] += mean;
    free(model_output);
    free(penalty);
    free(fold);
    *left = sqrt(error);
    return everett;
}
