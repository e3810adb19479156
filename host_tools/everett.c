#include "everett.h"

#include "output_range.h"
#include <math.h>
#include <string.h>

enum { SPLINES = 4 }; ///< that are not 0 at a place

/// The cubic B-splines at a part of the range: first ... first + 3.
typedef struct {
    size_t first;
    double value[SPLINES];
} splines_t;

static splines_t splines_at(double part)
{
    const double place = part * EVERETT_CELLS;
    const size_t cell = place < EVERETT_CELLS - 1 ? (size_t)place : EVERETT_CELLS - 1;
    const double x = place - (double)cell;
    const double y = 1 - x;
    return (splines_t){
        cell, {y * y * y / 6, (4 + x * x * (3 * x - 6)) / 6, (4 + y * y * (3 * y - 6)) / 6, x * x * x / 6}};
}

size_t everett_node(size_t alpha, size_t beta)
{
    return alpha * (alpha - 1) / 2 + beta;
}

static everett_range_t range_of(const model_t* model)
{
    const double low = model_output_min(model);
    const double span = model_output_max(model) - low;
    return (everett_range_t){.input_min = model->input_min,
                             .input_max = model->input_max,
                             .output_middle = low + 0.5 * span,
                             .output_span = span > 0 ? span : 1};
}

/// The model's output as the share counts it.
static double counted(const everett_range_t* range, double model_output)
{
    return (model_output - range->output_middle) / range->output_span;
}

everett_t everett_none(const model_t* model)
{
    return (everett_t){.range = range_of(model)};
}

everett_past_t everett_start(const model_t* model)
{
    return (everett_past_t){.range = range_of(model), .count = 1};
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

static void take(everett_past_t* past, double input)
{
    const everett_range_t* range = &past->range;
    const double part = (input - range->input_min) / (range->input_max - range->input_min);
    move_to(past, fmin(fmax(part, 0), 1));
}

/// What a part of the path gives is E(to, from), rising or falling, since E(beta, alpha) = -E(alpha, beta).
static void add_part(double from, double to, double* row)
{
    const splines_t a = splines_at(to);
    const splines_t b = splines_at(from);
    for (size_t p = 0; p < SPLINES; p++) {
        for (size_t q = 0; q < SPLINES; q++) {
            const size_t i = a.first + p;
            const size_t k = b.first + q;
            const double product = a.value[p] * b.value[q];
            if (i > k) {
                row[everett_node(i, k)] += product;
            } else if (i < k) {
                row[everett_node(k, i)] -= product;
            }
        }
    }
}

void everett_step(everett_past_t* past, double input, double model_output, double* row)
{
    take(past, input);
    memset(row, 0, EVERETT_FREE * sizeof *row);
    row[EVERETT_CONSTANT] = 1;
    row[EVERETT_SHARE] = counted(&past->range, model_output);
    for (size_t k = 0; k < past->count; k++) {
        add_part(past->extreme[k], end_of(past, k), row);
    }
}

/// A run's present branch: E over the spline numbers of its end, its beginning being fixed.
typedef struct {
    double table[EVERETT_BASIS][EVERETT_BASIS]; ///< the coefficients, [end][beginning]
    double before[EVERETT_MOST_EXTREMES];       ///< what the parts up to it give
    double branch[EVERETT_MOST_EXTREMES][EVERETT_BASIS];
    size_t known; ///< parts whose beginning has not changed
} run_t;

static void run_start(const everett_t* everett, run_t* run)
{
    *run = (run_t){.before = {everett->value[EVERETT_CONSTANT]}};
    for (size_t i = 1; i < EVERETT_BASIS; i++) {
        for (size_t k = 0; k < i; k++) {
            run->table[i][k] = everett->value[everett_node(i, k)];
            run->table[k][i] = -run->table[i][k];
        }
    }
}

static double part_to(const double* branch, double to)
{
    const splines_t a = splines_at(to);
    double sum = 0;
    for (size_t p = 0; p < SPLINES; p++) {
        sum += a.value[p] * branch[a.first + p];
    }
    return sum;
}

static void begin_part(run_t* run, const everett_past_t* past, size_t k)
{
    const splines_t b = splines_at(past->extreme[k]);
    for (size_t i = 0; i < EVERETT_BASIS; i++) {
        run->branch[k][i] = 0;
        for (size_t q = 0; q < SPLINES; q++) {
            run->branch[k][i] += b.value[q] * run->table[i][b.first + q];
        }
    }
    if (k > 0) {
        run->before[k] = run->before[k - 1] + part_to(run->branch[k - 1], past->extreme[k]);
    }
}

void everett_add(const everett_t* everett, const double* turn, size_t num_turns, const double* input,
                 const double* model_output, size_t num_samples, double* output)
{
    everett_past_t past = {.range = everett->range, .count = 1};
    const double share = everett->value[EVERETT_SHARE];
    run_t run;
    run_start(everett, &run);
    for (size_t t = 0; t < num_turns + num_samples; t++) {
        take(&past, t < num_turns ? turn[t] : input[t - num_turns]);
        // Below the present count no extreme has changed since.
        run.known = run.known < past.count ? run.known : past.count;
        for (; run.known < past.count; run.known++) {
            begin_part(&run, &past, run.known);
        }
        if (t >= num_turns) {
            const size_t last = past.count - 1;
            output[t - num_turns] += run.before[last] + part_to(run.branch[last], past.present) +
                                     share * counted(&everett->range, model_output[t - num_turns]);
        }
    }
}
