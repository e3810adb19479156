#include "grid.h"
#include "chord.h"
#include "hyst/hyst.h"
#include <math.h>
#include <stdlib.h>

/// What a cell may put on the output through the envelopes and through the non-hysteretic part: they add up,
/// for the plays remember cells long left.
typedef struct {
    double envelopes, nonhysteretic;
} cell_error_t;

typedef struct {
    const model_t* model;
    grid_inputs_t inputs;
    double total_weight;
    cell_error_t allowed;
} search_t;

static cell_error_t cell_error(const search_t* search, double low, double high)
{
    const model_t* model = search->model;
    if (search->inputs == GRID_OF_INTEGERS && high - low <= 1.0) {
        return (cell_error_t){0.0, 0.0};
    }
    const double ascending = chord_error(&model->ascending, low, high);
    const double descending = chord_error(&model->descending, low, high);
    return (cell_error_t){search->total_weight * fmax(ascending, descending),
                          chord_error(&model->nonhysteretic, low, high)};
}

static bool is_allowed(const search_t* search, double low, double high)
{
    const cell_error_t error = cell_error(search, low, high);
    return error.envelopes <= search->allowed.envelopes &&
           error.nonhysteretic <= search->allowed.nonhysteretic;
}

/// An input between the two (low < high), near their middle; `high` when there is none.
static double between(const search_t* search, double low, double high)
{
    const double middle = 0.5 * (low + high);
    if (search->inputs == GRID_OF_INTEGERS) {
        return floor(middle) > low ? floor(middle) : high;
    }
    const double rounded = (double)(float)middle;
    return rounded > low && rounded < high ? rounded : (double)nextafterf((float)low, (float)high);
}

/// The end of the longest allowed cell, found by halving; `start` itself where not even the next input is
/// one.
static double longest_cell(const search_t* search, double start, double end)
{
    if (is_allowed(search, start, end)) {
        return end;
    }
    double good = start;
    double bad = end;
    for (;;) {
        const double middle = between(search, good, bad);
        if (!(middle < bad)) {
            return good;
        }
        if (is_allowed(search, start, middle)) {
            good = middle;
        } else {
            bad = middle;
        }
    }
}

/// Fewer knots than `limit`, or none.
static grid_t walk(const search_t* search, double low, double high, size_t limit)
{
    size_t capacity = 64;
    grid_t grid = {.num_knots = 1, .input = xmalloc(capacity * sizeof(double))};
    cell_error_t largest = {0.0, 0.0};
    double start = low;
    grid.input[0] = low;
    while (start < high) {
        const double end = longest_cell(search, start, high);
        if (!(end > start) || grid.num_knots + 1 >= limit) {
            grid_free(&grid);
            return grid;
        }
        if (grid.num_knots == capacity) {
            capacity *= 2;
            grid.input = xrealloc(grid.input, capacity * sizeof(double));
        }
        const cell_error_t error = cell_error(search, start, end);
        largest.envelopes = fmax(largest.envelopes, error.envelopes);
        largest.nonhysteretic = fmax(largest.nonhysteretic, error.nonhysteretic);
        grid.input[grid.num_knots++] = end;
        start = end;
    }
    grid.error = largest.envelopes + largest.nonhysteretic;
    return grid;
}

grid_t grid_find(const model_t* model, grid_inputs_t inputs, double low, double high, double tolerance)
{
    enum { NUM_SHARES = 16 };
    search_t search = {.model = model, .inputs = inputs};
    for (size_t j = 0; j < model->num_plays; ++j) {
        search.total_weight += model->weight[j];
    }
    grid_t best = {0};
    for (int i = 0; i <= NUM_SHARES; ++i) {
        // Even shares first: they soon limit the walks that have next to nothing for one of the two.
        const int share = (i + NUM_SHARES / 2) % (NUM_SHARES + 1);
        search.allowed.envelopes = tolerance * share / NUM_SHARES;
        search.allowed.nonhysteretic = tolerance - search.allowed.envelopes;
        const size_t limit = best.num_knots > 0 ? best.num_knots : HYST_MAX_KNOTS + 1;
        grid_t grid = walk(&search, low, high, limit);
        if (grid.num_knots > 0) {
            grid_free(&best);
            best = grid;
        }
    }
    return best;
}

void grid_free(grid_t* grid)
{
    free(grid->input);
    *grid = (grid_t){0};
}
