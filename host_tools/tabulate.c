#include "tabulate.h"
#include "float_error.h"
#include "float_lines.h"
#include "grid.h"
#include "output_range.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>

/// The floats next to x, or x itself, on the side of the range's middle.
static float rounded_up(double x)
{
    const float nearest = (float)x;
    return (double)nearest < x ? nextafterf(nearest, INFINITY) : nearest;
}

static float rounded_down(double x)
{
    const float nearest = (float)x;
    return (double)nearest > x ? nextafterf(nearest, -INFINITY) : nearest;
}

static void store_plays(const model_t* model, tabulated_t* tabulated)
{
    tabulated->radius = xcalloc(model->num_plays, sizeof(float));
    tabulated->weight = xcalloc(model->num_plays, sizeof(float));
    tabulated->play = xcalloc(model->num_plays, sizeof(hyst_f32_play_t));
    for (size_t j = 0; j < model->num_plays; ++j) {
        tabulated->radius[j] = (float)model->radius[j];
        tabulated->weight[j] = (float)model->weight[j];
    }
    tabulated->model.num_plays = (uint32_t)model->num_plays;
    tabulated->model.moment =
        float_lines_loading(tabulated->radius, tabulated->weight, model->num_plays, tabulated->play);
    tabulated->model.play = tabulated->play;
}

static void store_values(const model_t* model, const grid_t* grid, hyst_f32_knot_t* knot)
{
    for (size_t k = 0; k < grid->num_knots; ++k) {
        const double v = grid->input[k];
        const double descending = curve_value(&model->descending, v);
        knot[k].input = (float)v;
        knot[k].descending = (float)descending;
        knot[k].ascending =
            (float)fmin(curve_value(&model->ascending, v), descending + 2.0 * model->radius[0]);
        knot[k].nonhysteretic = (float)curve_value(&model->nonhysteretic, v);
    }
}

/// Where float cannot tell neighbouring values apart, moves them by as little as makes the envelopes strictly
/// increase: the ascending one down and the descending one up, so that they stay in order.
static void separate(hyst_f32_knot_t* knot, size_t num_knots)
{
    for (size_t k = 1; k < num_knots; ++k) {
        knot[k].descending = fmaxf(knot[k].descending, nextafterf(knot[k - 1].descending, INFINITY));
        knot[k].nonhysteretic = fmaxf(knot[k].nonhysteretic, knot[k - 1].nonhysteretic);
    }
    for (size_t k = num_knots - 1; k > 0; --k) {
        knot[k - 1].ascending = fminf(knot[k - 1].ascending, nextafterf(knot[k].ascending, -INFINITY));
    }
}

static void store_slopes(hyst_f32_knot_t* knot, size_t num_knots)
{
    for (size_t k = 0; k + 1 < num_knots; ++k) {
        const hyst_f32_knot_t* next = &knot[k + 1];
        const float v = knot[k].input;
        knot[k].ascending_slope = float_lines_slope(v, knot[k].ascending, next->input, next->ascending);
        knot[k].descending_slope = float_lines_slope(v, knot[k].descending, next->input, next->descending);
        knot[k].nonhysteretic_slope =
            float_lines_slope(v, knot[k].nonhysteretic, next->input, next->nonhysteretic);
    }
}

static const char* store_table(const model_t* model, double table_error, tabulated_t* tabulated)
{
    grid_t grid = grid_find(model, GRID_OF_FLOATS, (double)tabulated->model.input_min,
                            (double)tabulated->model.input_max, table_error);
    if (grid.num_knots == 0) {
        return "no table of at most 65535 knots at float inputs is that close";
    }
    tabulated->table_error = grid.error;
    tabulated->knot = xcalloc(grid.num_knots, sizeof(hyst_f32_knot_t));
    store_values(model, &grid, tabulated->knot);
    separate(tabulated->knot, grid.num_knots);
    store_slopes(tabulated->knot, grid.num_knots);
    tabulated->model.knot = tabulated->knot;
    tabulated->model.num_knots = (uint32_t)grid.num_knots;
    grid_free(&grid);
    return NULL;
}

static const char* store(const prepared_t* prepared, double table_error, tabulated_t* tabulated)
{
    const model_t* model = &prepared->model;
    hyst_f32_model_t* stored = &tabulated->model;
    stored->format = HYST_MODEL_FORMAT;
    stored->input_min = rounded_up(model->input_min);
    stored->input_max = rounded_down(model->input_max);
    stored->constant = (float)prepared->constant;
    if (!(stored->input_min < stored->input_max) || !isfinite(stored->input_max - stored->input_min)) {
        return "the input's range cannot be told in float";
    }
    store_plays(model, tabulated);
    if (prepared->classical) {
        stored->nonhysteretic_slope = (float)model->nonhysteretic.slope;
        return NULL;
    }
    return store_table(model, table_error, tabulated);
}

const char* tabulate(const model_t* model, double table_error, tabulated_t* tabulated)
{
    *tabulated = (tabulated_t){0};
    if (model->num_plays > HYST_MAX_PLAYS) {
        return "it has more than 4096 plays: compress it first";
    }
    prepared_t prepared = prepare(model);
    const char* fault = store(&prepared, table_error, tabulated);
    if (fault == NULL) {
        tabulated->float_error =
            float_error(&prepared, &tabulated->model, tabulated->radius, tabulated->weight);
    } else {
        tabulated_free(tabulated);
    }
    prepared_free(&prepared);
    return fault;
}

double tabulate_default_error(const model_t* model)
{
    return 1e-4 * (model_output_max(model) - model_output_min(model));
}

void tabulated_free(tabulated_t* tabulated)
{
    free(tabulated->radius);
    free(tabulated->weight);
    free(tabulated->play);
    free(tabulated->knot);
    *tabulated = (tabulated_t){0};
}
