#include "identify_fit.h"

#include "nnls.h"
#include <cblas.h>
#include <cminpack.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Ridge on each column, relative to its norm: decides between plays that the record cannot tell apart, and
/// moves the solution of a determined problem by its square only.
static const double ridge = 1e-6;

/// Everything a fit needs at one theta, allocated once per search.
typedef struct {
    fit_t* fit;
    const fit_samples_t* samples;
    double* raw;
    double* ascending; ///< [num_samples] envelope values
    double* descending;
    place_t* place; ///< [num_samples]
    size_t rows;    ///< used samples
    size_t columns; ///< plays and non-hysteretic coefficients
    double* matrix; ///< [rows * columns] centred columns
    double* mean;   ///< [columns]
    double* target; ///< [rows] centred output
    double target_mean;
    double* scratch;  ///< [(rows + rows_below) * (columns + 1)] destroyed by the least squares
    double* solution; ///< [columns]
    double excited; ///< half of what the samples sweep of the envelopes: beyond it no radius is tried by them
    outcome_t outcome; ///< first failure of an evaluation
} work_t;

fit_t fit_new(const shape_t* shape, size_t num_plays)
{
    const size_t coefficients = shape_num_nonhysteretic(shape);
    fit_t fit = {.shape = shape, .num_plays = num_plays};
    fit.theta = xcalloc(shape->num_parameters + 1, sizeof *fit.theta);
    fit.radius = xcalloc(num_plays, sizeof *fit.radius);
    fit.weight = xcalloc(num_plays, sizeof *fit.weight);
    fit.coefficient = xcalloc(coefficients, sizeof *fit.coefficient);
    fit.passive = xcalloc(num_plays + coefficients, sizeof *fit.passive);
    fit.moved = xcalloc(num_plays, sizeof *fit.moved);
    fit.rmse = HUGE_VAL;
    return fit;
}

void fit_assign(fit_t* to, const fit_t* from)
{
    const size_t coefficients = shape_num_nonhysteretic(from->shape);
    memcpy(to->theta, from->theta, from->shape->num_parameters * sizeof *to->theta);
    memcpy(to->radius, from->radius, from->num_plays * sizeof *to->radius);
    memcpy(to->weight, from->weight, from->num_plays * sizeof *to->weight);
    memcpy(to->coefficient, from->coefficient, coefficients * sizeof *to->coefficient);
    memcpy(to->passive, from->passive, (from->num_plays + coefficients) * sizeof *to->passive);
    memcpy(to->moved, from->moved, from->num_plays * sizeof *to->moved);
    to->constant = from->constant;
    to->rmse = from->rmse;
    to->kkt = from->kkt;
}

void fit_free(fit_t* fit)
{
    free(fit->theta);
    free(fit->radius);
    free(fit->weight);
    free(fit->coefficient);
    free(fit->passive);
    free(fit->moved);
    *fit = (fit_t){0};
}

/// Rows below the data: a ridge for each column and a smoothness row for each play.
static size_t rows_below(const work_t* w)
{
    return w->columns + w->fit->num_plays;
}

static work_t work_new(fit_t* fit, const fit_samples_t* samples)
{
    work_t w = {.fit = fit, .samples = samples};
    const size_t n = samples->num_samples;
    w.columns = fit->num_plays + shape_num_nonhysteretic(fit->shape);
    for (size_t t = 0; t < n; t++) {
        w.rows += samples->used[t];
    }
    w.raw = xcalloc(fit->shape->num_raw + 1, sizeof *w.raw);
    w.ascending = xmalloc(n * sizeof *w.ascending);
    w.descending = xmalloc(n * sizeof *w.descending);
    w.place = xmalloc(n * sizeof *w.place);
    w.matrix = xmalloc(w.rows * w.columns * sizeof *w.matrix);
    w.mean = xmalloc(w.columns * sizeof *w.mean);
    w.target = xmalloc(w.rows * sizeof *w.target);
    w.scratch = xmalloc((w.rows + rows_below(&w)) * (w.columns + 1) * sizeof *w.scratch);
    w.solution = xcalloc(w.columns, sizeof *w.solution);
    size_t row = 0;
    for (size_t t = 0; t < n; t++) {
        w.place[t] = shape_place(fit->shape, samples->u[t]);
        if (samples->used[t]) {
            w.target[row++] = samples->y[t];
            w.target_mean += samples->y[t] / (double)w.rows;
        }
    }
    for (row = 0; row < w.rows; row++) {
        w.target[row] -= w.target_mean;
    }
    return w;
}

