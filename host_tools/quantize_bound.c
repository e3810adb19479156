#include "quantize_internal.h"
#include <float.h>
#include <math.h>

/// The steepest that a curve is within [low, high].
static double steepest(const curve_t* curve, double low, double high)
{
    double most = 0.0;
    switch (curve->type) {
    case CURVE_LINEAR:
        return fabs(curve->gain * curve->slope);
    case CURVE_TANH:
        return curve_slope(curve, fmin(fmax(-curve->shift / curve->slope, low), high));
    case CURVE_TABLE:
        // The first and last cell go on beyond the table.
        for (size_t i = 0; i + 1 < curve->num_knots; ++i) {
            if ((i == 0 || curve->x[i] <= high) && (i + 2 == curve->num_knots || curve->x[i + 1] >= low)) {
                most = fmax(most, (curve->y[i + 1] - curve->y[i]) / (curve->x[i + 1] - curve->x[i]));
            }
        }
        return most;
    }
    return most;
}

static double steepest_in_range(const model_t* model, which_curve_t which)
{
    return steepest(model_curve(model, which), model->input_min, model->input_max);
}

/// How far a stored knot lies from the curve, in units of what it is stored in.
static double deviation(const model_t* model, const quantized_t* quantized, const hyst_q31_knot_t* knot,
                        which_curve_t which)
{
    const double stored = (double)knot_value(knot, which);
    if (which == CURVE_OF_NONHYSTERETIC) {
        return fabs(stored + (double)quantized->model.constant -
                    exact_nonhysteretic(model, quantized, knot->input));
    }
    const double exact = curve_value(model_curve(model, which), quantized_input(quantized, knot->input));
    return fabs(stored - (exact - quantized->state_offset) / quantized->state_scale);
}

/// By how much the slope, rounded up, lifts the line above the chord of the stored knots, and half a unit for
/// rounding a value between them.
static double line_error(const quantized_t* quantized, const hyst_q31_knot_t* knot, which_curve_t which)
{
    const uint32_t rise = knot_value(&knot[1], which) - knot_value(knot, which);
    if (knot_slope(knot, which) == 0) {
        return 0.0;
    }
    const double width = ldexp((double)knot[1].input - (double)knot->input, (int)knot->shift);
    const double line_rise = ldexp((double)knot_slope(knot, which) * width, -(int)quantized->bits);
    return 0.5 + fmax(line_rise - (double)rise, 0.0);
}

/// The largest distance of stored curve values from the curve's chords, in units of what it is stored in.
/// Between two knots the chords are no further apart than there.
static double curve_error(const model_t* model, const quantized_t* quantized, which_curve_t which)
{
    const hyst_q31_knot_t* knot = quantized->knot;
    double largest = 0.0;
    for (uint32_t k = 0; k + 1 < quantized->model.num_knots; ++k) {
        const double ends = fmax(deviation(model, quantized, &knot[k], which),
                                 deviation(model, quantized, &knot[k + 1], which));
        largest = fmax(largest, ends + line_error(quantized, &knot[k], which));
    }
    return largest;
}

/// What rounding the radii and the running sums of the weights puts on the output. Summed by parts, and with
/// states no further apart than their radii, a running sum's error counts times the step to the next radius;
/// the last one's times the largest distance of the last play's state from the middle of the range of states.
static double plays_error(const model_t* model, const quantized_t* quantized)
{
    const double unit = quantized->output_scale / ldexp(quantized->state_scale, (int)quantized->bits);
    const double bottom =
        curve_value(&model->descending, quantized_input(quantized, quantized->model.input_min));
    const double top = curve_value(&model->ascending, quantized_input(quantized, quantized->model.input_max));
    double sum = 0.0;
    double error = 0.0;
    for (size_t j = 0; j < model->num_plays; ++j) {
        const double radius = model->radius[j];
        const bool last = j + 1 == model->num_plays;
        sum += model->weight[j];
        const double sum_error = fabs(unit * (double)quantized->cumulative_weight[j + 1] - sum);
        error += sum_error * (last ? fabs(0.5 * (top - bottom) - radius) : model->radius[j + 1] - radius);
        error += unit * (double)(quantized->cumulative_weight[j + 1] - quantized->cumulative_weight[j]) *
                 fabs(quantized->state_scale * (double)quantized->radius[j] - radius);
    }
    return error;
}

/// The roundings of double numbers on the way, also the reference's own, and, for q15, of the header's
/// conversions, which are in float.
static double arithmetic_error(const model_t* model, const quantized_t* quantized)
{
    const double v = fmax(fabs(model->input_min), fabs(model->input_max));
    double envelope = model->radius[model->num_plays - 1];
    double argument = 0.0;
    for (int i = 0; i < 2; ++i) {
        const curve_t* curve = model_curve(model, (which_curve_t)i);
        envelope +=
            fabs(curve->offset) + fabs(curve->gain) +
            fmax(fabs(curve_value(curve, model->input_min)), fabs(curve_value(curve, model->input_max)));
        argument = fmax(argument, v * steepest_in_range(model, (which_curve_t)i));
    }
    const double weight = model_total_weight(model);
    const double output =
        fabs(quantized->output_offset) + ldexp(quantized->output_scale, (int)quantized->bits);
    const double sums = (double)model->num_plays + 16.0;
    const double in_double =
        DBL_EPSILON * (sums * (weight * envelope + output) +
                       4.0 * (weight * argument + v * steepest_in_range(model, CURVE_OF_NONHYSTERETIC)));
    return in_double + weight * model_tolerance(model) +
           (quantized->bits == QUANTIZED_Q15 ? 2.0 * (double)FLT_EPSILON * output : 0.0);
}

void quantize_bound(const model_t* model, quantized_t* quantized)
{
    const double unit = quantized->output_scale / ldexp(quantized->state_scale, (int)quantized->bits);
    const double stored_weight = unit * (double)quantized->cumulative_weight[model->num_plays];
    const double weight = fmax(model_total_weight(model), stored_weight);
    const double envelope_slope =
        fmax(steepest_in_range(model, CURVE_OF_ASCENDING), steepest_in_range(model, CURVE_OF_DESCENDING));
    const double envelope = fmax(curve_error(model, quantized, CURVE_OF_ASCENDING),
                                 curve_error(model, quantized, CURVE_OF_DESCENDING));
    // A rounded input is off by half a unit; by 1/64 more when the header's conversion rounds in float.
    const double input = (0.5 + 1.0 / 64.0) * quantized->input_scale;
    quantized->quantization_error =
        input * (weight * envelope_slope + steepest_in_range(model, CURVE_OF_NONHYSTERETIC)) +
        weight * quantized->state_scale * envelope + plays_error(model, quantized) +
        quantized->output_scale * (0.5 + curve_error(model, quantized, CURVE_OF_NONHYSTERETIC)) +
        arithmetic_error(model, quantized);
    // The alternation is about an integer and shrinks in whole units: it keeps within two units of the exact
    // one, and the middle of a strip is rounded.
    const double middle = model->input_min + 0.5 * (model->input_max - model->input_min);
    const int64_t stored_middle =
        quantized->model.input_min + ((int64_t)quantized->model.input_max - quantized->model.input_min) / 2;
    const double off_middle = fabs(quantized_input(quantized, (int32_t)stored_middle) - middle);
    quantized->demagnetised_error =
        quantized->quantization_error +
        weight * (envelope_slope * (2.0 * quantized->input_scale + off_middle) + quantized->state_scale);
}
