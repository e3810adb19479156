#include "ensemble_polish.h"
#include "ensemble_gram.h"
#include "nnls.h"
#include <cblas.h>
#include <cminpack.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Of the residual: each costs of the order of num_samples * num_plays^2, so that many plays get fewer.
static int most_evaluations(int num_plays)
{
    return 10 + 2000 / (num_plays * num_plays);
}

typedef struct {
    const drive_t* drive;
    const double* output;
    double low, high;
    ensemble_plays_t* plays;
    double* state;  ///< [num_samples * num_plays] centred
    double* slope;  ///< [num_samples * num_plays] derivatives of `state` in the radii
    double* matrix; ///< [num_samples * num_plays] what factorisations overwrite
    double* right;  ///< [num_samples] likewise
    double* mean;   ///< [num_plays] what centring took off `state`
    bool* passive;  ///< [num_plays] the plays with weight
    outcome_t outcome;
} polish_t;

ensemble_plays_t ensemble_plays_new(size_t num_plays)
{
    return (ensemble_plays_t){.num_plays = num_plays,
                              .radius = xcalloc(num_plays, sizeof(double)),
                              .weight = xcalloc(num_plays, sizeof(double))};
}

void ensemble_plays_free(ensemble_plays_t* plays)
{
    free(plays->radius);
    free(plays->weight);
    *plays = (ensemble_plays_t){0};
}

static size_t matrix_size(const polish_t* polish)
{
    return polish->drive->num_samples * polish->plays->num_plays * sizeof(double);
}

static polish_t polish_new(const drive_t* drive, const double* output, double low, double high,
                           ensemble_plays_t* plays)
{
    polish_t polish = {.drive = drive, .output = output, .low = low, .high = high, .plays = plays};
    polish.state = xmalloc(matrix_size(&polish));
    polish.slope = xmalloc(matrix_size(&polish));
    polish.matrix = xmalloc(matrix_size(&polish));
    polish.right = xcalloc(drive->num_samples, sizeof(double));
    polish.mean = xcalloc(plays->num_plays, sizeof(double));
    polish.passive = xcalloc(plays->num_plays, sizeof(bool));
    return polish;
}

static void polish_free(polish_t* polish)
{
    free(polish->state);
    free(polish->slope);
    free(polish->matrix);
    free(polish->right);
    free(polish->mean);
    free(polish->passive);
    *polish = (polish_t){0};
}

/// States and slopes at these radii; beyond the limits a radius changes nothing any more.
static void simulate(polish_t* polish, const double* radius)
{
    const size_t samples = polish->drive->num_samples;
    for (size_t k = 0; k < polish->plays->num_plays; ++k) {
        const double inside = fmin(fmax(radius[k], polish->low), polish->high);
        double* slope = &polish->slope[k * samples];
        drive_states(polish->drive, inside, &polish->state[k * samples], slope);
        polish->mean[k] = centre(&polish->state[k * samples], samples);
        centre(slope, samples);
        if (radius[k] < polish->low || radius[k] > polish->high) {
            memset(slope, 0, samples * sizeof *slope);
        }
    }
}

/// The best weights at these radii, and what they leave of the output.
static void fit_weights(polish_t* polish, const double* radius, double* residual)
{
    const size_t samples = polish->drive->num_samples;
    const size_t count = polish->plays->num_plays;
    nnls_info_t info;
    simulate(polish, radius);
    memcpy(polish->matrix, polish->state, matrix_size(polish));
    memcpy(polish->right, polish->output, samples * sizeof(double));
    polish->outcome = nnls_solve(polish->matrix, samples, count, polish->right, polish->plays->weight,
                                 polish->passive, &info);
    memcpy(residual, polish->output, samples * sizeof(double));
    cblas_dgemv(CblasColMajor, CblasNoTrans, (int)samples, (int)count, -1.0, polish->state, (int)samples,
                polish->plays->weight, 1, 1.0, residual, 1);
}

