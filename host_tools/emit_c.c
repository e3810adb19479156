#include "emit_c.h"
#include "c_text.h"
#include <inttypes.h>
#include <stdlib.h>

/// Sizes on a target with 32-bit pointers, as the structs of hyst_f32.h lay out there.
enum {
    WORD_BYTES = 4,
    MODEL_BYTES = 10 * WORD_BYTES,
    STATE_BYTES = 8 * WORD_BYTES,
    SEGMENT_BYTES = 4 * WORD_BYTES,
    PLAY_BYTES = 3 * WORD_BYTES,
    KNOT_BYTES = 7 * WORD_BYTES,
    GOLDEN_BYTES = 5 * WORD_BYTES,
};

static void put_macros(const writer_t* writer, const tabulated_t* tabulated)
{
    const hyst_f32_model_t* model = &tabulated->model;
    const size_t flash =
        MODEL_BYTES + PLAY_BYTES * (size_t)model->num_plays + KNOT_BYTES * (size_t)model->num_knots;
    put_names(writer);
    put_value(writer, "INPUT_MIN", model->input_min, "input units");
    put_value(writer, "INPUT_MAX", model->input_max, "input units");
    put_count(writer, "NUM_PLAYS", model->num_plays, "play operators");
    put_count(writer, "NUM_KNOTS", model->num_knots, "knots of the table of curves");
    put_count(writer, "RAM_BYTES", STATE_BYTES + SEGMENT_BYTES * (size_t)model->num_plays,
              "state and memory, 32-bit target");
    put_count(writer, "FLASH_BYTES", flash, "model and arrays, 32-bit target");
    put_count(writer, "GOLDEN_FLASH_BYTES", GOLDEN_BYTES + 4 * WORD_BYTES * (size_t)GOLDEN_STEPS,
              "golden vectors, only where they are used");
    put_bound(writer, "TABLE_ERROR", tabulated->table_error, "output units: bound on what the tables change");
    put_bound(writer, "FLOAT_ERROR", tabulated->float_error,
              "output units: bound on what rounding to float changes");
    put_known_errors(writer);
    fputc('\n', writer->stream);
}

static void put_field(const writer_t* writer, const char* separator, const char* name, float value)
{
    fprintf(writer->stream, "%s.%s = ", separator, name);
    put_float(writer->stream, value);
}

static void put_plays(const writer_t* writer, const hyst_f32_model_t* model)
{
    fprintf(writer->stream, "static const hyst_f32_play_t %s_play[] = {\n", writer->symbol);
    for (uint32_t j = 0; j < model->num_plays; ++j) {
        put_field(writer, "    {", "opening", model->play[j].opening);
        put_field(writer, ", ", "loading", model->play[j].loading);
        put_field(writer, ", ", "slope", model->play[j].slope);
        fputs("},\n", writer->stream);
    }
    fputs("};\n", writer->stream);
}

static void put_knots(const writer_t* writer, const hyst_f32_model_t* model)
{
    fprintf(writer->stream, "static const hyst_f32_knot_t %s_knot[] = {\n", writer->symbol);
    for (uint32_t k = 0; k < model->num_knots; ++k) {
        const hyst_f32_knot_t* knot = &model->knot[k];
        put_field(writer, "    {", "input", knot->input);
        put_field(writer, ",\n     ", "ascending", knot->ascending);
        put_field(writer, ", ", "ascending_slope", knot->ascending_slope);
        put_field(writer, ",\n     ", "descending", knot->descending);
        put_field(writer, ", ", "descending_slope", knot->descending_slope);
        put_field(writer, ",\n     ", "nonhysteretic", knot->nonhysteretic);
        put_field(writer, ", ", "nonhysteretic_slope", knot->nonhysteretic_slope);
        fputs("},\n", writer->stream);
    }
    fputs("};\n", writer->stream);
}

static void put_arrays(const writer_t* writer, const hyst_f32_model_t* model)
{
    // Measured core by core: lib/DESIGN.md, section 5.
    fputs("/* A step runs on nested segments of plays: for no number of plays more instructions than a loop "
          "over all. */\n",
          writer->stream);
    put_array_comment(writer, "plays by radius and their loading curve, in ",
                      writer->from->model->output_unit, "NUM_PLAYS");
    put_plays(writer, model);
    if (model->num_knots > 0) {
        put_array_comment(writer, "curves over the input, in ", writer->from->model->input_unit, "NUM_KNOTS");
        put_knots(writer, model);
    }
    fputc('\n', writer->stream);
}

static void put_model(const writer_t* writer, const hyst_f32_model_t* model)
{
    fprintf(writer->stream,
            "static const hyst_f32_model_t %s_model = {\n"
            "    .format = %" PRIu32 "U,\n"
            "    .num_plays = %s_NUM_PLAYS,\n"
            "    .num_knots = %s_NUM_KNOTS,\n",
            writer->symbol, model->format, writer->macro, writer->macro);
    put_field(writer, "    ", "input_min", model->input_min);
    put_field(writer, ",\n    ", "input_max", model->input_max);
    put_field(writer, ",\n    ", "constant", model->constant);
    put_field(writer, ",\n    ", "nonhysteretic_slope", model->nonhysteretic_slope);
    put_field(writer, ",\n    ", "moment", model->moment);
    fprintf(writer->stream, ",\n    .play = %s_play,\n", writer->symbol);
    if (model->num_knots > 0) {
        fprintf(writer->stream, "    .knot = %s_knot,\n};\n\n", writer->symbol);
    } else {
        fputs("    .knot = NULL,\n};\n\n", writer->stream);
    }
}

static void put_bits(FILE* stream, const void* vector, size_t i)
{
    fprintf(stream, "0x%08" PRIx32 "U", ((const uint32_t*)vector)[i]);
}

void emit_f32(FILE* stream, const emission_t* emission, const tabulated_t* tabulated, const golden_t* golden)
{
    char* macro = c_symbol_upper(emission->symbol);
    const writer_t writer = {stream, emission, emission->symbol, macro, "f32", "float"};
    const golden_text_t vectors = {"uint32_t",
                                   "float bits",
                                   "_bits",
                                   {golden->input, golden->output, golden->wanted, golden->inverse},
                                   put_bits};
    const array_length_t arrays[] = {{"play", "NUM_PLAYS"}, {"knot", "NUM_KNOTS"}};
    put_banner(&writer);
    put_opening(&writer);
    put_macros(&writer, tabulated);
    put_arrays(&writer, &tabulated->model);
    put_model(&writer, &tabulated->model);
    put_golden(&writer, &vectors);
    put_assertions(&writer, arrays, tabulated->model.num_knots > 0 ? 2 : 1);
    put_closing(&writer);
    free(macro);
}
