#include "nnls.h"

#include "model.h"
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

/// The triangular system R x = c that remains after A = Q R: [n * n] column-major, and its column norms.
typedef struct {
    size_t n;
    double* r;
    double* c;
    double* norm;
    double* work_matrix; ///< [n * n] the passive columns, destroyed by each solve
    double* work_vector; ///< [n]
    double* gradient;    ///< [n] R^T (c - R x)
} triangular_t;

static double norm_of(const double* vector, size_t length)
{
    double sum = 0;
    for (size_t i = 0; i < length; i++) {
        sum += vector[i] * vector[i];
    }
    return sqrt(sum);
}

/// Reduces the tall system by Householder QR; *rest gets the norm of what no x can remove.
static outcome_t reduce(double* a, size_t rows, size_t columns, double* b, triangular_t* t, double* rest)
{
    const size_t n = columns;
    const size_t kept = rows < n ? rows : n;
    double* tau = xcalloc(kept, sizeof *tau);
    lapack_int failed =
        LAPACKE_dgeqrf(LAPACK_COL_MAJOR, (lapack_int)rows, (lapack_int)n, a, (lapack_int)rows, tau);
    if (failed == 0) {
        failed = LAPACKE_dormqr(LAPACK_COL_MAJOR, 'L', 'T', (lapack_int)rows, 1, (lapack_int)kept, a,
                                (lapack_int)rows, tau, b, (lapack_int)rows);
    }
    free(tau);
    if (failed != 0) {
        return OUTCOME_NUMERICAL;
    }
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < n; i++) {
            t->r[j * n + i] = i <= j && i < kept ? a[j * rows + i] : 0;
        }
        t->norm[j] = norm_of(&t->r[j * n], n);
    }
    for (size_t i = 0; i < n; i++) {
        t->c[i] = i < kept ? b[i] : 0;
    }
    *rest = norm_of(b + kept, rows - kept);
    return OUTCOME_OK;
}

/// Unbounded least squares over the passive columns; z gets the solution, 0 elsewhere.
static outcome_t solve_passive(triangular_t* t, const bool* passive, double* z)
{
    const size_t n = t->n;
    size_t count = 0;
    for (size_t j = 0; j < n; j++) {
        if (passive[j]) {
            memcpy(&t->work_matrix[count * n], &t->r[j * n], n * sizeof *t->r);
            count++;
        }
    }
    memset(z, 0, n * sizeof *z);
    if (count == 0) {
        return OUTCOME_OK;
    }
    memcpy(t->work_vector, t->c, n * sizeof *t->c);
    const lapack_int failed = LAPACKE_dgels(LAPACK_COL_MAJOR, 'N', (lapack_int)n, (lapack_int)count, 1,
                                            t->work_matrix, (lapack_int)n, t->work_vector, (lapack_int)n);
    if (failed != 0) {
        return OUTCOME_NUMERICAL;
    }
    size_t k = 0;
    for (size_t j = 0; j < n; j++) {
        if (passive[j]) {
            z[j] = t->work_vector[k++];
            if (!isfinite(z[j])) {
                return OUTCOME_NUMERICAL;
            }
        }
    }
    return OUTCOME_OK;
}

static void update_gradient(triangular_t* t, const double* x, double* residual)
{
    const size_t n = t->n;
    memcpy(residual, t->c, n * sizeof *residual);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; x[j] > 0 && i <= j; i++) {
            residual[i] -= t->r[j * n + i] * x[j];
        }
    }
    for (size_t j = 0; j < n; j++) {
        double sum = 0;
        for (size_t i = 0; i <= j; i++) {
            sum += t->r[j * n + i] * residual[i];
        }
        t->gradient[j] = sum;
    }
}

/// Moves x towards the passive set's solution z as far as x stays >= 0, dropping what reaches 0.
/// Returns whether z was reached.
static bool move_towards(size_t n, const double* z, bool* passive, double* x)
{
    double step = 1;
    for (size_t j = 0; j < n; j++) {
        if (passive[j] && z[j] <= 0) {
            const double to_zero = x[j] > 0 ? x[j] / (x[j] - z[j]) : 0;
            step = to_zero < step ? to_zero : step;
        }
    }
    bool reached = true;
    for (size_t j = 0; j < n; j++) {
        if (!passive[j]) {
            continue;
        }
        x[j] += step * (z[j] - x[j]);
        if (z[j] <= 0 && x[j] <= 1e-14 * fabs(z[j])) {
            x[j] = 0;
            passive[j] = false;
            reached = false;
        }
    }
    return reached && step >= 1;
}

