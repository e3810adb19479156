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
    double total_weight;
    cell_error_t allowed;
} search_t;

static cell_error_t cell_error(const search_t* search, float low, float high)
{
    const model_t* model = search->model;
    const double ascending = chord_error(&model->ascending, (double)low, (double)high);
    const double descending = chord_error(&model->descending, (double)low, (double)high);
    return (cell_error_t){search->total_weight * fmax(ascending, descending),
                          chord_error(&model->nonhysteretic, (double)low, (double)high)};
}

static bool is_allowed(const search_t* search, float low, float high)
{
    const cell_error_t error = cell_error(search, low, high);
    return error.envelopes <= search->allowed.envelopes &&
           error.nonhysteretic <= search->allowed.nonhysteretic;
}

/// The end of the longest allowed cell, found by halving; `start` itself where not even the next float is
/// one.
static float longest_cell(const search_t* search, float start, float end)
{
    if (is_allowed(search, start, end)) {
        return end;
    }
    float good = start;
    float bad = end;
    for (;;) {
        float middle = (float)(0.5 * ((double)good + (double)bad));
        if (!(middle > good && middle < bad)) {
            middle = nextafterf(good, bad);
        }
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
static grid_t walk(const search_t* search, float low, float high, size_t limit)
{
    size_t capacity = 64;
    grid_t grid = {.num_knots = 1, .input = xmalloc(capacity * sizeof(float))};
    cell_error_t largest = {0.0, 0.0};
    float start = low;
    grid.input[0] = low;
    while (start < high) {
        const float end = longest_cell(search, start, high);
        if (!(end > start) || grid.num_knots + 1 >= limit) {
            grid_free(&grid);
            return grid;
        }
        if (grid.num_knots == capacity) {
            capacity *= 2;
            grid.input = xrealloc(grid.input, capacity * sizeof(float));
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

grid_t grid_find(const model_t* model, float low, float high, double tolerance)
{
    enum { NUM_SHARES = 16 };
    search_t search = {.model = model};
    for (size_t j = 0; j < model->num_plays; ++j) {
        search.total_weight += model->weight[j];
    }
    grid_t best = {0};
    for (int share = 0; share <= NUM_SHARES; ++share) {
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
