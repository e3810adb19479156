#include "c_text.h"
#include "emit_c.h"
#include <inttypes.h>
#include <stdlib.h>

/// What the two types' headers differ in. Sizes in bytes, as the structs lay out on a target with 32-bit
/// pointers.
typedef struct {
    const char* scalar;
    const char* value_type; ///< inputs and outputs
    const char* real_type;  ///< exact enough for their conversion
    const char* word_type;
    const char* sum_type;
    const char* word_suffix;
    const char* sum_suffix;
    const char* value_min;
    const char* value_max;
    size_t model_bytes, state_bytes, segment_bytes, knot_bytes, value_bytes, sum_bytes;
} format_t;

enum { GOLDEN_BYTES = 20 };

static const format_t q31 = {"q31", "int32_t", "double",    "uint32_t",  "uint64_t",
                             "U",   "ULL",     "INT32_MIN", "INT32_MAX", 48,
                             32,    16,        32,          4,           8};
static const format_t q15 = {"q15",       "int16_t", "float", "uint16_t", "uint32_t", "U", "U", "INT16_MIN",
                             "INT16_MAX", 36,        24,      12,         16,         2,   4};

typedef struct {
    const writer_t* writer;
    const format_t* format;
    const quantized_t* from;
} fixed_t;

/// A number of the type that converts inputs and outputs.
static void put_real(const fixed_t* fixed, const char* name, double value, const char* comment)
{
    char text[C_NUMBER_SIZE];
    if (fixed->from->bits == QUANTIZED_Q15) {
        c_float((float)value, text);
    } else {
        c_double(value, text);
    }
    const bool is_negative = text[0] == '-';
    fprintf(fixed->writer->stream, "#define %s_%s %s%s%s /* %s */\n", fixed->writer->macro, name,
            is_negative ? "(" : "", text, is_negative ? ")" : "", comment);
}

static void put_scales(const fixed_t* fixed)
{
    const quantized_t* from = fixed->from;
    put_real(fixed, "INPUT_SCALE", from->input_scale, "input units per integer");
    put_real(fixed, "INPUT_OFFSET", from->input_offset, "input units at the integer 0");
    put_real(fixed, "OUTPUT_SCALE", from->output_scale, "output units per integer");
    put_real(fixed, "OUTPUT_OFFSET", from->output_offset, "output units at the integer 0");
    put_real(fixed, "INPUT_MIN", from->input_offset + from->input_scale * (double)from->model.input_min,
             "input units");
    put_real(fixed, "INPUT_MAX", from->input_offset + from->input_scale * (double)from->model.input_max,
             "input units");
}

static void put_sizes(const fixed_t* fixed)
{
    const format_t* format = fixed->format;
    const size_t num_plays = fixed->from->model.num_plays;
    const size_t num_knots = fixed->from->model.num_knots;
    const size_t play_arrays =
        format->value_bytes * (2 * num_plays + 1) + format->sum_bytes * (num_plays + 1);
    put_count(fixed->writer, "NUM_PLAYS", num_plays, "play operators");
    put_count(fixed->writer, "NUM_KNOTS", num_knots, "knots of the table of curves");
    put_count(fixed->writer, "RAM_BYTES", format->state_bytes + format->segment_bytes * num_plays,
              "state and memory, 32-bit target");
    put_count(fixed->writer, "FLASH_BYTES",
              format->model_bytes + play_arrays + format->knot_bytes * num_knots,
              "model and arrays, 32-bit target");
    put_count(fixed->writer, "GOLDEN_FLASH_BYTES",
              GOLDEN_BYTES + 4 * format->value_bytes * (size_t)GOLDEN_STEPS,
              "golden vectors, only where they are used");
}

static void put_errors(const fixed_t* fixed)
{
    const quantized_t* from = fixed->from;
    const json_t* identification = fixed->writer->from->model->identification;
    const json_t* compression =
        json_object_get(json_object_get(identification, "compression"), "error_bound");
    put_bound(fixed->writer, "TABLE_ERROR", from->table_error,
              "output units: bound on what the tables change");
    put_bound(fixed->writer, "QUANTIZATION_ERROR", from->quantization_error,
              "output units: bound on what integers change, inputs rounded to nearest");
    put_bound(fixed->writer, "DEMAGNETISED_ERROR", from->demagnetised_error,
              "output units: instead of it, after a demagnetised start");
    put_known_errors(fixed->writer);
    put_bound(fixed->writer, "TOTAL_ERROR",
              from->table_error + from->quantization_error + json_number_value(compression),
              "output units: bound on the sum, against the model before compression");
}

