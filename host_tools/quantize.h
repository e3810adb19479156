/// From the model in double precision to the integers that fixed-point firmware runs, and what that costs in
/// accuracy. The formats and the derivation of the bounds are in lib/DESIGN.md, "Fixed point".
#ifndef HYST_HOST_QUANTIZE_H
#define HYST_HOST_QUANTIZE_H

#include "hyst/hyst_q15.h"
#include "hyst/hyst_q31.h"
#include "model.h"

/// How many bits a word of the type has.
typedef enum { QUANTIZED_Q15 = 16, QUANTIZED_Q31 = 32 } quantized_bits_t;

/// A fixed-point model of either type, in the wider one's numbers.
typedef struct {
    quantized_bits_t bits;
    hyst_q31_model_t model;             ///< points into the arrays below
    uint32_t* radius;                   ///< [num_plays], owned, like the others
    uint32_t* cumulative_weight;        ///< [num_plays + 1]
    uint64_t* cumulative_moment;        ///< [num_plays + 1]
    hyst_q31_knot_t* knot;              ///< [num_knots]
    double input_scale, input_offset;   ///< input units = offset + scale * integer; floats for q15
    double output_scale, output_offset; ///< likewise
    double state_scale, state_offset;   ///< envelope units
    double table_error;                 ///< what the chords can put on the output, output units
    double quantization_error;          ///< what integers can put on it besides, from either saturation
    double demagnetised_error;          ///< likewise from the demagnetised start
} quantized_t;

/// Chooses formats and a grid of knots whose chords put at most `table_error` [output units, > 0] on the
/// output. For every history of inputs within the model's range, each rounded to the nearest integer,
///   |fixed-point output - reference output| <= table_error + quantization_error   (those of the result).
/// Returns NULL, or why there is no such model; *quantized is then empty. What lib/ thinks of the model is
/// for hyst_q31_init or hyst_q15_init to say.
const char* quantize(const model_t* model, quantized_bits_t bits, double table_error, quantized_t* quantized);
void quantized_free(quantized_t* quantized);

/// The same model in q15's own arrays. quantized->bits is QUANTIZED_Q15; the arrays are owned by the result.
typedef struct {
    hyst_q15_model_t model;
    uint16_t* radius;
    uint16_t* cumulative_weight;
    uint32_t* cumulative_moment;
    hyst_q15_knot_t* knot;
} narrowed_t;
narrowed_t narrowed_new(const quantized_t* quantized);
void narrowed_free(narrowed_t* narrowed);

/// The integer nearest to x, which lies within int64_t.
int64_t nearest_integer(double x);

#endif
