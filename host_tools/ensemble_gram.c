#include "ensemble_gram.h"
#include "nnls.h"
#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// As many candidate radii at least, and as many plays' at most.
enum { LEAST_CANDIDATES = 240 };

/// A candidate whose variance the chosen ones explain up to this part is one of them already.
static const double dependent = 1e-10;

double centre(double* values, size_t count)
{
    double sum = 0.0;
    for (size_t t = 0; t < count; ++t) {
        sum += values[t];
    }
    for (size_t t = 0; t < count; ++t) {
        values[t] -= sum / (double)count;
    }
    return sum / (double)count;
}

static double candidate_radius(const play_set_t* plays, size_t sub, size_t i)
{
    const double radius = plays->radius[i / sub];
    if (i % sub == 0) {
        return radius;
    }
    return radius + (plays->radius[i / sub + 1] - radius) * (double)(i % sub) / (double)sub;
}

gram_t gram_new(const drive_t* drive, const play_set_t* plays, const double* output)
{
    gram_t gram = {.sub = (LEAST_CANDIDATES + plays->num_plays - 1) / plays->num_plays};
    gram.num_radii = gram.sub * (plays->num_plays - 1) + 1;
    const size_t n = gram.num_radii;
    const size_t samples = drive->num_samples;
    gram.radius = xcalloc(n, sizeof(double));
    gram.covariance = xcalloc(n * n, sizeof(double));
    gram.target = xcalloc(n, sizeof(double));
    double* state = xcalloc(n * samples, sizeof(double));
    for (size_t i = 0; i < n; ++i) {
        gram.radius[i] = candidate_radius(plays, gram.sub, i);
        drive_states(drive, gram.radius[i], &state[i * samples], NULL);
        centre(&state[i * samples], samples);
    }
    const double scale = 1.0 / (double)samples;
    cblas_dsyrk(CblasColMajor, CblasUpper, CblasTrans, (int)n, (int)samples, scale, state, (int)samples, 0.0,
                gram.covariance, (int)n);
    for (size_t column = 0; column < n; ++column) {
        for (size_t row = column + 1; row < n; ++row) {
            gram.covariance[column * n + row] = gram.covariance[row * n + column];
        }
    }
    cblas_dgemv(CblasColMajor, CblasTrans, (int)samples, (int)n, scale, state, (int)samples, output, 1, 0.0,
                gram.target, 1);
    gram.variance = scale * cblas_ddot((int)samples, output, 1, output, 1);
    free(state);
    return gram;
}

void gram_free(gram_t* gram)
{
    free(gram->radius);
    free(gram->covariance);
    free(gram->target);
    *gram = (gram_t){0};
}

/// The Cholesky factor of the chosen candidates' covariance, and their covariances with the output divided by
/// it.
typedef struct {
    size_t count;
    double* upper;  ///< [count * count] column-major U, U^T U = covariance
    double* target; ///< [count] U^-T target
} factor_t;

static void factor_free(factor_t* factor)
{
    free(factor->upper);
    *factor = (factor_t){0};
}

/// U^-T times the column.
static void divide(const factor_t* factor, double* column)
{
    if (factor->count > 0) {
        cblas_dtrsv(CblasColMajor, CblasUpper, CblasTrans, CblasNonUnit, (int)factor->count, factor->upper,
                    (int)factor->count, column, 1);
    }
}

/// Of the chosen candidates without the one at `left_out` (count: of all). A candidate that depends on those
/// before it gets an infinite pivot, which leaves it without weight.
static factor_t factor_new(const gram_t* gram, const size_t* chosen, size_t count, size_t left_out)
{
    factor_t factor = {.count = count - (left_out < count ? 1 : 0)};
    const size_t n = factor.count;
    factor.upper = xcalloc(n * n + n + 1, sizeof(double));
    factor.target = factor.upper + n * n;
    for (size_t column = 0; column < n; ++column) {
        const size_t c = chosen[column + (column >= left_out ? 1 : 0)];
        double* u = &factor.upper[column * n];
        for (size_t row = 0; row <= column; ++row) {
            u[row] = gram->covariance[c * gram->num_radii + chosen[row + (row >= left_out ? 1 : 0)]];
        }
        const double variance = u[column];
        if (column > 0) {
            cblas_dtrsv(CblasColMajor, CblasUpper, CblasTrans, CblasNonUnit, (int)column, factor.upper,
                        (int)n, u, 1);
        }
        const double pivot = variance - cblas_ddot((int)column, u, 1, u, 1);
        u[column] = pivot > dependent * variance ? sqrt(pivot) : (double)INFINITY;
        factor.target[column] = gram->target[c];
    }
    divide(&factor, factor.target);
    return factor;
}

