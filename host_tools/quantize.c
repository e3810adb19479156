#include "chord.h"
#include "grid.h"
#include "quantize_internal.h"
#include <math.h>
#include <stdlib.h>

int64_t nearest_integer(double x)
{
    return (int64_t)floor(x + 0.5);
}

const curve_t* model_curve(const model_t* model, which_curve_t which)
{
    const curve_t* curves[NUM_CURVES] = {&model->ascending, &model->descending, &model->nonhysteretic};
    return curves[which];
}

double model_total_weight(const model_t* model)
{
    double sum = 0.0;
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j];
    }
    return sum;
}

double quantized_input(const quantized_t* quantized, int32_t input)
{
    return quantized->input_offset + quantized->input_scale * (double)input;
}

uint32_t knot_value(const hyst_q31_knot_t* knot, which_curve_t which)
{
    const uint32_t values[NUM_CURVES] = {knot->ascending, knot->descending, knot->nonhysteretic};
    return values[which];
}

uint32_t knot_slope(const hyst_q31_knot_t* knot, which_curve_t which)
{
    const uint32_t slopes[NUM_CURVES] = {knot->ascending_slope, knot->descending_slope,
                                         knot->nonhysteretic_slope};
    return slopes[which];
}

static uint32_t state_max(const quantized_t* quantized)
{
    return quantized->bits == QUANTIZED_Q31 ? HYST_Q31_STATE_MAX : HYST_Q15_STATE_MAX;
}

static uint32_t radius_max(const quantized_t* quantized)
{
    return quantized->bits == QUANTIZED_Q31 ? HYST_Q31_RADIUS_MAX : HYST_Q15_RADIUS_MAX;
}

/// 2^bits: what a slope or a weight of one is stored as.
static double unity(const quantized_t* quantized)
{
    return ldexp(1.0, (int)quantized->bits);
}

/// The integers that a range spans to either side of its middle. The last 1/64 of all integers is left free,
/// so that what lies out of range can be told from what lies at its end.
static double half_span(const quantized_t* quantized)
{
    return unity(quantized) * (0.5 - 1.0 / 128.0);
}

/// q15 headers state scales and offsets in float: what is computed from them must start from the float.
static double storable(const quantized_t* quantized, double x)
{
    return quantized->bits == QUANTIZED_Q15 ? (double)(float)x : x;
}

/// The scale that makes `half_width` at most half_span integers.
static double storable_scale(const quantized_t* quantized, double half_width)
{
    const double scale = half_width / half_span(quantized);
    return quantized->bits == QUANTIZED_Q15 ? (double)nextafterf((float)scale, INFINITY) : scale;
}

static const char* choose_input(const model_t* model, quantized_t* quantized)
{
    const double half_width = 0.5 * (model->input_max - model->input_min);
    quantized->input_scale = storable_scale(quantized, half_width);
    quantized->input_offset = storable(quantized, model->input_min + half_width);
    if (!isnormal(quantized->input_scale) || !isfinite(quantized->input_offset)) {
        return "the input's range cannot be scaled to integers";
    }
    const double low = (model->input_min - quantized->input_offset) / quantized->input_scale;
    const double high = (model->input_max - quantized->input_offset) / quantized->input_scale;
    const double limit = 0.5 * unity(quantized);
    if (!(low > -limit && high < limit - 1.0)) {
        return "the input's range is too narrow for its distance from 0";
    }
    quantized->model.input_min = (int32_t)nearest_integer(low);
    quantized->model.input_max = (int32_t)nearest_integer(high);
    return NULL;
}

/// Every envelope and every state there can be lies between 4 units above 0 and 4 below the largest integer:
/// roundings of knots and radii stay within that.
static void choose_state(const model_t* model, quantized_t* quantized)
{
    const double bottom = quantized_input(quantized, quantized->model.input_min);
    const double top = quantized_input(quantized, quantized->model.input_max);
    const double descending = curve_value(&model->descending, bottom);
    const double ascending = curve_value(&model->ascending, top);
    const double widest = model->radius[model->num_plays - 1];
    const double low = fmin(fmin(descending, curve_value(&model->ascending, bottom)), ascending - widest);
    const double high = fmax(fmax(ascending, curve_value(&model->descending, top)), descending + widest);
    const double for_states = (high - low) / ((double)state_max(quantized) - 8.0);
    const double for_radii = widest / ((double)radius_max(quantized) - 1.0);
    quantized->state_scale = fmax(for_states, for_radii);
    quantized->state_offset = low - 4.0 * quantized->state_scale;
}