/// Inner loop: x becomes the least-squares solution over a passive set on which it is positive.
static outcome_t settle(triangular_t* t, bool* passive, double* x, double* z)
{
    for (size_t round = 0; round <= t->n + 1; round++) {
        if (solve_passive(t, passive, z) != OUTCOME_OK) {
            return OUTCOME_NUMERICAL;
        }
        if (move_towards(t->n, z, passive, x)) {
            return OUTCOME_OK;
        }
    }
    return OUTCOME_NUMERICAL;
}

/// The bound column with the steepest descent, relative to its norm; n when none is left above the tolerance.
static size_t next_to_free(const triangular_t* t, const bool* passive, double scale, double* violation)
{
    const double tolerance = 1e-11;
    size_t best = t->n;
    *violation = 0;
    for (size_t j = 0; j < t->n; j++) {
        if (passive[j] || !(t->norm[j] > 0)) {
            continue;
        }
        const double relative = t->gradient[j] / (t->norm[j] * scale);
        if (relative > *violation) {
            *violation = relative;
            best = j;
        }
    }
    return *violation > tolerance ? best : t->n;
}

static outcome_t iterate(triangular_t* t, double scale, double* x, bool* passive, nnls_info_t* info)
{
    double* z = xcalloc(t->n, sizeof *z);
    double* residual = xcalloc(t->n, sizeof *residual);
    outcome_t outcome = OUTCOME_NUMERICAL;
    size_t refused = t->n;
    for (size_t round = 0; round < 10 * t->n + 10; round++) {
        if (settle(t, passive, x, z) != OUTCOME_OK) {
            break;
        }
        update_gradient(t, x, residual);
        info->residual_norm = norm_of(residual, t->n);
        const size_t entering = next_to_free(t, passive, scale, &info->kkt);
        info->iterations = round;
        if (entering == t->n || entering == refused) {
            outcome = OUTCOME_OK;
            break;
        }
        passive[entering] = true;
        // A column that its own solve throws out again at once entered by rounding alone: the set is optimal.
        refused = t->n;
        if (solve_passive(t, passive, z) == OUTCOME_OK && z[entering] <= 0) {
            passive[entering] = false;
            refused = entering;
        }
    }
    free(z);
    free(residual);
    return outcome;
}

outcome_t nnls_solve(double* a, size_t rows, size_t columns, double* b, double* x, bool* passive,
                     nnls_info_t* info)
{
    *info = (nnls_info_t){0};
    memset(x, 0, columns * sizeof *x);
    triangular_t t = {.n = columns};
    t.r = xcalloc(columns * columns + columns * columns + 4 * columns, sizeof *t.r);
    t.work_matrix = t.r + columns * columns;
    t.c = t.work_matrix + columns * columns;
    t.norm = t.c + columns;
    t.work_vector = t.norm + columns;
    t.gradient = t.work_vector + columns;

    double rest = 0;
    const double scale = norm_of(b, rows);
    outcome_t outcome = isfinite(scale) ? reduce(a, rows, columns, b, &t, &rest) : OUTCOME_NUMERICAL;
    if (outcome == OUTCOME_OK && scale > 0) {
        for (size_t j = 0; j < columns; j++) {
            passive[j] = passive[j] && t.norm[j] > 0;
        }
        // x = 0 with a non-empty passive set: the first settle keeps those of the former set that stay
        // positive.
        outcome = iterate(&t, scale, x, passive, info);
        if (outcome != OUTCOME_OK) {
            // A foreign set can hold dependent columns, which the method itself never frees together.
            memset(passive, 0, columns * sizeof *passive);
            memset(x, 0, columns * sizeof *x);
            outcome = iterate(&t, scale, x, passive, info);
        }
    } else {
        memset(passive, 0, columns * sizeof *passive);
    }
    info->residual_norm = hypot(info->residual_norm, rest);
    free(t.r);
    return outcome;
}