static void work_free(work_t* w)
{
    free(w->raw);
    free(w->ascending);
    free(w->descending);
    free(w->place);
    free(w->matrix);
    free(w->mean);
    free(w->target);
    free(w->scratch);
    free(w->solution);
}

static double envelope_at_end(const work_t* w, bool ascending, double u, tangent_t* tangent)
{
    const shape_t* shape = w->fit->shape;
    const place_t place = shape_place(shape, u);
    return ascending ? shape_ascending(shape, w->raw, u, place, tangent)
                     : shape_descending(shape, w->raw, u, place, tangent);
}

/// Radius of play j as a part of the way from the least radius (where the branches touch) to the largest that
/// moves. Equal envelopes make a play of radius 0 the same as D: then the grid starts one step above it.
static double radius_part(const fit_t* fit, size_t j)
{
    return fit->shape->envelope == CURVE_LINEAR ? (double)(j + 1) / (double)(fit->num_plays + 1)
                                                : (double)j / (double)fit->num_plays;
}

static void evaluate_curves(work_t* w, const double* theta)
{
    const shape_t* shape = w->fit->shape;
    shape_raw(shape, theta, w->raw);
    double crossing = 0;
    double highest = -HUGE_VAL;
    double lowest = HUGE_VAL;
    for (size_t t = 0; t < w->samples->num_samples; t++) {
        const double u = w->samples->u[t];
        w->ascending[t] = shape_ascending(shape, w->raw, u, w->place[t], NULL);
        w->descending[t] = shape_descending(shape, w->raw, u, w->place[t], NULL);
        crossing = fmax(crossing, w->ascending[t] - w->descending[t]);
        highest = fmax(highest, w->ascending[t]);
        lowest = fmin(lowest, w->descending[t]);
    }
    w->excited = 0.5 * (highest - lowest);
    for (size_t k = 0; k < shape->num_knots; k++) {
        crossing = fmax(crossing, envelope_at_end(w, true, shape->knot[k], NULL) -
                                      envelope_at_end(w, false, shape->knot[k], NULL));
    }
    const double least = crossing / 2;
    const double largest = 0.5 * (envelope_at_end(w, true, 1, NULL) - envelope_at_end(w, false, -1, NULL));
    for (size_t j = 0; j < w->fit->num_plays; j++) {
        w->fit->radius[j] = least + radius_part(w->fit, j) * fmax(largest - least, 0);
    }
}

/// The plays' states before the first sample, Eq. (6) from the chosen past.
static double start_state(const work_t* w, size_t j)
{
    const double r = w->fit->radius[j];
    const double low = w->ascending[0] - r;
    const double high = w->descending[0] + r;
    switch (w->samples->start) {
    case START_NEGATIVE_SATURATION:
        return fmax(envelope_at_end(w, false, -1, NULL) + r, low);
    case START_POSITIVE_SATURATION:
        return fmin(envelope_at_end(w, true, 1, NULL) - r, high);
    case START_DEMAGNETISED:
    case START_MODEL:
        break;
    }
    return 0.5 * (low + high) + 0.5 * w->samples->fraction[j] * (high - low);
}

/// Which sample each play's state stems from.
typedef struct {
    size_t sample;
    bool ascending;
    bool at_start; ///< not moved by any sample yet
} origin_t;

typedef struct {
    double* state;
    origin_t* origin;
} plays_t;

static plays_t plays_new(const work_t* w)
{
    plays_t plays = {xmalloc(w->fit->num_plays * sizeof *plays.state),
                     xmalloc(w->fit->num_plays * sizeof *plays.origin)};
    for (size_t j = 0; j < w->fit->num_plays; j++) {
        plays.state[j] = start_state(w, j);
        plays.origin[j] = (origin_t){0, w->samples->start != START_POSITIVE_SATURATION, true};
    }
    return plays;
}

static void plays_free(plays_t* plays)
{
    free(plays->state);
    free(plays->origin);
}

/// Moves the plays to sample t (t = 0: they are there).
static void plays_step(const work_t* w, plays_t* plays, size_t t)
{
    const double* u = w->samples->u;
    const fit_t* fit = w->fit;
    if (t == 0 || (u[t] <= u[t - 1] && u[t] >= u[t - 1])) {
        return;
    }
    const bool rising = u[t] > u[t - 1];
    for (size_t j = 0; j < fit->num_plays; j++) {
        const double pushed = rising ? w->ascending[t] - fit->radius[j] : w->descending[t] + fit->radius[j];
        if (rising ? pushed > plays->state[j] : pushed < plays->state[j]) {
            plays->state[j] = pushed;
            plays->origin[j] = (origin_t){t, rising, false};
        }
    }
}