/// Which outputs there can be: every play keeps between its two saturations.
static void choose_output(const model_t* model, quantized_t* quantized)
{
    const double bottom = quantized_input(quantized, quantized->model.input_min);
    const double top = quantized_input(quantized, quantized->model.input_max);
    double low = curve_value(&model->nonhysteretic, bottom);
    double high = curve_value(&model->nonhysteretic, top);
    for (size_t j = 0; j < model->num_plays; ++j) {
        const double negative = curve_value(&model->descending, bottom) + model->radius[j];
        const double positive = curve_value(&model->ascending, top) - model->radius[j];
        low += model->weight[j] * fmin(negative, positive);
        high += model->weight[j] * fmax(negative, positive);
    }
    // The total weight must fit in a word, with a bit to spare for its rounding.
    const double for_weights =
        model_total_weight(model) * quantized->state_scale * unity(quantized) / (unity(quantized) - 2.0);
    const double half_width = fmax(0.5 * (high - low), for_weights * half_span(quantized));
    const double middle = 0.5 * (low + high);
    quantized->output_scale =
        storable_scale(quantized, half_width > 0.0 ? half_width : fmax(fabs(middle), 1.0));
    quantized->output_offset = storable(quantized, middle);
}

/// The weights' running sum is rounded, not each weight, so that the errors do not add up.
static void store_plays(const model_t* model, quantized_t* quantized)
{
    const size_t num_plays = model->num_plays;
    quantized->radius = xcalloc(num_plays, sizeof *quantized->radius);
    quantized->cumulative_weight = xcalloc(num_plays + 1, sizeof *quantized->cumulative_weight);
    quantized->cumulative_moment = xcalloc(num_plays + 1, sizeof *quantized->cumulative_moment);
    const double unit = quantized->output_scale / (quantized->state_scale * unity(quantized));
    double sum = 0.0;
    for (size_t j = 0; j < num_plays; ++j) {
        sum += model->weight[j];
        quantized->radius[j] = (uint32_t)nearest_integer(model->radius[j] / quantized->state_scale);
        quantized->cumulative_weight[j + 1] = (uint32_t)nearest_integer(sum / unit);
        const uint64_t weight = quantized->cumulative_weight[j + 1] - quantized->cumulative_weight[j];
        quantized->cumulative_moment[j + 1] = quantized->cumulative_moment[j] + weight * quantized->radius[j];
    }
    quantized->model.num_plays = (uint32_t)num_plays;
    quantized->model.radius = quantized->radius;
    quantized->model.cumulative_weight = quantized->cumulative_weight;
    quantized->model.cumulative_moment = quantized->cumulative_moment;
}

/// The curve over the input's integers.
static curve_t rescaled(const curve_t* curve, const quantized_t* quantized)
{
    curve_t copy = curve_copy(curve);
    copy.shift += copy.slope * quantized->input_offset;
    copy.slope *= quantized->input_scale;
    for (size_t i = 0; i < copy.num_knots; ++i) {
        copy.x[i] = (copy.x[i] - quantized->input_offset) / quantized->input_scale;
    }
    return copy;
}

static model_t rescaled_model(const model_t* model, const quantized_t* quantized)
{
    model_t copy = model_new("");
    model_set_num_plays(&copy, model->num_plays);
    for (size_t j = 0; j < model->num_plays; ++j) {
        copy.weight[j] = model->weight[j];
    }
    copy.ascending = rescaled(&model->ascending, quantized);
    copy.descending = rescaled(&model->descending, quantized);
    copy.nonhysteretic = rescaled(&model->nonhysteretic, quantized);
    return copy;
}

/// Knots at integers, strictly increasing.
typedef struct {
    size_t num_knots, capacity;
    int32_t* input;
} knots_t;

