#include "nuisance.h"

#include "model.h"
#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 512, MOST_DIRECTIONS = 40 };

/// What makes the series out of derivatives.
typedef struct {
    size_t num_numbers, num_samples;
    nuisance_rows_t* rows;
    void* context;
    double* chunk; ///< [CHUNK][num_numbers]
} source_t;

/// The sum of derivative derivative' over the record, upper triangle.
static void sum_up(const source_t* s, double* gram)
{
    const int m = (int)s->num_numbers;
    for (size_t begin = 0; begin < s->num_samples; begin += CHUNK) {
        const size_t end = begin + CHUNK < s->num_samples ? begin + CHUNK : s->num_samples;
        s->rows(s->context, begin, end, s->chunk);
        cblas_dsyrk(CblasColMajor, CblasUpper, CblasNoTrans, m, (int)(end - begin), 1, s->chunk, m, 1, gram,
                    m);
    }
}

static void mirror(double* matrix, size_t m)
{
    for (size_t c = 0; c < m; c++) {
        for (size_t r = c + 1; r < m; r++) {
            matrix[c * m + r] = matrix[r * m + c];
        }
    }
}

/// series = derivatives * direction [num_numbers][count].
static void fill(const source_t* s, const double* direction, nuisance_t* nuisance)
{
    const int m = (int)s->num_numbers;
    for (size_t begin = 0; begin < s->num_samples; begin += CHUNK) {
        const size_t end = begin + CHUNK < s->num_samples ? begin + CHUNK : s->num_samples;
        s->rows(s->context, begin, end, s->chunk);
        cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, (int)(end - begin), (int)nuisance->count, m, 1,
                    s->chunk, m, direction, m, 0, nuisance->series + begin, (int)s->num_samples);
    }
}

nuisance_t nuisance_new(double* precision, size_t num_numbers, size_t num_samples, double least,
                        nuisance_rows_t* rows, void* context)
{
    nuisance_t nuisance = {.num_samples = num_samples};
    const int m = (int)num_numbers;
    source_t source = {num_numbers, num_samples, rows, context,
                       xmalloc(CHUNK * num_numbers * sizeof(double))};
    double* gram = xcalloc(num_numbers * num_numbers, sizeof *gram);
    double* energy = xmalloc(num_numbers * sizeof *energy);
    if (LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'U', m, precision, m) == 0) {
        sum_up(&source, gram);
        mirror(gram, num_numbers);
        // With precision = R'R the numbers are inverse(R) times independent ones of variance 1.
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasUpper, CblasTrans, CblasNonUnit, m, m, 1, precision, m,
                    gram, m);
        cblas_dtrsm(CblasColMajor, CblasRight, CblasUpper, CblasNoTrans, CblasNonUnit, m, m, 1, precision, m,
                    gram, m);
        if (LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'U', m, gram, m, energy) == 0) {
            while (nuisance.count < num_numbers && nuisance.count < MOST_DIRECTIONS &&
                   energy[num_numbers - 1 - nuisance.count] > least) {
                nuisance.count++;
            }
        }
    }
    nuisance.series = xmalloc((nuisance.count * num_samples + 1) * sizeof(double));
    if (nuisance.count > 0) {
        double* direction = &gram[(num_numbers - nuisance.count) * num_numbers];
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, m, (int)nuisance.count,
                    1, precision, m, direction, m);
        fill(&source, direction, &nuisance);
    }
    free(source.chunk);
    free(gram);
    free(energy);
    return nuisance;
}

void nuisance_free(nuisance_t* nuisance)
{
    free(nuisance->series);
    *nuisance = (nuisance_t){0};
}

nuisance_filter_t nuisance_filter_new(const nuisance_t* nuisance, double variance, const bool* counts)
{
    const size_t k = nuisance->count;
    const size_t n = nuisance->num_samples;
    nuisance_filter_t filter = {nuisance, variance, xcalloc(k * k + 1, sizeof(double))};
    double* counted = xmalloc((n * k + 1) * sizeof *counted);
    for (size_t i = 0; i < n * k; i++) {
        counted[i] = counts[i % n] ? nuisance->series[i] : 0;
    }
    for (size_t i = 0; i < k; i++) {
        filter.factor[i * k + i] = variance;
    }
    if (k > 0) {
        cblas_dsyrk(CblasColMajor, CblasUpper, CblasTrans, (int)k, (int)n, 1, counted, (int)n, 1,
                    filter.factor, (int)k);
        // Positive definite: variance is.
        (void)LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'U', (int)k, filter.factor, (int)k);
    }
    free(counted);
    return filter;
}

void nuisance_filter_free(nuisance_filter_t* filter)
{
    free(filter->factor);
    *filter = (nuisance_filter_t){0};
}

void nuisance_filter_find(const nuisance_filter_t* filter, const double* residual, double* amount)
{
    const nuisance_t* nuisance = filter->nuisance;
    const int k = (int)nuisance->count;
    const int n = (int)nuisance->num_samples;
    if (k > 0) {
        cblas_dgemv(CblasColMajor, CblasTrans, n, k, 1, nuisance->series, n, residual, 1, 0, amount, 1);
        (void)LAPACKE_dpotrs(LAPACK_COL_MAJOR, 'U', k, 1, filter->factor, k, amount, k);
    }
}

void nuisance_take(const nuisance_t* nuisance, const double* amount, double* residual)
{
    const int n = (int)nuisance->num_samples;
    if (nuisance->count > 0) {
        cblas_dgemv(CblasColMajor, CblasNoTrans, n, (int)nuisance->count, -1, nuisance->series, n, amount, 1,
                    1, residual, 1);
    }
}
