#include "everett.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FOLDS = 4, BLOCKS = 24, STRENGTHS = 7, SIZE = EVERETT_FREE * EVERETT_FREE };

static size_t node_at(size_t alpha, size_t beta)
{
    return alpha * (alpha - 1) / 2 + beta;
}

/// E(alpha, beta), linear between nodes: the sum of part * the nodes' values.
typedef struct {
    size_t node[4];
    double part[4];
    size_t count; ///< on the diagonal E is 0
} everett_place_t;

static everett_place_t place_of(double from, double to)
{
    const double a = fmax(from, to) * EVERETT_CELLS;
    const double b = fmin(from, to) * EVERETT_CELLS;
    const size_t i = a < EVERETT_CELLS - 1 ? (size_t)a : EVERETT_CELLS - 1;
    const size_t k = b < EVERETT_CELLS - 1 ? (size_t)b : EVERETT_CELLS - 1;
    const double x = a - (double)i;
    const double y = b - (double)k;
    const double part[2][2] = {{(1 - x) * (1 - y), (1 - x) * y}, {x * (1 - y), x * y}};
    everett_place_t place = {.count = 0};
    for (size_t p = 0; p < 2; p++) {
        for (size_t q = 0; q < 2; q++) {
            if (i + p > k + q) {
                place.node[place.count] = node_at(i + p, k + q);
                place.part[place.count++] = part[p][q];
            }
        }
    }
    return place;
}

static everett_past_t start_over(double input_min, double input_max)
{
    return (everett_past_t){.input_min = input_min, .input_max = input_max, .count = 1};
}

everett_past_t everett_start(const model_t* model)
{
    return start_over(model->input_min, model->input_max);
}

/// Moves to u: smaller loops that it closes are wiped out.
static void move_to(everett_past_t* past, double u)
{
    const bool was_rising = past->count % 2 == 1;
    if (was_rising ? u < past->present : u > past->present) {
        if (past->count < EVERETT_MOST_EXTREMES) {
            past->extreme[past->count++] = past->present;
        } else {
            past->count -= 1; // the innermost loop is left out
        }
    }
    past->present = u;
    while (past->count >= 3 && (past->count % 2 == 1 ? u >= past->extreme[past->count - 2]
                                                     : u <= past->extreme[past->count - 2])) {
        past->count -= 2;
    }
}

/// The extreme after which the k-th part of the path ends.
static double end_of(const everett_past_t* past, size_t k)
{
    return k + 1 < past->count ? past->extreme[k + 1] : past->present;
}

static double sign_of(size_t k)
{
    return k % 2 == 0 ? 1 : -1;
}

static void take(everett_past_t* past, double input)
{
    const double part = (input - past->input_min) / (past->input_max - past->input_min);
    move_to(past, fmin(fmax(part, 0), 1));
}

void everett_step(everett_past_t* past, double input, double* row)
{
    take(past, input);
    memset(row, 0, EVERETT_FREE * sizeof *row);
    row[EVERETT_FREE - 1] = 1;
    for (size_t k = 0; k < past->count; k++) {
        const everett_place_t place = place_of(past->extreme[k], end_of(past, k));
        for (size_t i = 0; i < place.count; i++) {
            row[place.node[i]] += sign_of(k) * place.part[i];
        }
    }
}

/// What the k-th part of the path gives.
static double part_of(const everett_t* everett, const everett_past_t* past, size_t k)
{
    const everett_place_t place = place_of(past->extreme[k], end_of(past, k));
    double sum = 0;
    for (size_t i = 0; i < place.count; i++) {
        sum += place.part[i] * everett->value[place.node[i]];
    }
    return sign_of(k) * sum;
}

void everett_add(const everett_t* everett, const double* turn, size_t num_turns, const double* input,
                 size_t num_samples, double* output)
{
    everett_past_t past = start_over(everett->input_min, everett->input_max);
    double before[EVERETT_MOST_EXTREMES] = {everett->value[EVERETT_FREE - 1]}; // what the parts up to it give
    size_t known = 1;
    for (size_t t = 0; t < num_turns + num_samples; t++) {
        take(&past, t < num_turns ? turn[t] : input[t - num_turns]);
        // Below the present count no extreme has changed since.
        known = known < past.count ? known : past.count;
        for (; known < past.count; known++) {
            before[known] = before[known - 1] + part_of(everett, &past, known - 1);
        }
        if (t >= num_turns) {
            output[t - num_turns] += before[known - 1] + part_of(everett, &past, known - 1);
        }
    }
}

/// The normal equations of one fold's samples.
typedef struct {
    double gram[SIZE]; ///< upper triangle
    double right[EVERETT_FREE];
    double energy;
    double count;
} equations_t;

