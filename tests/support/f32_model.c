#include "f32_model.h"
#include "float_error.h"
#include "float_lines.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static float* copy_of(const float* values, size_t count)
{
    float* copy = xmalloc(count * sizeof *copy);
    memcpy(copy, values, count * sizeof *copy);
    return copy;
}

void f32_update_plays(f32_model_t* made)
{
    made->model.moment = float_lines_loading(made->radius, made->weight, made->model.num_plays, made->play);
}

static f32_model_t with_plays(const float* radius, const float* weight, size_t num_plays)
{
    f32_model_t made = {.radius = copy_of(radius, num_plays),
                        .weight = copy_of(weight, num_plays),
                        .play = xcalloc(num_plays, sizeof(hyst_f32_play_t)),
                        .memory = xcalloc(num_plays, sizeof(hyst_f32_segment_t)),
                        .exact = model_new("test")};
    made.model.format = HYST_MODEL_FORMAT;
    made.model.num_plays = (uint32_t)num_plays;
    made.model.play = made.play;
    f32_update_plays(&made);
    model_set_num_plays(&made.exact, num_plays);
    for (size_t j = 0; j < num_plays; ++j) {
        made.exact.radius[j] = (double)radius[j];
        made.exact.weight[j] = (double)weight[j];
    }
    return made;
}

static void set_range(f32_model_t* made, float input_min, float input_max)
{
    made->model.input_min = input_min;
    made->model.input_max = input_max;
    made->exact.input_min = (double)input_min;
    made->exact.input_max = (double)input_max;
}

f32_model_t f32_classical(const float* radius, const float* weight, size_t num_plays, float slope,
                          float input_min, float input_max)
{
    f32_model_t made = with_plays(radius, weight, num_plays);
    set_range(&made, input_min, input_max);
    made.model.nonhysteretic_slope = slope;
    curve_free(&made.exact.nonhysteretic);
    made.exact.nonhysteretic = curve_linear((double)slope, 0.0);
    return made;
}

static void set_exact_curves(f32_model_t* made, size_t num_knots)
{
    double* columns = xmalloc(4 * num_knots * sizeof *columns);
    double* x = columns;
    double* ascending = columns + num_knots;
    double* descending = columns + 2 * num_knots;
    double* nonhysteretic = columns + 3 * num_knots;
    for (size_t k = 0; k < num_knots; ++k) {
        x[k] = (double)made->knot[k].input;
        ascending[k] = (double)made->knot[k].ascending;
        descending[k] = (double)made->knot[k].descending;
        nonhysteretic[k] = (double)made->knot[k].nonhysteretic + (double)made->model.constant;
    }
    curve_free(&made->exact.ascending);
    curve_free(&made->exact.descending);
    curve_free(&made->exact.nonhysteretic);
    made->exact.ascending = curve_table(x, ascending, num_knots);
    made->exact.descending = curve_table(x, descending, num_knots);
    made->exact.nonhysteretic = curve_table(x, nonhysteretic, num_knots);
    free(columns);
}

f32_model_t f32_tabulated(const float* radius, const float* weight, size_t num_plays,
                          const hyst_f32_knot_t* knot, size_t num_knots, float constant)
{
    f32_model_t made = with_plays(radius, weight, num_plays);
    made.knot = xmalloc(num_knots * sizeof *made.knot);
    memcpy(made.knot, knot, num_knots * sizeof *made.knot);
    for (size_t k = 0; k + 1 < num_knots; ++k) {
        hyst_f32_knot_t* a = &made.knot[k];
        const hyst_f32_knot_t* b = &made.knot[k + 1];
        a->ascending_slope = float_lines_slope(a->input, a->ascending, b->input, b->ascending);
        a->descending_slope = float_lines_slope(a->input, a->descending, b->input, b->descending);
        a->nonhysteretic_slope = float_lines_slope(a->input, a->nonhysteretic, b->input, b->nonhysteretic);
    }
    // The last knot's slopes are documented as unused.
    made.knot[num_knots - 1].ascending_slope = NAN;
    made.knot[num_knots - 1].descending_slope = NAN;
    made.knot[num_knots - 1].nonhysteretic_slope = NAN;
    made.model.knot = made.knot;
    made.model.num_knots = (uint32_t)num_knots;
    made.model.constant = constant;
    set_range(&made, knot[0].input, knot[num_knots - 1].input);
    set_exact_curves(&made, num_knots);
    return made;
}

enum { MOST_KNOTS = 80, MOST_PLAYS = 128 };

/// A rise over a cell: often none, otherwise over four decades.
static double random_rise(random_t* random, double scale)
{
    return random_below(random, 5) == 0 ? 0.0 : scale * pow(10.0, random_uniform(random, -4.0, 0.0));
}