static double nonhysteretic_column(const work_t* w, size_t k, size_t t)
{
    return shape_nonhysteretic(w->fit->shape, w->raw, k, w->samples->u[t], w->place[t], NULL);
}

static void centre_columns(work_t* w)
{
    for (size_t c = 0; c < w->columns; c++) {
        double* column = &w->matrix[c * w->rows];
        double mean = 0;
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        for (size_t row = 0; row < w->rows; row++) {
            mean += column[row] / (double)w->rows;
            low = fmin(low, column[row]);
            high = fmax(high, column[row]);
        }
        // A play that no used sample sees move is a constant, not a column of rounding errors; one beyond
        // what the samples sweep moves, if at all, by what was assumed of the past.
        const bool tried = c >= w->fit->num_plays || w->fit->radius[c] < w->excited;
        const bool moves = tried && high - low > 1e-9;
        for (size_t row = 0; row < w->rows; row++) {
            column[row] = moves ? column[row] - mean : 0;
        }
        w->mean[c] = mean;
        if (c < w->fit->num_plays) {
            w->fit->moved[c] = moves;
        }
    }
}

static void fill_matrix(work_t* w)
{
    plays_t plays = plays_new(w);
    size_t row = 0;
    for (size_t t = 0; t < w->samples->num_samples; t++) {
        plays_step(w, &plays, t);
        if (!w->samples->used[t]) {
            continue;
        }
        for (size_t j = 0; j < w->fit->num_plays; j++) {
            w->matrix[j * w->rows + row] = plays.state[j];
        }
        for (size_t k = w->fit->num_plays; k < w->columns; k++) {
            w->matrix[k * w->rows + row] = nonhysteretic_column(w, k - w->fit->num_plays, t);
        }
        row++;
    }
    plays_free(&plays);
    centre_columns(w);
}

/// Second differences of the weights over the radii that the samples move; beyond the largest of these the
/// weight is taken to stay as it is. A play of radius 0 is the envelope itself, with a weight of its own
/// kind.
static void add_smoothness(work_t* w, size_t height, double factor)
{
    const size_t first = w->fit->shape->envelope == CURVE_LINEAR ? 1 : 2;
    for (size_t j = first; j < w->fit->num_plays && w->fit->moved[j]; j++) {
        const bool last = j + 1 == w->fit->num_plays || !w->fit->moved[j + 1];
        double* row = &w->scratch[w->rows + w->columns + j];
        row[(j - 1) * height] = factor;
        row[j * height] = last ? -factor : -2 * factor;
        if (!last) {
            row[(j + 1) * height] = factor;
        }
    }
}

/// Copies the centred system with the rows below it into the scratch, then the target; returns the target.
static double* regularised_system(work_t* w)
{
    const size_t height = w->rows + rows_below(w);
    memset(w->scratch, 0, height * (w->columns + 1) * sizeof *w->scratch);
    double largest = 0;
    for (size_t c = 0; c < w->columns; c++) {
        const double* column = &w->matrix[c * w->rows];
        memcpy(&w->scratch[c * height], column, w->rows * sizeof *column);
        const double norm = cblas_dnrm2((int)w->rows, column, 1);
        w->scratch[c * height + w->rows + c] = ridge * norm;
        largest = c < w->fit->num_plays ? fmax(largest, norm) : largest;
    }
    add_smoothness(w, height, w->samples->smoothness * largest);
    double* target = &w->scratch[w->columns * height];
    memcpy(target, w->target, w->rows * sizeof *target);
    return target;
}

/// Solves for the weights at theta and stores everything but theta in the fit.
static outcome_t evaluate(work_t* w, const double* theta)
{
    fit_t* fit = w->fit;
    evaluate_curves(w, theta);
    fill_matrix(w);
    nnls_info_t info;
    double* target = regularised_system(w);
    const outcome_t outcome =
        nnls_solve(w->scratch, w->rows + rows_below(w), w->columns, target, w->solution, fit->passive, &info);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    memcpy(fit->weight, w->solution, fit->num_plays * sizeof *fit->weight);
    memcpy(fit->coefficient, w->solution + fit->num_plays,
           (w->columns - fit->num_plays) * sizeof *fit->coefficient);
    fit->constant = w->target_mean;
    for (size_t c = 0; c < w->columns; c++) {
        fit->constant -= w->solution[c] * w->mean[c];
    }
    fit->kkt = info.kkt;
    return OUTCOME_OK;
}

