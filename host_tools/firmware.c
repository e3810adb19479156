#include "firmware.h"

#include "input_file.h"
#include <math.h>
#include <stdlib.h>

outcome_t firmware_new(const model_t* model, const char* path, scalar_t scalar, firmware_t* firmware)
{
    *firmware = (firmware_t){.scalar = scalar, .path = path};
    const double table_error = tabulate_default_error(model);
    const char* fault = scalar == SCALAR_F32
                            ? tabulate(model, table_error, &firmware->tabulated)
                            : quantize(model, scalar == SCALAR_Q31 ? QUANTIZED_Q31 : QUANTIZED_Q15,
                                       table_error, &firmware->quantized);
    if (fault != NULL) {
        return message_error(OUTCOME_NUMERICAL, (location_t){.file = input_name(path)},
                             "cannot be put into %s with a table error of %.9g: %s", scalar_name(scalar),
                             table_error, fault);
    }
    return OUTCOME_OK;
}

void firmware_free(firmware_t* firmware)
{
    tabulated_free(&firmware->tabulated);
    quantized_free(&firmware->quantized);
}

static size_t num_knots(const firmware_t* firmware)
{
    return firmware->scalar == SCALAR_F32 ? firmware->tabulated.model.num_knots
                                          : firmware->quantized.model.num_knots;
}

/// Input units.
static double knot_input(const firmware_t* firmware, size_t k)
{
    const quantized_t* quantized = &firmware->quantized;
    return firmware->scalar == SCALAR_F32
               ? (double)firmware->tabulated.model.knot[k].input
               : quantized->input_offset + quantized->input_scale * (double)quantized->knot[k].input;
}

static void put_chords(const firmware_t* firmware, curve_t* curve)
{
    const size_t count = num_knots(firmware);
    double* x = xmalloc(count * sizeof *x);
    double* y = xmalloc(count * sizeof *y);
    for (size_t k = 0; k < count; k++) {
        x[k] = knot_input(firmware, k);
        y[k] = curve_value(curve, x[k]);
    }
    curve_free(curve);
    *curve = curve_table(x, y, count);
    free(x);
    free(y);
}

model_t firmware_chords(const firmware_t* firmware, const model_t* model)
{
    model_t copy = model_copy(model);
    if (num_knots(firmware) > 0) {
        put_chords(firmware, &copy.ascending);
        put_chords(firmware, &copy.descending);
        put_chords(firmware, &copy.nonhysteretic);
    }
    return copy;
}

static hyst_start_t firmware_start(start_t start)
{
    switch (start) {
    case START_POSITIVE_SATURATION:
        return HYST_START_POSITIVE_SATURATION;
    case START_DEMAGNETISED:
        return HYST_START_DEMAGNETISED;
    case START_NEGATIVE_SATURATION:
    case START_MODEL:
        break;
    }
    return HYST_START_NEGATIVE_SATURATION;
}

/// What the header's conversions of inputs compute, in the type they compute in.
static float f32_input(const quantized_t* none, double input)
{
    (void)none;
    return (float)input;
}

static double f32_output(const quantized_t* none, float output)
{
    (void)none;
    return (double)output;
}

/// Half away from 0, by truncation: as headers round.
static int32_t q31_input(const quantized_t* scales, double input)
{
    const double integer = (input - scales->input_offset) / scales->input_scale;
    const double held = fmin(fmax(integer, (double)INT32_MIN), (double)INT32_MAX);
    return (int32_t)fmin(held < 0 ? held - 0.5 : held + 0.5, (double)INT32_MAX);
}

static double q31_output(const quantized_t* scales, int32_t output)
{
    return scales->output_offset + scales->output_scale * (double)output;
}

static int16_t q15_input(const quantized_t* scales, double input)
{
    const float integer = ((float)input - (float)scales->input_offset) / (float)scales->input_scale;
    const float held = fminf(fmaxf(integer, (float)INT16_MIN), (float)INT16_MAX);
    return (int16_t)fminf(held < 0 ? held - 0.5F : held + 0.5F, (float)INT16_MAX);
}

static double q15_output(const quantized_t* scales, int16_t output)
{
    return (double)((float)scales->output_offset + (float)scales->output_scale * (float)output);
}

/// The run is the same for all scalars: this writes it once for each.
#define DEFINE_RUN(type)                                                                                     \
    static hyst_status_t run_##type(const hyst_##type##_model_t* model, const quantized_t* scales,           \
                                    hyst_start_t start, const double* input, size_t num_samples,             \
                                    double* output)                                                          \
    {                                                                                                        \
        hyst_##type##_segment_t* memory = xcalloc(model->num_plays, sizeof *memory);                         \
        hyst_##type##_state_t state;                                                                         \
        const hyst_status_t status = hyst_##type##_init(model, &state, memory, model->num_plays);            \
        for (size_t t = 0; status == HYST_STATUS_OK && t < num_samples; t++) {                               \
            output[t] = type##_output(                                                                       \
                scales, t == 0 ? hyst_##type##_reset(model, &state, start, type##_input(scales, input[t]))   \
                               : hyst_##type##_step(model, &state, type##_input(scales, input[t])));         \
        }                                                                                                    \
        free(memory);                                                                                        \
        return status;                                                                                       \
    }

DEFINE_RUN(f32)
DEFINE_RUN(q31)
DEFINE_RUN(q15)

outcome_t firmware_run(const firmware_t* firmware, start_t start, const double* input, size_t num_samples,
                       double* output)
{
    const hyst_start_t from = firmware_start(start);
    const quantized_t* quantized = &firmware->quantized;
    hyst_status_t status;
    if (firmware->scalar == SCALAR_F32) {
        status = run_f32(&firmware->tabulated.model, NULL, from, input, num_samples, output);
    } else if (firmware->scalar == SCALAR_Q31) {
        status = run_q31(&quantized->model, quantized, from, input, num_samples, output);
    } else {
        narrowed_t narrowed = narrowed_new(quantized);
        status = run_q15(&narrowed.model, quantized, from, input, num_samples, output);
        narrowed_free(&narrowed);
    }
    return status == HYST_STATUS_OK
               ? OUTCOME_OK
               : message_error(OUTCOME_NUMERICAL, (location_t){.file = input_name(firmware->path)},
                               "the model has no valid form in %s: %s", scalar_name(firmware->scalar),
                               hyst_status_text(status));
}