static void add_to(equations_t* sum, const equations_t* one)
{
    cblas_daxpy(SIZE, 1, one->gram, 1, sum->gram, 1);
    cblas_daxpy(EVERETT_FREE, 1, one->right, 1, sum->right, 1);
    sum->energy += one->energy;
    sum->count += one->count;
}

/// Adds weight * (second difference from (alpha, beta) on, towards alpha + da, beta + db)^2.
static void stiffen(double* gram, size_t alpha, size_t beta, size_t da, size_t db, double weight)
{
    static const double by[] = {1, -2, 1};
    for (size_t p = 0; p < 3; p++) {
        for (size_t q = 0; q < 3; q++) {
            const size_t a[] = {alpha + p * da, alpha + q * da};
            const size_t b[] = {beta + p * db, beta + q * db};
            if (a[0] > b[0] && a[1] > b[1]) {
                gram[node_at(a[0], b[0]) * EVERETT_FREE + node_at(a[1], b[1])] += weight * by[p] * by[q];
            }
        }
    }
}

/// gram + strength * (squares of second differences, and a little of the values' own).
static void regularise(double* gram, double strength)
{
    for (size_t alpha = 0; alpha <= EVERETT_CELLS; alpha++) {
        for (size_t beta = 0; beta <= alpha; beta++) {
            if (alpha + 2 <= EVERETT_CELLS) {
                stiffen(gram, alpha, beta, 1, 0, strength);
            }
            if (beta + 2 <= alpha) {
                stiffen(gram, alpha, beta, 0, 1, strength);
            }
        }
    }
    for (size_t k = 0; k < EVERETT_FREE; k++) {
        gram[k * EVERETT_FREE + k] += 0.01 * strength;
    }
}

static void solve(const equations_t* e, double strength, double* value)
{
    double* gram = xmalloc(sizeof e->gram);
    memcpy(gram, e->gram, sizeof e->gram);
    memcpy(value, e->right, EVERETT_FREE * sizeof *value);
    regularise(gram, strength);
    // Positive definite: every number is regularised.
    (void)LAPACKE_dposv(LAPACK_COL_MAJOR, 'U', EVERETT_FREE, 1, gram, EVERETT_FREE, value, EVERETT_FREE);
    free(gram);
}

/// Squared error of the values on the equations' samples.
static double error_on(const equations_t* e, const double* value)
{
    double product[EVERETT_FREE];
    cblas_dsymv(CblasColMajor, CblasUpper, EVERETT_FREE, 1, e->gram, EVERETT_FREE, value, 1, 0, product, 1);
    return e->energy - 2 * cblas_ddot(EVERETT_FREE, e->right, 1, value, 1) +
           cblas_ddot(EVERETT_FREE, product, 1, value, 1);
}

static double held_out_error(const equations_t* fold, double strength)
{
    double error = 0;
    double value[EVERETT_FREE];
    for (size_t k = 0; k < FOLDS; k++) {
        equations_t* rest = xcalloc(1, sizeof *rest);
        for (size_t other = 0; other < FOLDS; other++) {
            if (other != k) {
                add_to(rest, &fold[other]);
            }
        }
        solve(rest, strength, value);
        error += error_on(&fold[k], value);
        free(rest);
    }
    return fmax(error, 0);
}

double everett_fit(const model_t* model, const double* input, const double* difference, size_t num_samples,
                   double correlation, double largest, double* value, double* precision)
{
    equations_t* fold = xcalloc(FOLDS + 1, sizeof *fold);
    everett_past_t past = everett_start(model);
    for (size_t t = 0; t < num_samples; t++) {
        equations_t* e = &fold[t * BLOCKS / num_samples % FOLDS];
        double row[EVERETT_FREE];
        everett_step(&past, input[t], row);
        cblas_dsyr(CblasColMajor, CblasUpper, EVERETT_FREE, 1, row, 1, e->gram, EVERETT_FREE);
        cblas_daxpy(EVERETT_FREE, difference[t], row, 1, e->right, 1);
        e->energy += difference[t] * difference[t];
        e->count += 1;
    }
    equations_t* all = &fold[FOLDS];
    for (size_t k = 0; k < FOLDS; k++) {
        add_to(all, &fold[k]);
    }
    double least = HUGE_VAL;
    double strength = 0;
    for (size_t s = 0; s < STRENGTHS; s++) {
        const double tried = (double)num_samples * pow(10, 1 - (double)s);
        const double error = held_out_error(fold, tried);
        strength = error < least ? tried : strength;
        least = fmin(error, least);
    }
    solve(all, strength, value);
    memcpy(precision, all->gram, sizeof all->gram);
    cblas_dscal(SIZE, 1 / correlation, precision, 1);
    regularise(precision, strength);
    const double left = least / (double)num_samples;
    for (size_t k = 0; k < EVERETT_FREE; k++) {
        precision[k * EVERETT_FREE + k] += left / (largest * largest);
    }
    free(fold);
    return sqrt(left);
}