/// residual = A x - b over the used rows.
static void residual_of(const work_t* w, double* residual)
{
    memcpy(residual, w->target, w->rows * sizeof *residual);
    cblas_dgemv(CblasColMajor, CblasNoTrans, (int)w->rows, (int)w->columns, 1, w->matrix, (int)w->rows,
                w->solution, 1, -1, residual, 1);
}

/// Adds factor * (d value / d raw) to row `row` of the raw derivative.
static void add_tangent(double* derivative, size_t rows, size_t row, double factor, const tangent_t* tangent)
{
    for (size_t i = 0; i < 2; i++) {
        derivative[row + rows * tangent->index[i]] += factor * tangent->value[i];
    }
}

/// d state / d raw of one play, times its weight: the envelope's tangent where the state stems from, and the
/// radius's through the largest moving radius. A start inside the strip counts as fixed.
static void add_play(const work_t* w, const plays_t* plays, size_t j, size_t row, const tangent_t ends[2],
                     double* derivative)
{
    const shape_t* shape = w->fit->shape;
    const origin_t from = plays->origin[j];
    const double weight = w->fit->weight[j];
    if (from.at_start && w->samples->start == START_MODEL) {
        return;
    }
    tangent_t tangent;
    double sign = from.ascending ? -1 : 1;
    if (from.at_start) {
        tangent = from.ascending ? ends[1] : ends[0];
        sign = -sign;
    } else if (from.ascending) {
        shape_ascending(shape, w->raw, w->samples->u[from.sample], w->place[from.sample], &tangent);
    } else {
        shape_descending(shape, w->raw, w->samples->u[from.sample], w->place[from.sample], &tangent);
    }
    add_tangent(derivative, w->rows, row, weight, &tangent);
    const double part = 0.5 * sign * weight * radius_part(w->fit, j);
    add_tangent(derivative, w->rows, row, part, &ends[0]);
    add_tangent(derivative, w->rows, row, -part, &ends[1]);
}

/// d (A x) / d raw at fixed x: derivative[rows * num_raw], column-major.
static void raw_derivative(const work_t* w, double* derivative)
{
    const fit_t* fit = w->fit;
    tangent_t ends[2];
    envelope_at_end(w, true, 1, &ends[0]);
    envelope_at_end(w, false, -1, &ends[1]);
    memset(derivative, 0, w->rows * fit->shape->num_raw * sizeof *derivative);
    plays_t plays = plays_new(w);
    size_t row = 0;
    for (size_t t = 0; t < w->samples->num_samples; t++) {
        plays_step(w, &plays, t);
        if (!w->samples->used[t]) {
            continue;
        }
        for (size_t j = 0; j < fit->num_plays && fit->shape->envelope != CURVE_LINEAR; j++) {
            if (fit->weight[j] > 0) {
                add_play(w, &plays, j, row, ends, derivative);
            }
        }
        for (size_t k = 0; k < w->columns - fit->num_plays && fit->shape->nonhysteretic == CURVE_TANH; k++) {
            tangent_t tangent;
            shape_nonhysteretic(fit->shape, w->raw, k, w->samples->u[t], w->place[t], &tangent);
            add_tangent(derivative, w->rows, row, fit->coefficient[k], &tangent);
        }
        row++;
    }
    plays_free(&plays);
}

/// Removes from each of the `count` columns what the constant and the passive columns can follow (Kaufman).
static void project_out(work_t* w, double* columns, size_t count)
{
    const size_t rows = w->rows;
    for (size_t c = 0; c < count; c++) {
        double mean = 0;
        for (size_t row = 0; row < rows; row++) {
            mean += columns[c * rows + row] / (double)rows;
        }
        for (size_t row = 0; row < rows; row++) {
            columns[c * rows + row] -= mean;
        }
    }
    size_t passive = 0;
    for (size_t c = 0; c < w->columns; c++) {
        if (w->fit->passive[c]) {
            memcpy(&w->scratch[passive * rows], &w->matrix[c * rows], rows * sizeof *w->matrix);
            passive++;
        }
    }
    if (passive == 0 || passive > rows) {
        return;
    }
    double* tau = xmalloc(passive * sizeof *tau);
    if (LAPACKE_dgeqrf(LAPACK_COL_MAJOR, (lapack_int)rows, (lapack_int)passive, w->scratch, (lapack_int)rows,
                       tau) == 0 &&
        LAPACKE_dormqr(LAPACK_COL_MAJOR, 'L', 'T', (lapack_int)rows, (lapack_int)count, (lapack_int)passive,
                       w->scratch, (lapack_int)rows, tau, columns, (lapack_int)rows) == 0) {
        for (size_t c = 0; c < count; c++) {
            memset(&columns[c * rows], 0, passive * sizeof *columns);
        }
        LAPACKE_dormqr(LAPACK_COL_MAJOR, 'L', 'N', (lapack_int)rows, (lapack_int)count, (lapack_int)passive,
                       w->scratch, (lapack_int)rows, tau, columns, (lapack_int)rows);
    }
    free(tau);
}

