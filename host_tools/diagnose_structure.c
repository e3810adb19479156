#include "diagnose_structure.h"

#include "reference.h"
#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LAGS = 7, STATES = 6, FEATURES = 2 * LAGS + STATES + 8, MAX_ROWS = 6000 };
static const size_t lag[LAGS] = {0, 1, 2, 4, 8, 16, 32};

/// The states of some plays over the record, from the smallest radius to the largest.
static void play_states(const gap_t* gap, double* states)
{
    const model_t* model = gap->model;
    const size_t n = gap->run->num_samples;
    reference_t reference = reference_new(model, gap->start, gap->run->input[0]);
    for (size_t t = 0; t < n; t++) {
        (void)reference_step(&reference, gap->run->input[t]);
        for (size_t k = 0; k < STATES; k++) {
            states[k * n + t] = reference.memory[k * (model->num_plays - 1) / (STATES - 1)];
        }
    }
    reference_free(&reference);
}

static double difference(const double* series, const double* time, size_t t)
{
    return t > 0 ? (series[t] - series[t - 1]) / (time[t] - time[t - 1]) : 0;
}

static void features_at(const gap_t* gap, const double* predicted, const double* states, size_t t,
                        double* feature)
{
    const effect_run_t* run = gap->run;
    const size_t n = run->num_samples;
    size_t k = 0;
    for (size_t i = 0; i < LAGS; i++) {
        const size_t s = t > lag[i] ? t - lag[i] : 0;
        feature[k++] = run->input[s];
        feature[k++] = predicted[s];
    }
    for (size_t i = 0; i < STATES; i++) {
        feature[k++] = states[i * n + t];
    }
    const double u = (run->input[t] - run->input[0]) / run->input_span;
    const double rate = difference(run->input, run->time, t);
    const double part = (double)t / (double)n - 0.5;
    feature[k++] = u * u;
    feature[k++] = u * u * u;
    feature[k++] = rate;
    feature[k++] = fabs(rate);
    feature[k++] = rate > 0 ? 1 : rate < 0 ? -1 : 0;
    feature[k++] = part;
    feature[k++] = part * part;
    feature[k++] = part * part * part;
}

/// Columns to mean 0 and standard deviation 1; constant ones to 0.
static void standardise(double* matrix, size_t rows)
{
    for (size_t c = 0; c < FEATURES; c++) {
        double* column = &matrix[c * rows];
        double mean = 0;
        double square = 0;
        for (size_t r = 0; r < rows; r++) {
            mean += column[r] / (double)rows;
        }
        for (size_t r = 0; r < rows; r++) {
            square += (column[r] - mean) * (column[r] - mean) / (double)rows;
        }
        const double scale = square > 0 ? 1 / sqrt(square) : 0;
        for (size_t r = 0; r < rows; r++) {
            column[r] = scale * (column[r] - mean);
        }
    }
}

/// Ridge regression on the rows not in `fold`; returns the squared error on those in it, 0-predicted mean
/// included.
static double fold_error(const double* matrix, const double* target, const size_t* fold_of, size_t rows,
                         size_t fold)
{
    double gram[FEATURES * FEATURES] = {0};
    double right[FEATURES] = {0};
    double mean = 0;
    double count = 0;
    for (size_t r = 0; r < rows; r++) {
        mean += fold_of[r] != fold ? target[r] : 0;
        count += fold_of[r] != fold;
    }
    mean /= count;
    for (size_t r = 0; r < rows; r++) {
        if (fold_of[r] != fold) {
            cblas_dsyr(CblasColMajor, CblasUpper, FEATURES, 1, &matrix[r], (int)rows, gram, FEATURES);
            cblas_daxpy(FEATURES, target[r] - mean, &matrix[r], (int)rows, right, 1);
        }
    }
    for (size_t c = 0; c < FEATURES; c++) {
        gram[c * FEATURES + c] += 1e-3 * count;
    }
    if (LAPACKE_dposv(LAPACK_COL_MAJOR, 'U', FEATURES, 1, gram, FEATURES, right, FEATURES) != 0) {
        return HUGE_VAL;
    }
    double error = 0;
    for (size_t r = 0; r < rows; r++) {
        if (fold_of[r] == fold) {
            const double e = target[r] - mean - cblas_ddot(FEATURES, &matrix[r], (int)rows, right, 1);
            error += e * e;
        }
    }
    return error;
}

double structure_found(const gap_t* gap, const double* predicted, const double* residual)
{
    const size_t n = gap->run->num_samples;
    const size_t stride = gap->num_judged / MAX_ROWS + 1;
    const size_t rows = (gap->num_judged + stride - 1) / stride;
    double* states = xmalloc(STATES * n * sizeof *states);
    double* matrix = xmalloc(rows * FEATURES * sizeof *matrix);
    double* target = xmalloc(rows * sizeof *target);
    size_t* fold_of = xmalloc(rows * sizeof *fold_of);
    play_states(gap, states);
    double energy = 0;
    size_t judged = 0;
    for (size_t t = 0; t < n; t++) {
        if (!gap_is_judged(gap, t) || judged++ % stride != 0) {
            continue;
        }
        const size_t r = (judged - 1) / stride;
        double feature[FEATURES];
        features_at(gap, predicted, states, t, feature);
        for (size_t c = 0; c < FEATURES; c++) {
            matrix[c * rows + r] = feature[c];
        }
        target[r] = residual[t];
        fold_of[r] = gap_block_of(gap, t) % HYPOTHESIS_FOLDS;
        energy += target[r] * target[r];
    }
    standardise(matrix, rows);
    double left = 0;
    for (size_t fold = 0; fold < HYPOTHESIS_FOLDS; fold++) {
        left += fold_error(matrix, target, fold_of, rows, fold);
    }
    free(states);
    free(matrix);
    free(target);
    free(fold_of);
    return energy > 0 && isfinite(left) ? fmax(0, 1 - left / energy) : 0;
}

static int by_value(const void* a, const void* b)
{
    const double x = *(const double*)a;
    const double y = *(const double*)b;
    return (x > y) - (x < y);
}

double white_noise(const double* signal, size_t num_samples)
{
    if (num_samples < 5) {
        return 0;
    }
    const size_t n = num_samples - 2;
    double* magnitude = xmalloc(n * sizeof *magnitude);
    for (size_t t = 0; t < n; t++) {
        magnitude[t] = fabs(signal[t] - 2 * signal[t + 1] + signal[t + 2]);
    }
    qsort(magnitude, n, sizeof *magnitude, by_value);
    const double median = magnitude[n / 2];
    free(magnitude);
    // The median of |N(0, s)| is 0.6745 s; second differences of white noise have 6 times its variance.
    return median / 0.6745 / sqrt(6);
}
