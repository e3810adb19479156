#include "float_error.h"
#include <float.h>
#include <math.h>

/// Sizes of one stored curve and its deviations from the exact one.
typedef struct {
    double deviation; ///< largest |stored - exact| at a knot, and what the range's ends are cut short by
    double magnitude; ///< largest |stored|
    double rise;      ///< largest rise within one cell
} sizes_t;

typedef enum { ASCENDING, DESCENDING, NONHYSTERETIC } which_t;

static const double unit_roundoff = (double)FLT_EPSILON / 2.0;

static double value_at(const hyst_f32_knot_t* knot, which_t which)
{
    if (which == ASCENDING) {
        return (double)knot->ascending;
    }
    return (double)(which == DESCENDING ? knot->descending : knot->nonhysteretic);
}

static sizes_t table_sizes(const prepared_t* prepared, const hyst_f32_model_t* stored, which_t which)
{
    const model_t* model = &prepared->model;
    const curve_t* curve[] = {&model->ascending, &model->descending, &model->nonhysteretic};
    sizes_t sizes = {0.0, 0.0, 0.0};
    for (uint32_t k = 0; k < stored->num_knots; ++k) {
        const double value = value_at(&stored->knot[k], which);
        const double exact = curve_value(curve[which], (double)stored->knot[k].input);
        sizes.deviation = fmax(sizes.deviation, fabs(value - exact));
        sizes.magnitude = fmax(sizes.magnitude, fabs(value));
        if (k > 0) {
            sizes.rise = fmax(sizes.rise, value - value_at(&stored->knot[k - 1], which));
        }
    }
    const double low = (double)stored->input_min;
    const double high = (double)stored->input_max;
    sizes.deviation += fmax(curve_value(curve[which], low) - curve_value(curve[which], model->input_min),
                            curve_value(curve[which], model->input_max) - curve_value(curve[which], high));
    return sizes;
}

/// A straight line through 0 with this slope, stored as `stored_slope`.
static sizes_t line_sizes(const prepared_t* prepared, const hyst_f32_model_t* stored, double slope,
                          double stored_slope)
{
    const double low = (double)stored->input_min;
    const double high = (double)stored->input_max;
    const double largest = fmax(fabs(low), fabs(high));
    const double cut = fmax(low - prepared->model.input_min, prepared->model.input_max - high);
    return (sizes_t){.deviation = slope * cut + fabs(stored_slope - slope) * largest,
                     .magnitude = stored_slope * largest};
}

/// How far a computed curve value is off: a stored slope has two roundings of differences and one of its own
/// in it, v - x and the product round once each, all of at most the rise, and the sum rounds once. Lowering
/// the slope until the line stays below the next value takes off another unit of the slope and of the sum.
static double computed(sizes_t sizes)
{
    return sizes.deviation + unit_roundoff * (7.0 * sizes.rise + 2.0 * sizes.magnitude) + (double)FLT_MIN;
}

static sizes_t larger(sizes_t a, sizes_t b)
{
    return (sizes_t){fmax(a.deviation, b.deviation), fmax(a.magnitude, b.magnitude), fmax(a.rise, b.rise)};
}

/// A segment's sum comes from the next one out, N of them at most. Each adds: x, x - opening, the product and
/// the two loadings' sum and difference, 5 u of slope_j opening_{j+1}, the segments' j all different; the end
/// that it counts from and the envelope there, 2 u of the sum of all magnitudes. What rounding moved the
/// stored loading curve by, (N + 4) u of its end, enters with alternating signs at openings that shrink, so
/// no more than twice its variation. A sum over no segment: product, moment and difference, 3 u of all
/// magnitudes.
double float_error_of_sums(const hyst_f32_model_t* stored, double magnitude)
{
    const double num_plays = (double)stored->num_plays;
    const hyst_f32_play_t* play = stored->play;
    const hyst_f32_play_t* last = &play[stored->num_plays - 1];
    double lines = 0.0;
    for (uint32_t j = 0; j < stored->num_plays; ++j) {
        const uint32_t next = j + 1 < stored->num_plays ? j + 1 : j;
        lines += (double)play[j].slope * (double)play[next].opening;
    }
    const double all = (double)last->slope * (magnitude + (double)last->opening);
    const double curve = 4.0 * (num_plays + 4.0) * (double)last->loading;
    return unit_roundoff * ((2.0 * num_plays + 3.0) * all + 5.0 * lines + curve) +
           (8.0 * num_plays + 8.0) * (double)FLT_MIN;
}

double float_error(const prepared_t* prepared, const hyst_f32_model_t* stored, const float* radius,
                   const float* weight)
{
    const model_t* model = &prepared->model;
    sizes_t envelope;
    sizes_t nonhysteretic;
    if (prepared->classical) {
        envelope = line_sizes(prepared, stored, 1.0, 1.0);
        nonhysteretic =
            line_sizes(prepared, stored, model->nonhysteretic.slope, (double)stored->nonhysteretic_slope);
    } else {
        envelope =
            larger(table_sizes(prepared, stored, ASCENDING), table_sizes(prepared, stored, DESCENDING));
        nonhysteretic = table_sizes(prepared, stored, NONHYSTERETIC);
    }
    double error = 0.0;
    double magnitude = 0.0;
    // A state is a maximum and minimum of pushed envelopes, so errors do not add up over time: it is off by
    // the envelope's error and its radius'.
    for (size_t j = 0; j < model->num_plays; ++j) {
        const double reach = envelope.magnitude + (double)radius[j];
        const double state = computed(envelope) + fabs((double)radius[j] - model->radius[j]);
        error += (double)weight[j] * state + fabs((double)weight[j] - model->weight[j]) * reach;
        magnitude += (double)weight[j] * reach;
    }
    error += float_error_of_sums(stored, envelope.magnitude);
    // The constant plus D, and that plus the plays.
    const double offset = fabs((double)stored->constant) + nonhysteretic.magnitude;
    error += unit_roundoff * (magnitude + 2.0 * offset);
    error += fabs((double)stored->constant - prepared->constant) + computed(nonhysteretic);
    // Second-order terms: 2 (num_plays + 4) roundings are below 6e-4 of a term for HYST_MAX_PLAYS plays.
    return 1.001 * error;
}