static void jacobian_of(work_t* w, const double* theta, double* jacobian)
{
    const shape_t* shape = w->fit->shape;
    double* derivative = xmalloc(w->rows * shape->num_raw * sizeof *derivative);
    double* chain = xmalloc(shape->num_raw * shape->num_parameters * sizeof *chain);
    raw_derivative(w, derivative);
    shape_raw_jacobian(shape, theta, chain);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, (int)w->rows, (int)shape->num_parameters,
                (int)shape->num_raw, 1, derivative, (int)w->rows, chain, (int)shape->num_raw, 0, jacobian,
                (int)w->rows);
    project_out(w, jacobian, shape->num_parameters);
    free(derivative);
    free(chain);
}

/// MINPACK's callback: residuals (task 1) or Jacobian (task 2) at theta. A negative return stops the search.
static int minpack_evaluate(void* context, int m, int n, const double* theta, double* residual,
                            double* jacobian, int leading, int task)
{
    (void)m;
    (void)n;
    (void)leading;
    work_t* w = context;
    w->outcome = evaluate(w, theta);
    if (w->outcome != OUTCOME_OK) {
        return -1;
    }
    if (task == 1) {
        residual_of(w, residual);
    } else {
        jacobian_of(w, theta, jacobian);
    }
    return 0;
}

static outcome_t evaluate_rmse(work_t* w)
{
    const outcome_t outcome = evaluate(w, w->fit->theta);
    if (outcome == OUTCOME_OK) {
        double* residual = xmalloc(w->rows * sizeof *residual);
        residual_of(w, residual);
        w->fit->rmse = cblas_dnrm2((int)w->rows, residual, 1) / sqrt((double)w->rows);
        free(residual);
    }
    return outcome;
}

outcome_t fit_weights(fit_t* fit, const fit_samples_t* samples)
{
    work_t w = work_new(fit, samples);
    const outcome_t outcome = evaluate_rmse(&w);
    work_free(&w);
    return outcome;
}

static outcome_t search_with_minpack(work_t* w, int max_evaluations)
{
    const int m = (int)w->rows;
    const int n = (int)w->fit->shape->num_parameters;
    const size_t parameters = w->fit->shape->num_parameters;
    double* vectors = xcalloc(2 * w->rows + w->rows * parameters + 6 * parameters, sizeof *vectors);
    int* pivot = xcalloc(parameters, sizeof *pivot);
    double* residual = vectors;
    double* work = residual + w->rows;
    double* jacobian = work + w->rows;
    double* v = jacobian + w->rows * parameters;
    int evaluations = 0;
    int jacobians = 0;
    lmder(minpack_evaluate, w, m, n, w->fit->theta, residual, jacobian, m, 1e-7, 1e-7, 0, max_evaluations, v,
          1, 10, 0, &evaluations, &jacobians, pivot, v + n, v + 2 * n, v + 3 * n, v + 4 * n, work);
    free(pivot);
    free(vectors);
    return w->outcome;
}

outcome_t fit_search(fit_t* fit, const fit_samples_t* samples, int max_evaluations)
{
    work_t w = work_new(fit, samples);
    outcome_t outcome = OUTCOME_OK;
    if (fit->shape->num_parameters > 0 && w.rows > fit->shape->num_parameters) {
        outcome = search_with_minpack(&w, max_evaluations);
    }
    if (outcome == OUTCOME_OK) {
        outcome = evaluate_rmse(&w);
    }
    work_free(&w);
    return outcome;
}

void fit_output(const fit_t* fit, const fit_samples_t* samples, double* output)
{
    fit_t copy = *fit; // evaluate_curves writes the radii it already holds
    work_t w = work_new(&copy, samples);
    evaluate_curves(&w, fit->theta);
    plays_t plays = plays_new(&w);
    for (size_t t = 0; t < samples->num_samples; t++) {
        plays_step(&w, &plays, t);
        output[t] = fit->constant;
        for (size_t j = 0; j < fit->num_plays; j++) {
            output[t] += fit->weight[j] * plays.state[j];
        }
        for (size_t k = 0; k < w.columns - fit->num_plays; k++) {
            output[t] += fit->coefficient[k] * nonhysteretic_column(&w, k, t);
        }
    }
    plays_free(&plays);
    work_free(&w);
}