/// Fills in random curves; returns the least radius that keeps every play's branches in order.
static double random_knots(random_t* random, hyst_f32_knot_t* knot, size_t num_knots)
{
    const double scale = pow(10.0, random_uniform(random, -2.0, 3.0));
    double input = random_uniform(random, -100.0, 100.0);
    double ascending = random_uniform(random, -3.0, 1.0) * scale;
    double descending = ascending + random_uniform(random, -0.5, 1.0) * scale;
    double nonhysteretic = random_uniform(random, -3.0, 3.0) * scale;
    double least = 0.0;
    for (size_t k = 0; k < num_knots; ++k) {
        knot[k] = (hyst_f32_knot_t){.input = (float)input,
                                    .ascending = (float)ascending,
                                    .descending = (float)descending,
                                    .nonhysteretic = (float)nonhysteretic};
        least = fmax(least, 0.5 * ((double)knot[k].ascending - (double)knot[k].descending));
        input += pow(10.0, random_uniform(random, -2.0, 1.0));
        // The first cell always rises: an envelope must somewhere.
        ascending += (k == 0 ? 0.01 * scale : 0.0) + random_rise(random, scale);
        descending += (k == 0 ? 0.01 * scale : 0.0) + random_rise(random, scale);
        nonhysteretic += random_rise(random, 0.3 * scale);
    }
    return least;
}

static size_t random_plays(random_t* random, float* radius, float* weight, double least, double most)
{
    const size_t num_plays =
        random_below(random, 3) == 0 ? 1 + random_below(random, 3) : 1 + random_below(random, MOST_PLAYS);
    double r = least;
    for (size_t j = 0; j < num_plays; ++j) {
        radius[j] = (float)r;
        const double step = random_uniform(random, 0.0, 2.2 * (most - least) / (double)num_plays);
        r += random_below(random, 8) == 0 ? 0.0 : step;
        weight[j] = random_below(random, 8) == 0 ? 0.0F : (float)random_uniform(random, 0.0, 2.0);
    }
    return num_plays;
}

f32_model_t f32_random(random_t* random)
{
    float radius[MOST_PLAYS];
    float weight[MOST_PLAYS];
    if (random_below(random, 4) == 0) {
        const double low = random_uniform(random, -100.0, 100.0);
        const double width = pow(10.0, random_uniform(random, -1.0, 2.0));
        const size_t num_plays = random_plays(random, radius, weight, 0.0, 0.5 * width);
        const float slope = random_below(random, 2) == 0 ? 0.0F : (float)random_uniform(random, 0.0, 3.0);
        return f32_classical(radius, weight, num_plays, slope, (float)low, (float)(low + width));
    }
    hyst_f32_knot_t knot[MOST_KNOTS];
    const size_t num_knots = 2 + random_below(random, MOST_KNOTS - 1);
    const double least = random_knots(random, knot, num_knots);
    const double half = 0.5 * ((double)knot[num_knots - 1].ascending - (double)knot[0].descending);
    const size_t num_plays = random_plays(random, radius, weight, least, fmax(half, least));
    return f32_tabulated(radius, weight, num_plays, knot, num_knots,
                         (float)random_uniform(random, -5.0, 5.0));
}

void f32_free(f32_model_t* made)
{
    free(made->radius);
    free(made->weight);
    free(made->play);
    free(made->knot);
    free(made->memory);
    model_free(&made->exact);
    *made = (f32_model_t){0};
}

void f32_plays(const f32_model_t* made, const hyst_f32_state_t* state, double* w)
{
    uint32_t j = 0;
    for (uint32_t i = state->front + 1; i-- > 0;) {
        const hyst_f32_segment_t* segment = &state->memory[i];
        for (; j <= segment->last; ++j) {
            const double outward = (double)segment->level - (double)made->radius[j];
            w[j] = segment->rising != 0 ? outward : -outward;
        }
    }
}

hyst_f32_state_t f32_state(f32_model_t* made)
{
    hyst_f32_state_t state;
    const hyst_status_t status = hyst_f32_init(&made->model, &state, made->memory, made->model.num_plays);
    if (status != HYST_STATUS_OK) {
        fprintf(stderr, "f32_state: %s\n", hyst_status_text(status));
        exit(EXIT_FAILURE);
    }
    return state;
}

/// Largest values that the bounds are made of.
typedef struct {
    double envelope, envelope_rise, envelope_slope; ///< magnitude; rise and slope within a cell
    double nonhysteretic, nonhysteretic_rise,
        slope;           ///< likewise for D; slope: of the output, all plays moving
    double input, width; ///< magnitude; of a cell
} extent_t;