static void put_conversions(const fixed_t* fixed)
{
    const char* symbol = fixed->writer->symbol;
    const char* macro = fixed->writer->macro;
    const format_t* format = fixed->format;
    FILE* stream = fixed->writer->stream;
    fprintf(stream,
            "/* From input units to the nearest integer; what no integer stands for becomes the nearest one "
            "that is\n"
            " * out of range, and so does NaN. The same for outputs asked of the inverse; and an output in "
            "its unit. */\n"
            "static inline %s %s_nearest(%s integer)\n"
            "{\n"
            "    if (!(integer > (%s)%s)) {\n"
            "        return %s;\n"
            "    }\n"
            "    if (!(integer < (%s)%s)) {\n"
            "        return %s;\n"
            "    }\n"
            "    return (%s)(integer < 0 ? integer - (%s)0.5 : integer + (%s)0.5);\n"
            "}\n",
            format->value_type, symbol, format->real_type, format->real_type, format->value_min,
            format->value_min, format->real_type, format->value_max, format->value_max, format->value_type,
            format->real_type, format->real_type);
    fprintf(stream,
            "static inline %s %s_input_from_units(%s input)\n{\n"
            "    return %s_nearest((input - %s_INPUT_OFFSET) / %s_INPUT_SCALE);\n}\n"
            "static inline %s %s_output_from_units(%s output)\n{\n"
            "    return %s_nearest((output - %s_OUTPUT_OFFSET) / %s_OUTPUT_SCALE);\n}\n",
            format->value_type, symbol, format->real_type, symbol, macro, macro, format->value_type, symbol,
            format->real_type, symbol, macro, macro);
    fprintf(stream,
            "static inline %s %s_input_to_units(%s input)\n{\n"
            "    return %s_INPUT_OFFSET + %s_INPUT_SCALE * (%s)input;\n}\n"
            "static inline %s %s_output_to_units(%s output)\n{\n"
            "    return %s_OUTPUT_OFFSET + %s_OUTPUT_SCALE * (%s)output;\n}\n\n",
            format->real_type, symbol, format->value_type, macro, macro, format->real_type, format->real_type,
            symbol, format->value_type, macro, macro, format->real_type);
}

static void put_words(const fixed_t* fixed, const char* name, const uint32_t* word, size_t count)
{
    FILE* stream = fixed->writer->stream;
    fprintf(stream, "static const %s %s_%s[] = {", fixed->format->word_type, fixed->writer->symbol, name);
    for (size_t i = 0; i < count; ++i) {
        fprintf(stream, "%s%" PRIu32 "%s,", i % 8 == 0 ? "\n    " : " ", word[i], fixed->format->word_suffix);
    }
    fputs("\n};\n", stream);
}

static void put_moments(const fixed_t* fixed)
{
    const hyst_q31_model_t* model = &fixed->from->model;
    FILE* stream = fixed->writer->stream;
    fprintf(stream, "static const %s %s_cumulative_moment[] = {", fixed->format->sum_type,
            fixed->writer->symbol);
    for (size_t i = 0; i <= model->num_plays; ++i) {
        fprintf(stream, "%s%" PRIu64 "%s,", i % 4 == 0 ? "\n    " : " ", model->cumulative_moment[i],
                fixed->format->sum_suffix);
    }
    fputs("\n};\n", stream);
}

static void put_knots(const fixed_t* fixed)
{
    FILE* stream = fixed->writer->stream;
    fprintf(stream, "static const hyst_%s_knot_t %s_knot[] = {\n", fixed->format->scalar,
            fixed->writer->symbol);
    for (uint32_t k = 0; k < fixed->from->model.num_knots; ++k) {
        const hyst_q31_knot_t* knot = &fixed->from->knot[k];
        fprintf(stream,
                "    {.input = %" PRId32 ", .ascending = %" PRIu32 "U, .descending = %" PRIu32
                "U, .nonhysteretic = %" PRIu32 "U,\n"
                "     .ascending_slope = %" PRIu32 "U, .descending_slope = %" PRIu32
                "U, .nonhysteretic_slope = %" PRIu32 "U, .shift = %" PRIu32 "U},\n",
                knot->input, knot->ascending, knot->descending, knot->nonhysteretic, knot->ascending_slope,
                knot->descending_slope, knot->nonhysteretic_slope, knot->shift);
    }
    fputs("};\n\n", stream);
}