static void append(knots_t* knots, int32_t input)
{
    if (knots->num_knots == knots->capacity) {
        knots->capacity = 2 * knots->capacity + 64;
        knots->input = xrealloc(knots->input, knots->capacity * sizeof *knots->input);
    }
    knots->input[knots->num_knots++] = input;
}

/// What the curve rises over a cell, in units of what it is stored in.
static double rise(const model_t* rescaled_to, const quantized_t* quantized, which_curve_t which, double low,
                   double high)
{
    const curve_t* curve = model_curve(rescaled_to, which);
    const double unit = which == CURVE_OF_NONHYSTERETIC ? quantized->output_scale : quantized->state_scale;
    return (curve_value(curve, high) - curve_value(curve, low)) / unit;
}

/// Appends the knots above the last one up to `end`, as many as it takes for the inverse's lines to hold
/// (lib/DESIGN.md, section 7): in a cell of more than one input no curve rises by more than an eighth of what
/// a word holds. False where slopes do not fit in a word: a curve rises by more than half of it from one
/// input to the next.
static bool append_cell(const model_t* rescaled_to, const quantized_t* quantized, knots_t* knots, int32_t end)
{
    const double most = 0.125 * unity(quantized) - 4.0;
    const double most_of_one = 0.5 * unity(quantized) - 4.0;
    while (knots->input[knots->num_knots - 1] < end) {
        const int64_t start = knots->input[knots->num_knots - 1];
        int64_t next = end;
        for (int which = 0; which < NUM_CURVES; ++which) {
            while (next > start + 1 &&
                   rise(rescaled_to, quantized, (which_curve_t)which, (double)start, (double)next) > most) {
                next = start + (next - start) / 2;
            }
            if (rise(rescaled_to, quantized, (which_curve_t)which, (double)start, (double)next) >
                most_of_one) {
                return false;
            }
        }
        append(knots, (int32_t)next);
    }
    return true;
}

/// What the chords put on the output at integer inputs.
static double chords_error(const model_t* rescaled_to, const knots_t* knots)
{
    double largest[NUM_CURVES] = {0.0, 0.0, 0.0};
    for (size_t k = 0; k + 1 < knots->num_knots; ++k) {
        const double low = (double)knots->input[k];
        const double high = (double)knots->input[k + 1];
        for (int which = 0; high - low > 1.0 && which < NUM_CURVES; ++which) {
            largest[which] =
                fmax(largest[which], chord_error(model_curve(rescaled_to, (which_curve_t)which), low, high));
        }
    }
    return model_total_weight(rescaled_to) * fmax(largest[CURVE_OF_ASCENDING], largest[CURVE_OF_DESCENDING]) +
           largest[CURVE_OF_NONHYSTERETIC];
}

/// The grid's knots, and more where a cell rises too far. Returns why that fails, or NULL.
static const char* divide_grid(const model_t* rescaled_to, const quantized_t* quantized, const grid_t* grid,
                               knots_t* knots)
{
    knots->num_knots = 0;
    append(knots, quantized->model.input_min);
    for (size_t k = 1; k < grid->num_knots; ++k) {
        if (!append_cell(rescaled_to, quantized, knots, (int32_t)grid->input[k])) {
            return "a curve rises too steeply between neighbouring inputs";
        }
    }
    return knots->num_knots > HYST_MAX_KNOTS ? "the table would need more than 65535 knots" : NULL;
}

/// The chords of a divided cell may be off by twice what the undivided one's was: then half the error is
/// asked for.
static const char* find_knots(const model_t* rescaled_to, double table_error, quantized_t* quantized,
                              knots_t* knots)
{
    const double low = (double)quantized->model.input_min;
    const double high = (double)quantized->model.input_max;
    double asked = table_error;
    do {
        grid_t grid = grid_find(rescaled_to, GRID_OF_INTEGERS, low, high, asked);
        if (grid.num_knots == 0) {
            return "the table would need more than 65535 knots";
        }
        const char* fault = divide_grid(rescaled_to, quantized, &grid, knots);
        grid_free(&grid);
        if (fault != NULL) {
            return fault;
        }
        quantized->table_error = chords_error(rescaled_to, knots);
        asked *= 0.5;
    } while (quantized->table_error > table_error);
    return NULL;
}

