/// What the two halves of quantize share: choosing the numbers and bounding their error.
#ifndef HYST_HOST_QUANTIZE_INTERNAL_H
#define HYST_HOST_QUANTIZE_INTERNAL_H

#include "quantize.h"

enum { NUM_CURVES = 3 };
/// The curves in the order in which they are stored in a knot.
typedef enum { CURVE_OF_ASCENDING, CURVE_OF_DESCENDING, CURVE_OF_NONHYSTERETIC } which_curve_t;

const curve_t* model_curve(const model_t* model, which_curve_t which);
double model_total_weight(const model_t* model);

/// In input units.
double quantized_input(const quantized_t* quantized, int32_t input);
/// A stored value or slope.
uint32_t knot_value(const hyst_q31_knot_t* knot, which_curve_t which);
uint32_t knot_slope(const hyst_q31_knot_t* knot, which_curve_t which);

/// What the stored non-hysteretic value stands for, before rounding: D at this input and all constants, in
/// units of the output's integers.
double exact_nonhysteretic(const model_t* model, const quantized_t* quantized, int32_t input);

/// Fills in quantization_error and demagnetised_error.
void quantize_bound(const model_t* model, quantized_t* quantized);

#endif