static extent_t classical_extent(const hyst_f32_model_t* model, double total)
{
    const double input = fmax(fabs((double)model->input_min), fabs((double)model->input_max));
    const double slope = (double)model->nonhysteretic_slope;
    return (extent_t){.envelope = input,
                      .envelope_slope = 1.0,
                      .nonhysteretic = slope * input,
                      .slope = slope + total,
                      .input = input,
                      .width = (double)model->input_max - (double)model->input_min};
}

static extent_t table_extent(const hyst_f32_model_t* model, double total)
{
    extent_t most = {0};
    for (uint32_t k = 0; k < model->num_knots; ++k) {
        const hyst_f32_knot_t* a = &model->knot[k];
        most.envelope = fmax(most.envelope, fmax(fabs((double)a->ascending), fabs((double)a->descending)));
        most.nonhysteretic = fmax(most.nonhysteretic, fabs((double)a->nonhysteretic));
        most.input = fmax(most.input, fabs((double)a->input));
        if (k + 1 == model->num_knots) {
            break;
        }
        const double rise = fmax((double)a[1].ascending - (double)a->ascending,
                                 (double)a[1].descending - (double)a->descending);
        const double slope = fmax((double)a->ascending_slope, (double)a->descending_slope);
        most.envelope_rise = fmax(most.envelope_rise, rise);
        most.envelope_slope = fmax(most.envelope_slope, slope);
        most.nonhysteretic_rise =
            fmax(most.nonhysteretic_rise, (double)a[1].nonhysteretic - (double)a->nonhysteretic);
        most.slope = fmax(most.slope, total * slope + (double)a->nonhysteretic_slope);
        most.width = fmax(most.width, (double)a[1].input - (double)a->input);
    }
    return most;
}

/// u = 2^-24. A tabulated curve: slope, lowered by up to one unit, difference and product, 5 u of the cell's
/// rise; the sum, and the unit the slope was lowered for, 2 u of the value. The plays' sums: float_error.c.
/// Then D, constant + D, total. Round trip: the bracket's ends and the answer are each off by that, weighted
/// to 2 in all. A kink is misplaced by u (envelope + 2 r) in the envelope, within the plays' part of twice
/// the bound, and in the input by 3 u of the cell's width and u of the input; solving adds 5 u of the width
/// and u of the input. The input's part counts times the steepest slope of the output. Demagnetising: the
/// interpolation is off by 18 u (DESIGN: hyst_f32_snapshot.c) of (envelope + r), and the rounded middle of
/// the range and amplitudes by 3 u of the input, times the envelope's slope, twice since both branches move.
f32_bound_t f32_bound(const f32_model_t* made)
{
    const double u = 0.5 * (double)FLT_EPSILON;
    const hyst_f32_model_t* model = &made->model;
    double total = 0.0;
    double reach_sum = 0.0;
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        total += made->exact.weight[j];
    }
    const extent_t most = model->num_knots == 0 ? classical_extent(model, total) : table_extent(model, total);
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        reach_sum += made->exact.weight[j] * (most.envelope + made->exact.radius[j]);
    }
    const double envelope =
        model->num_knots == 0 ? 0.0 : 5.0 * u * most.envelope_rise + 2.0 * u * most.envelope;
    const double offset = fabs((double)model->constant) + most.nonhysteretic;
    const double plays = total * envelope + float_error_of_sums(model, most.envelope);
    const double rest = u * (5.0 * most.nonhysteretic_rise + 2.0 * most.nonhysteretic) + u * offset +
                        u * (offset + reach_sum);
    // Terms in u^2 are below a thousandth of these for N <= 4096; the last term is for underflow.
    const double output = 1.001 * (plays + rest) + (model->num_plays + 4.0) * (double)FLT_MIN;
    return (f32_bound_t){
        .output = output,
        .round_trip = 4.0 * output + 1.001 * most.slope * u * (2.0 * most.input + 8.0 * most.width),
        .demagnetise = 18.0 * u * reach_sum + 2.0 * total * most.envelope_slope * 3.0 * u * most.input,
    };
}

float f32_random_input(random_t* random, const f32_model_t* made, float last)
{
    const double low = made->exact.input_min;
    const double high = made->exact.input_max;
    const size_t kind = random_below(random, 16);
    if (kind == 0) {
        return made->model.input_min;
    }
    if (kind == 1) {
        return made->model.input_max;
    }
    if (kind == 2 && made->model.num_knots != 0) {
        return made->knot[random_below(random, made->model.num_knots)].input;
    }
    if (kind < 10) {
        const double step = pow(10.0, random_uniform(random, -6.0, 0.0)) * (high - low);
        return (float)fmin(fmax((double)last + (random_below(random, 2) == 0 ? step : -step), low), high);
    }
    return fminf(fmaxf((float)random_uniform(random, low, high), made->model.input_min),
                 made->model.input_max);
}

uint32_t f32_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

float f32_from_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}