/// || target - U x || over x >= 0; both are overwritten.
static double least_squares_residual(factor_t* factor)
{
    const size_t n = factor->count;
    for (size_t j = 0; j < n; ++j) {
        if (isinf(factor->upper[j * n + j])) {
            memset(&factor->upper[j * n], 0, n * sizeof(double));
        }
    }
    double* x = xcalloc(n, sizeof(double));
    bool* passive = xcalloc(n, sizeof(bool));
    nnls_info_t info;
    const outcome_t outcome = nnls_solve(factor->upper, n, n, factor->target, x, passive, &info);
    free(passive);
    free(x);
    return outcome == OUTCOME_OK ? info.residual_norm : (double)INFINITY;
}

/// Whether the best weights without bounds are >= 0.
static bool weights_stay_positive(const factor_t* factor)
{
    const size_t n = factor->count;
    double* weight = xcalloc(n, sizeof(double));
    memcpy(weight, factor->target, n * sizeof(double));
    cblas_dtrsv(CblasColMajor, CblasUpper, CblasNoTrans, CblasNonUnit, (int)n, factor->upper, (int)n, weight,
                1);
    bool positive = true;
    for (size_t j = 0; j < n; ++j) {
        positive = positive && weight[j] >= 0.0;
    }
    free(weight);
    return positive;
}

double gram_error(const gram_t* gram, const size_t* chosen, size_t count)
{
    factor_t factor = factor_new(gram, chosen, count, count);
    double explained = cblas_ddot((int)count, factor.target, 1, factor.target, 1);
    if (!weights_stay_positive(&factor)) {
        const double residual = least_squares_residual(&factor);
        explained -= residual * residual;
    }
    factor_free(&factor);
    return fmax(gram->variance - explained, 0.0);
}

/// What of the output's variance the candidate explains beyond the factor's ones, with a weight >= 0.
static double gain(const gram_t* gram, const factor_t* factor, const size_t* kept, size_t candidate,
                   double* column)
{
    const double* covariance = &gram->covariance[candidate * gram->num_radii];
    for (size_t j = 0; j < factor->count; ++j) {
        column[j] = covariance[kept[j]];
    }
    divide(factor, column);
    const int n = (int)factor->count;
    const double pivot = covariance[candidate] - cblas_ddot(n, column, 1, column, 1);
    const double rest = gram->target[candidate] - cblas_ddot(n, column, 1, factor->target, 1);
    return rest > 0.0 && pivot > dependent * covariance[candidate] ? rest * rest / pivot : 0.0;
}

size_t gram_exchange(const gram_t* gram, const size_t* chosen, size_t count, size_t k)
{
    factor_t factor = factor_new(gram, chosen, count, k);
    size_t* kept = xcalloc(count, sizeof(size_t));
    double* column = xcalloc(count, sizeof(double));
    memcpy(kept, chosen, k * sizeof(size_t));
    memcpy(kept + k, chosen + k + 1, (count - k - 1) * sizeof(size_t));
    size_t best = chosen[k];
    double most = gain(gram, &factor, kept, best, column);
    for (size_t candidate = 0; candidate < gram->num_radii; ++candidate) {
        const double explained = gain(gram, &factor, kept, candidate, column);
        if (explained > most) {
            most = explained;
            best = candidate;
        }
    }
    free(column);
    free(kept);
    factor_free(&factor);
    return best;
}