static void put_arrays(const fixed_t* fixed)
{
    const hyst_q31_model_t* model = &fixed->from->model;
    fprintf(fixed->writer->stream, "#define %s_NUM_SUMS (%s_NUM_PLAYS + 1U)\n", fixed->writer->macro,
            fixed->writer->macro);
    put_array_comment(fixed->writer, "radii, state integers", "", "NUM_PLAYS");
    put_words(fixed, "radius", model->radius, model->num_plays);
    put_array_comment(fixed->writer, "sums of weights, output integers per state integer times 2^bits", "",
                      "NUM_SUMS");
    put_words(fixed, "cumulative_weight", model->cumulative_weight, (size_t)model->num_plays + 1);
    put_array_comment(fixed->writer, "sums of weight times radius", "", "NUM_SUMS");
    put_moments(fixed);
    put_array_comment(fixed->writer, "curves over the input, integers", "", "NUM_KNOTS");
    put_knots(fixed);
}

static void put_model(const fixed_t* fixed)
{
    const hyst_q31_model_t* model = &fixed->from->model;
    const char* symbol = fixed->writer->symbol;
    fprintf(fixed->writer->stream,
            "static const hyst_%s_model_t %s_model = {\n"
            "    .format = %" PRIu32 "U,\n"
            "    .num_plays = %s_NUM_PLAYS,\n"
            "    .num_knots = %s_NUM_KNOTS,\n"
            "    .input_min = %" PRId32 ",\n"
            "    .input_max = %" PRId32 ",\n"
            "    .constant = %" PRId64 "%s,\n"
            "    .radius = %s_radius,\n"
            "    .cumulative_weight = %s_cumulative_weight,\n"
            "    .cumulative_moment = %s_cumulative_moment,\n"
            "    .knot = %s_knot,\n"
            "};\n\n",
            fixed->format->scalar, symbol, model->format, fixed->writer->macro, fixed->writer->macro,
            model->input_min, model->input_max, model->constant,
            fixed->from->bits == QUANTIZED_Q31 ? "LL" : "", symbol, symbol, symbol, symbol);
}

static void put_integer(FILE* stream, const void* vector, size_t i)
{
    const int32_t value = ((const int32_t*)vector)[i];
    // The least integer has no literal: its digits alone are too large for its type.
    fprintf(stream, value == INT32_MIN ? "(%" PRId32 " - 1)" : "%" PRId32,
            value == INT32_MIN ? value + 1 : value);
}

void emit_q(FILE* stream, const emission_t* emission, const quantized_t* quantized, const golden_q_t* golden)
{
    const format_t* format = quantized->bits == QUANTIZED_Q31 ? &q31 : &q15;
    char* macro = c_symbol_upper(emission->symbol);
    const writer_t writer = {stream, emission, emission->symbol, macro, format->scalar, format->value_type};
    const fixed_t fixed = {&writer, format, quantized};
    const golden_text_t vectors = {format->value_type,
                                   "integers",
                                   "",
                                   {golden->input, golden->output, golden->wanted, golden->inverse},
                                   put_integer};
    const array_length_t arrays[] = {{"radius", "NUM_PLAYS"},
                                     {"cumulative_weight", "NUM_SUMS"},
                                     {"cumulative_moment", "NUM_SUMS"},
                                     {"knot", "NUM_KNOTS"}};
    put_banner(&writer);
    put_opening(&writer);
    put_names(&writer);
    put_scales(&fixed);
    put_sizes(&fixed);
    put_errors(&fixed);
    fputc('\n', stream);
    put_conversions(&fixed);
    put_arrays(&fixed);
    put_model(&fixed);
    put_golden(&writer, &vectors);
    put_assertions(&writer, arrays, sizeof arrays / sizeof arrays[0]);
    put_closing(&writer);
    free(macro);
}
