#include "reference.h"
#include <math.h>
#include <stdlib.h>

/// The state that the next input v leaves play j in, Eq. (6).
static double moved(const reference_t* reference, size_t j, double v, double ascending, double descending)
{
    const double w = reference->memory[j];
    const double r = reference->model->radius[j];
    if (v > reference->input) {
        return ascending - r > w ? ascending - r : w;
    }
    if (v < reference->input) {
        return descending + r < w ? descending + r : w;
    }
    return w;
}

/// The output that the next input v would give, Eq. (8); does not decrease with v.
static double next_output(const reference_t* reference, double v)
{
    const model_t* model = reference->model;
    const double ascending = curve_value(&model->ascending, v);
    const double descending = curve_value(&model->descending, v);
    double sum = curve_value(&model->nonhysteretic, v);
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j] * moved(reference, j, v, ascending, descending);
    }
    return sum;
}

double reference_output(const reference_t* reference)
{
    return next_output(reference, reference->input);
}

double reference_step(reference_t* reference, double input)
{
    const model_t* model = reference->model;
    const double ascending = curve_value(&model->ascending, input);
    const double descending = curve_value(&model->descending, input);
    for (size_t j = 0; j < model->num_plays; ++j) {
        reference->memory[j] = moved(reference, j, input, ascending, descending);
    }
    reference->input = input;
    return reference_output(reference);
}

/// The state of a play with this radius after an alternation about `middle` that decayed from the whole
/// range: it stops moving at the amplitude A where ascending(middle + A) - descending(middle - A) = 2 r, in
/// the strip's middle.
static double demagnetised_state(const model_t* model, double middle, double half_range, double radius)
{
    double low = 0.0;
    double high = half_range;
    // 200 halvings reach below the last bit of the amplitude even where it is nearly 0.
    for (int i = 0; i < 200 && low < high; ++i) {
        const double amplitude = low + 0.5 * (high - low);
        const double width = curve_value(&model->ascending, middle + amplitude) -
                             curve_value(&model->descending, middle - amplitude);
        if (amplitude <= low || amplitude >= high) {
            break;
        }
        if (width < 2.0 * radius) {
            low = amplitude;
        } else {
            high = amplitude;
        }
    }
    return 0.5 *
           (curve_value(&model->ascending, middle + high) + curve_value(&model->descending, middle - high));
}

static void start_demagnetised(reference_t* reference)
{
    const model_t* model = reference->model;
    const double half_range = 0.5 * (model->input_max - model->input_min);
    reference->input = model->input_min + half_range;
    for (size_t j = 0; j < model->num_plays; ++j) {
        reference->memory[j] = demagnetised_state(model, reference->input, half_range, model->radius[j]);
    }
}

static void start_initial(reference_t* reference)
{
    const model_t* model = reference->model;
    double low;
    double high;
    (void)model_initial_inputs(model, &low, &high);
    reference->input = 0.5 * (low + high);
    for (size_t j = 0; j < model->num_plays; ++j) {
        reference->memory[j] = model->initial[j];
    }
}

/// Saturation puts every play on the envelope of the direction it was reached in.
static void start_saturated(reference_t* reference, double input, const curve_t* envelope, double sign)
{
    reference->input = input;
    for (size_t j = 0; j < reference->model->num_plays; ++j) {
        reference->memory[j] = curve_value(envelope, input) + sign * reference->model->radius[j];
    }
}

reference_t reference_start(const model_t* model, start_t start)
{
    reference_t reference = {.model = model, .memory = xcalloc(model->num_plays, sizeof(double))};
    if (start == START_MODEL && model->initial != NULL) {
        start_initial(&reference);
    } else if (start == START_DEMAGNETISED) {
        start_demagnetised(&reference);
    } else if (start == START_POSITIVE_SATURATION) {
        start_saturated(&reference, model->input_max, &model->ascending, -1.0);
    } else {
        start_saturated(&reference, model->input_min, &model->descending, 1.0);
    }
    return reference;
}

reference_t reference_new(const model_t* model, start_t start, double first_input)
{
    reference_t reference = reference_start(model, start);
    reference_step(&reference, first_input);
    return reference;
}

void reference_free(reference_t* reference)
{
    free(reference->memory);
    *reference = (reference_t){0};
}

/// The input between `from` (the present one) and `to` that gives `wanted`, which lies between their outputs:
/// the nearest to `from` on a flat stretch.
static double solve(const reference_t* reference, double wanted, double from, double to)
{
    const bool rising = to > from;
    // 200 halvings reach below the last bit of the interval even where it contains 0.
    for (int i = 0; i < 200; ++i) {
        const double middle = from + 0.5 * (to - from);
        if (!(rising ? middle > from && middle < to : middle < from && middle > to)) {
            break;
        }
        const double output = next_output(reference, middle);
        if (rising ? output >= wanted : output <= wanted) {
            to = middle;
        } else {
            from = middle;
        }
    }
    return to;
}

reference_inverse_t reference_inverse(const reference_t* reference, double wanted)
{
    const model_t* model = reference->model;
    const double start = fmin(fmax(reference->input, model->input_min), model->input_max);
    const double present = next_output(reference, start);
    reference_inverse_t result = {
        .input = start,
        .reachable_min = next_output(reference, model->input_min),
        .reachable_max = next_output(reference, model->input_max),
    };
    // An end of the reachable outputs that was written with 15 digits and read back is still reachable.
    const double rounding = 1e-14 * fmax(fabs(result.reachable_min), fabs(result.reachable_max));
    result.clamped =
        !(wanted >= result.reachable_min - rounding && wanted <= result.reachable_max + rounding);
    if (wanted > present && result.reachable_max > present) {
        result.input = solve(reference, fmin(wanted, result.reachable_max), start, model->input_max);
    } else if (wanted < present && result.reachable_min < present) {
        result.input = solve(reference, fmax(wanted, result.reachable_min), start, model->input_min);
    }
    return result;
}

void reference_run(const model_t* model, start_t start, const double* input, size_t num_samples,
                   double* output)
{
    if (num_samples == 0) {
        return;
    }
    reference_t reference = reference_new(model, start, input[0]);
    output[0] = reference_output(&reference);
    for (size_t i = 1; i < num_samples; ++i) {
        output[i] = reference_step(&reference, input[i]);
    }
    reference_free(&reference);
}