double exact_nonhysteretic(const model_t* model, const quantized_t* quantized, int32_t input)
{
    const uint32_t stored_weight = quantized->cumulative_weight[model->num_plays];
    const double bottom = quantized_input(quantized, quantized->model.input_min);
    const double top = quantized_input(quantized, quantized->model.input_max);
    const double middle =
        0.5 * (curve_value(&model->descending, bottom) + curve_value(&model->ascending, top));
    const double unit = quantized->output_scale / (quantized->state_scale * unity(quantized));
    // What rounding takes from the total weight acts on states that lie about the middle.
    const double constant = (double)stored_weight * unit * (quantized->state_offset - middle) +
                            model_total_weight(model) * middle - quantized->output_offset;
    return (curve_value(&model->nonhysteretic, quantized_input(quantized, input)) + constant) /
           quantized->output_scale;
}

static void store_values(const model_t* model, const knots_t* knots, quantized_t* quantized)
{
    const uint32_t most = quantized->radius[0] <= UINT32_MAX / 2 ? 2 * quantized->radius[0] : UINT32_MAX;
    quantized->model.constant = nearest_integer(exact_nonhysteretic(model, quantized, knots->input[0]));
    for (size_t k = 0; k < knots->num_knots; ++k) {
        const double v = quantized_input(quantized, knots->input[k]);
        hyst_q31_knot_t* knot = &quantized->knot[k];
        knot->input = knots->input[k];
        const double descending = curve_value(&model->descending, v) - quantized->state_offset;
        const double ascending = curve_value(&model->ascending, v) - quantized->state_offset;
        knot->descending = (uint32_t)nearest_integer(descending / quantized->state_scale);
        knot->ascending = (uint32_t)nearest_integer(ascending / quantized->state_scale);
        // ascending - r <= descending + r in integers too.
        if (knot->ascending > knot->descending && knot->ascending - knot->descending > most) {
            knot->ascending = knot->descending + most;
        }
        knot->nonhysteretic =
            (uint32_t)(nearest_integer(exact_nonhysteretic(model, quantized, knots->input[k])) -
                       quantized->model.constant);
    }
}

/// rise * 2^bits / width, rounded up: the line then reaches the next knot's value.
static uint32_t slope_for(const quantized_t* quantized, uint32_t low, uint32_t high, uint32_t width)
{
    const uint64_t scaled = (uint64_t)(high - low) << (unsigned)quantized->bits;
    return (uint32_t)((scaled + width - 1) / width);
}

static void store_slopes(quantized_t* quantized)
{
    const unsigned bits = (unsigned)quantized->bits;
    const uint32_t word_max = UINT32_MAX >> (32 - bits);
    for (size_t k = 0; k + 1 < quantized->model.num_knots; ++k) {
        hyst_q31_knot_t* knot = &quantized->knot[k];
        uint32_t width = (uint32_t)knot[1].input - (uint32_t)knot->input;
        while (width <= word_max / 2) {
            width *= 2;
            ++knot->shift;
        }
        knot->ascending_slope = slope_for(quantized, knot->ascending, knot[1].ascending, width);
        knot->descending_slope = slope_for(quantized, knot->descending, knot[1].descending, width);
        knot->nonhysteretic_slope = slope_for(quantized, knot->nonhysteretic, knot[1].nonhysteretic, width);
        // Both were rounded up by less than one unit, so that one unit keeps the lines in order to the cell's
        // end.
        const uint64_t gap =
            (uint64_t)knot->descending + 2U * (uint64_t)quantized->radius[0] - knot->ascending;
        if (knot->ascending_slope > knot->descending_slope &&
            (uint64_t)(knot->ascending_slope - knot->descending_slope) * width > gap << bits) {
            ++knot->descending_slope;
        }
    }
}

static const char* store_table(const model_t* model, double table_error, quantized_t* quantized)
{
    model_t rescaled_to = rescaled_model(model, quantized);
    knots_t knots = {0};
    const char* fault = find_knots(&rescaled_to, table_error, quantized, &knots);
    model_free(&rescaled_to);
    if (fault == NULL) {
        quantized->knot = xcalloc(knots.num_knots, sizeof *quantized->knot);
        quantized->model.knot = quantized->knot;
        quantized->model.num_knots = (uint32_t)knots.num_knots;
        store_values(model, &knots, quantized);
        store_slopes(quantized);
    }
    free(knots.input);
    return fault;
}

