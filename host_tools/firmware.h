/// A model's firmware on the host: the numbers of the header that `hyst emit` makes by default, run by lib/'s
/// own code.
#ifndef HYST_HOST_FIRMWARE_H
#define HYST_HOST_FIRMWARE_H

#include "message.h"
#include "quantize.h"
#include "scalar.h"
#include "tabulate.h"

typedef struct {
    scalar_t scalar;
    const char* path;      ///< the model's, for messages; borrowed
    tabulated_t tabulated; ///< f32's numbers, else empty
    quantized_t quantized; ///< q31's and q15's numbers, else empty
} firmware_t;

/// OUTCOME_NUMERICAL with a message when the model cannot be put into the scalar.
outcome_t firmware_new(const model_t* model, const char* path, scalar_t scalar, firmware_t* firmware);
void firmware_free(firmware_t* firmware);

/// The model with the header's chords for its curves, still in double precision; as it is where the header
/// has no table.
model_t firmware_chords(const firmware_t* firmware, const model_t* model);

/// output[num_samples] in output units, through the header's conversions of inputs and outputs; START_MODEL
/// counts as negative saturation. OUTCOME_NUMERICAL with a message when lib/ refuses the header.
outcome_t firmware_run(const firmware_t* firmware, start_t start, const double* input, size_t num_samples,
                       double* output);

#endif