/// Takes off the columns of `jacobian` what the plays with weight can make up for.
static void project(polish_t* polish, double* jacobian)
{
    const lapack_int rows = (lapack_int)polish->drive->num_samples;
    const lapack_int columns = (lapack_int)polish->plays->num_plays;
    lapack_int basis = 0;
    double* tau = xcalloc(polish->plays->num_plays, sizeof *tau);
    for (size_t k = 0; k < polish->plays->num_plays; ++k) {
        if (polish->passive[k]) {
            memcpy(&polish->matrix[(size_t)basis * (size_t)rows], &polish->state[k * (size_t)rows],
                   (size_t)rows * sizeof(double));
            ++basis;
        }
    }
    lapack_int failed = LAPACKE_dgeqrf(LAPACK_COL_MAJOR, rows, basis, polish->matrix, rows, tau);
    if (failed == 0) {
        failed = LAPACKE_dormqr(LAPACK_COL_MAJOR, 'L', 'T', rows, columns, basis, polish->matrix, rows, tau,
                                jacobian, rows);
    }
    for (lapack_int k = 0; k < columns; ++k) {
        memset(&jacobian[k * rows], 0, (size_t)basis * sizeof(double));
    }
    if (failed == 0) {
        failed = LAPACKE_dormqr(LAPACK_COL_MAJOR, 'L', 'N', rows, columns, basis, polish->matrix, rows, tau,
                                jacobian, rows);
    }
    polish->outcome = failed == 0 ? polish->outcome : OUTCOME_NUMERICAL;
    free(tau);
}

/// MINPACK asks for the residual (flag 1) or for its derivatives at the radii it asked for last (flag 2).
static int evaluate(void* data, int rows, int columns, const double* radius, double* residual,
                    double* jacobian, int leading, int flag)
{
    polish_t* polish = data;
    (void)leading;
    if (flag == 1) {
        polish->plays->evaluations += 1;
        fit_weights(polish, radius, residual);
        return polish->outcome == OUTCOME_OK ? 0 : -1;
    }
    double* right = xcalloc((size_t)rows, sizeof *right);
    fit_weights(polish, radius, right); // after a step that was refused the states are that step's
    free(right);
    for (int k = 0; k < columns; ++k) {
        for (int t = 0; t < rows; ++t) {
            jacobian[k * rows + t] = -polish->plays->weight[k] * polish->slope[k * rows + t];
        }
    }
    project(polish, jacobian);
    return polish->outcome == OUTCOME_OK ? 0 : -1;
}

static void search(polish_t* polish, double* radius, double* residual)
{
    const int rows = (int)polish->drive->num_samples;
    const int n = (int)polish->plays->num_plays;
    double* jacobian = xmalloc(matrix_size(polish));
    double* vectors = xcalloc(5 * (size_t)n + (size_t)rows, sizeof *vectors);
    int* pivot = xcalloc((size_t)n, sizeof *pivot);
    int evaluations;
    int jacobians;
    lmder(evaluate, polish, rows, n, radius, residual, jacobian, rows, 1e-8, 1e-6, 0.0, most_evaluations(n),
          vectors, 1, 1.0, 0, &evaluations, &jacobians, pivot, vectors + n, vectors + 2 * n, vectors + 3 * n,
          vectors + 4 * n, vectors + 5 * n);
    free(pivot);
    free(vectors);
    free(jacobian);
}

static void sort(ensemble_plays_t* plays)
{
    for (size_t k = 1; k < plays->num_plays; ++k) {
        const double radius = plays->radius[k];
        const double weight = plays->weight[k];
        size_t place = k;
        for (; place > 0 && plays->radius[place - 1] > radius; --place) {
            plays->radius[place] = plays->radius[place - 1];
            plays->weight[place] = plays->weight[place - 1];
        }
        plays->radius[place] = radius;
        plays->weight[place] = weight;
    }
}

outcome_t ensemble_polish(const drive_t* drive, const double* output, double mean, double low, double high,
                          ensemble_plays_t* plays)
{
    const size_t samples = drive->num_samples;
    polish_t polish = polish_new(drive, output, low, high, plays);
    double* residual = xcalloc(samples, sizeof *residual);
    search(&polish, plays->radius, residual);
    for (size_t k = 0; k < plays->num_plays; ++k) {
        plays->radius[k] = fmin(fmax(plays->radius[k], low), high);
    }
    fit_weights(&polish, plays->radius, residual);
    // States count from negative saturation, so that nothing else is left of the output there.
    plays->constant = cblas_ddot((int)plays->num_plays, plays->weight, 1, polish.mean, 1) - mean;
    plays->rms = cblas_dnrm2((int)samples, residual, 1) / sqrt((double)samples);
    sort(plays);
    const outcome_t outcome = polish.outcome;
    free(residual);
    polish_free(&polish);
    return outcome;
}
