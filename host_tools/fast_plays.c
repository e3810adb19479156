#include "fast_plays.h"

#include "reference.h"
#include <math.h>
#include <stdlib.h>

enum { CELLS = 8192 };

typedef struct {
    const curve_t* curve;
    double* value; ///< [CELLS + 1]
} table_t;

struct fast_plays {
    const model_t* model;
    double low, cells_per_unit;
    table_t ascending, descending, nonhysteretic;
    double* weight_sum;  ///< [num_plays + 1] of p
    double* moment_sum;  ///< [num_plays + 1] of p r
    double* start_state; ///< [num_plays] before the first input
    double* start_tail;  ///< [num_plays + 1] of p times the start's state, from each play on
    double start_input;
};

static table_t tabulate(const curve_t* curve, double low, double step)
{
    table_t table = {curve, xmalloc((CELLS + 1) * sizeof *table.value)};
    for (size_t i = 0; i <= CELLS; i++) {
        table.value[i] = curve_value(curve, low + step * (double)i);
    }
    return table;
}

static double look_up(const fast_plays_t* plays, const table_t* table, double v)
{
    const double at = (v - plays->low) * plays->cells_per_unit;
    if (!(at >= 0 && at < CELLS)) {
        return curve_value(table->curve, v);
    }
    const size_t cell = (size_t)at;
    return table->value[cell] + (at - (double)cell) * (table->value[cell + 1] - table->value[cell]);
}

fast_plays_t* fast_plays_new(const model_t* model, start_t start)
{
    fast_plays_t* plays = xcalloc(1, sizeof *plays);
    const size_t n = model->num_plays;
    const double span = model->input_max - model->input_min;
    plays->model = model;
    plays->low = model->input_min - 0.5 * span;
    plays->cells_per_unit = CELLS / (2 * span);
    plays->ascending = tabulate(&model->ascending, plays->low, 2 * span / CELLS);
    plays->descending = tabulate(&model->descending, plays->low, 2 * span / CELLS);
    plays->nonhysteretic = tabulate(&model->nonhysteretic, plays->low, 2 * span / CELLS);
    plays->weight_sum = xcalloc(n + 1, sizeof(double));
    plays->moment_sum = xcalloc(n + 1, sizeof(double));
    plays->start_state = xcalloc(n, sizeof(double));
    plays->start_tail = xcalloc(n + 1, sizeof(double));
    reference_t reference = reference_start(model, start);
    plays->start_input = reference.input;
    for (size_t j = 0; j < n; j++) {
        plays->start_state[j] = reference.memory[j];
        plays->weight_sum[j + 1] = plays->weight_sum[j] + model->weight[j];
        plays->moment_sum[j + 1] = plays->moment_sum[j] + model->weight[j] * model->radius[j];
    }
    for (size_t j = n; j-- > 0;) {
        plays->start_tail[j] = plays->start_tail[j + 1] + model->weight[j] * reference.memory[j];
    }
    reference_free(&reference);
    return plays;
}

void fast_plays_free(fast_plays_t* plays)
{
    if (plays == NULL) {
        return;
    }
    free(plays->ascending.value);
    free(plays->descending.value);
    free(plays->nonhysteretic.value);
    free(plays->weight_sum);
    free(plays->moment_sum);
    free(plays->start_state);
    free(plays->start_tail);
    free(plays);
}

/// Plays up to `end` (from where the segment above ends) in states level - sign * radius.
typedef struct {
    double level;
    double sign; ///< 1: left by a rise, -1: by a fall
    size_t end;
    double tail; ///< weighted sum of all plays from `end` on
} segment_t;

/// Weighted sum of plays begin ... end - 1 in a segment's states.
static double segment_sum(const fast_plays_t* plays, const segment_t* segment, size_t begin)
{
    return segment->level * (plays->weight_sum[segment->end] - plays->weight_sum[begin]) -
           segment->sign * (plays->moment_sum[segment->end] - plays->moment_sum[begin]);
}

/// The first play from `begin` on, below `end`, that envelope * sign does not move: those it moves come
/// first.
static size_t first_unmoved(const fast_plays_t* plays, const segment_t* segment, size_t begin, size_t end,
                            double envelope, double sign)
{
    const double* radius = plays->model->radius;
    while (begin < end) {
        const size_t middle = begin + (end - begin) / 2;
        const double state =
            segment != NULL ? segment->level - segment->sign * radius[middle] : plays->start_state[middle];
        if (sign * (envelope - sign * radius[middle] - state) > 0) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin;
}

/// Pushes the stack (top last) by an envelope; returns the new weighted sum.
static double push(const fast_plays_t* plays, segment_t* stack, size_t* count, double envelope, double sign)
{
    size_t moved = 0;
    double rest = plays->start_tail[0];
    while (*count > 0) {
        const segment_t* top = &stack[*count - 1];
        moved = first_unmoved(plays, top, moved, top->end, envelope, sign);
        if (moved < top->end) {
            rest = segment_sum(plays, top, moved) + top->tail;
            break;
        }
        --*count;
    }
    if (*count == 0) {
        moved = first_unmoved(plays, NULL, moved, plays->model->num_plays, envelope, sign);
        rest = plays->start_tail[moved];
    }
    if (moved == 0) {
        return rest;
    }
    stack[*count] = (segment_t){envelope, sign, moved, rest};
    ++*count;
    return segment_sum(plays, &stack[*count - 1], 0) + rest;
}

void fast_plays_run(const fast_plays_t* plays, const double* input, size_t num_samples, double* sum)
{
    segment_t* stack = xmalloc((plays->model->num_plays + 2) * sizeof *stack);
    size_t count = 0;
    double before = plays->start_input;
    double present = plays->start_tail[0];
    for (size_t t = 0; t < num_samples; t++) {
        if (input[t] > before) {
            present = push(plays, stack, &count, look_up(plays, &plays->ascending, input[t]), 1);
        } else if (input[t] < before) {
            present = push(plays, stack, &count, look_up(plays, &plays->descending, input[t]), -1);
        }
        before = input[t];
        sum[t] = present;
    }
    free(stack);
}

double fast_plays_nonhysteretic(const fast_plays_t* plays, double v)
{
    return look_up(plays, &plays->nonhysteretic, v);
}