static const char* fill(const model_t* model, double table_error, quantized_t* quantized)
{
    if (model->num_plays > HYST_MAX_PLAYS) {
        return "it has more than 4096 plays: compress it first";
    }
    quantized->model.format = HYST_MODEL_FORMAT;
    const char* fault = choose_input(model, quantized);
    if (fault != NULL) {
        return fault;
    }
    choose_state(model, quantized);
    choose_output(model, quantized);
    if (!isnormal(quantized->state_scale) || !isnormal(quantized->output_scale) ||
        !isfinite(quantized->state_offset) || !isfinite(quantized->output_offset)) {
        return "the model's numbers are too large or too small to be scaled to integers";
    }
    store_plays(model, quantized);
    fault = store_table(model, table_error, quantized);
    if (fault == NULL) {
        quantize_bound(model, quantized);
    }
    return fault;
}

const char* quantize(const model_t* model, quantized_bits_t bits, double table_error, quantized_t* quantized)
{
    *quantized = (quantized_t){.bits = bits};
    const char* fault = fill(model, table_error, quantized);
    if (fault != NULL) {
        quantized_free(quantized);
    }
    return fault;
}

void quantized_free(quantized_t* quantized)
{
    free(quantized->radius);
    free(quantized->cumulative_weight);
    free(quantized->cumulative_moment);
    free(quantized->knot);
    *quantized = (quantized_t){0};
}

static hyst_q15_knot_t narrow_knot(const hyst_q31_knot_t* knot)
{
    return (hyst_q15_knot_t){.input = (int16_t)knot->input,
                             .ascending = (uint16_t)knot->ascending,
                             .descending = (uint16_t)knot->descending,
                             .nonhysteretic = (uint16_t)knot->nonhysteretic,
                             .ascending_slope = (uint16_t)knot->ascending_slope,
                             .descending_slope = (uint16_t)knot->descending_slope,
                             .nonhysteretic_slope = (uint16_t)knot->nonhysteretic_slope,
                             .shift = (uint16_t)knot->shift};
}

narrowed_t narrowed_new(const quantized_t* quantized)
{
    const hyst_q31_model_t* wide = &quantized->model;
    narrowed_t narrowed = {.radius = xcalloc(wide->num_plays, sizeof(uint16_t)),
                           .cumulative_weight = xcalloc((size_t)wide->num_plays + 1, sizeof(uint16_t)),
                           .cumulative_moment = xcalloc((size_t)wide->num_plays + 1, sizeof(uint32_t)),
                           .knot = xcalloc(wide->num_knots, sizeof(hyst_q15_knot_t))};
    for (uint32_t j = 0; j < wide->num_plays; ++j) {
        narrowed.radius[j] = (uint16_t)wide->radius[j];
        narrowed.cumulative_weight[j + 1] = (uint16_t)wide->cumulative_weight[j + 1];
        narrowed.cumulative_moment[j + 1] = (uint32_t)wide->cumulative_moment[j + 1];
    }
    for (uint32_t k = 0; k < wide->num_knots; ++k) {
        narrowed.knot[k] = narrow_knot(&wide->knot[k]);
    }
    narrowed.model = (hyst_q15_model_t){.format = wide->format,
                                        .num_plays = wide->num_plays,
                                        .num_knots = wide->num_knots,
                                        .input_min = (int16_t)wide->input_min,
                                        .input_max = (int16_t)wide->input_max,
                                        .constant = (int32_t)wide->constant,
                                        .radius = narrowed.radius,
                                        .cumulative_weight = narrowed.cumulative_weight,
                                        .cumulative_moment = narrowed.cumulative_moment,
                                        .knot = narrowed.knot};
    return narrowed;
}

void narrowed_free(narrowed_t* narrowed)
{
    free(narrowed->radius);
    free(narrowed->cumulative_weight);
    free(narrowed->cumulative_moment);
    free(narrowed->knot);
    *narrowed = (narrowed_t){0};
}
