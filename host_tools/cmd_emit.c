#include "c_text.h"
#include "command.h"
#include "emit_c.h"
#include "input_file.h"
#include "model_file.h"
#include "output_file.h"
#include "scalar.h"
#include <math.h>
#include <stdlib.h>

typedef struct {
    char* output;
    char* scalar;
    char* symbol;
    char* table_error;
} options_t;

/// NUM_SCALARS for a name that is none.
static scalar_t chosen_scalar(const options_t* options)
{
    return options->scalar == NULL ? SCALAR_F32 : scalar_find(options->scalar);
}

static outcome_t check_options(const options_t* options)
{
    if (chosen_scalar(options) == NUM_SCALARS) {
        return message_error(OUTCOME_USAGE, NOWHERE, "--scalar \"%s\" is no scalar, expected " SCALAR_NAMES,
                             options->scalar);
    }
    if (options->symbol != NULL && !c_symbol_is_valid(options->symbol)) {
        return message_error(
            OUTCOME_USAGE, NOWHERE,
            "--symbol \"%s\", expected a C identifier of at most 100 characters that begins with a "
            "letter, but not with \"hyst\"",
            options->symbol);
    }
    return OUTCOME_OK;
}

/// Output units.
static outcome_t find_table_error(const options_t* options, const model_t* model, double* table_error)
{
    if (options->table_error == NULL) {
        *table_error = tabulate_default_error(model);
        return OUTCOME_OK;
    }
    char* end;
    *table_error = strtod(options->table_error, &end);
    if (end == options->table_error || *end != '\0' || !(*table_error > 0.0) || !isfinite(*table_error)) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "--table-error \"%s\", expected a number of output units above 0",
                             options->table_error);
    }
    return OUTCOME_OK;
}

/// The model in the firmware's numbers: one or the other.
typedef struct {
    const tabulated_t* tabulated;
    const golden_t* golden;
    const quantized_t* quantized;
    const golden_q_t* golden_q;
} firmware_t;

static outcome_t write_header(const char* path, const emission_t* emission, const firmware_t* firmware)
{
    output_file_t file;
    outcome_t outcome = output_open(&file, path);
    if (outcome == OUTCOME_OK) {
        if (firmware->tabulated != NULL) {
            emit_f32(file.stream, emission, firmware->tabulated, firmware->golden);
        } else {
            emit_q(file.stream, emission, firmware->quantized, firmware->golden_q);
        }
        outcome = output_commit(&file);
    }
    return outcome;
}

static outcome_t refuse_form(location_t from, const char* scalar, hyst_status_t status)
{
    return message_error(OUTCOME_NUMERICAL, from, "the model has no valid form in %s: %s", scalar,
                         hyst_status_text(status));
}

static outcome_t refuse_table(location_t from, const char* scalar, const emission_t* emission,
                              const char* fault)
{
    return message_error(OUTCOME_NUMERICAL, from, "cannot be put into %s with a table error of %.9g: %s",
                         scalar, emission->requested_table_error, fault);
}

static outcome_t emit_float(const options_t* options, location_t from, const emission_t* emission)
{
    tabulated_t tabulated;
    golden_t golden;
    const char* fault = tabulate(emission->model, emission->requested_table_error, &tabulated);
    if (fault != NULL) {
        return refuse_table(from, "float", emission, fault);
    }
    const hyst_status_t status = golden_make(&tabulated.model, &golden);
    const firmware_t firmware = {.tabulated = &tabulated, .golden = &golden};
    const outcome_t outcome = status == HYST_STATUS_OK ? write_header(options->output, emission, &firmware)
                                                       : refuse_form(from, "float", status);
    tabulated_free(&tabulated);
    return outcome;
}

static outcome_t emit_fixed(const options_t* options, location_t from, const emission_t* emission)
{
    const quantized_bits_t bits = chosen_scalar(options) == SCALAR_Q31 ? QUANTIZED_Q31 : QUANTIZED_Q15;
    quantized_t quantized;
    golden_q_t golden;
    const char* fault = quantize(emission->model, bits, emission->requested_table_error, &quantized);
    if (fault != NULL) {
        return refuse_table(from, options->scalar, emission, fault);
    }
    const hyst_status_t status = golden_q_make(&quantized, &golden);
    const firmware_t firmware = {.quantized = &quantized, .golden_q = &golden};
    const outcome_t outcome = status == HYST_STATUS_OK ? write_header(options->output, emission, &firmware)
                                                       : refuse_form(from, options->scalar, status);
    quantized_free(&quantized);
    return outcome;
}

static outcome_t emit_model(const options_t* options, const char* path, const model_t* model)
{
    const location_t from = {.file = input_name(path)};
    emission_t emission = {.model = model};
    outcome_t outcome = command_refuse_effects(path, model, "a plain one: firmware does not run effects");
    if (outcome == OUTCOME_OK) {
        outcome = find_table_error(options, model, &emission.requested_table_error);
    }
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    if (model->initial != NULL) {
        message_note(from,
                     "the \"initial\" states are not part of the header: firmware starts from saturation");
    }
    char* own_symbol = options->symbol == NULL ? c_symbol_from(model->name) : NULL;
    emission.symbol = options->symbol == NULL ? own_symbol : options->symbol;
    outcome = chosen_scalar(options) == SCALAR_F32 ? emit_float(options, from, &emission)
                                                   : emit_fixed(options, from, &emission);
    free(own_symbol);
    return outcome;
}

static outcome_t emit_file(const options_t* options, const char* path)
{
    outcome_t outcome = check_options(options);
    model_t model;
    if (outcome == OUTCOME_OK) {
        outcome = model_read(path, &model);
    }
    if (outcome == OUTCOME_OK) {
        outcome = emit_model(options, path, &model);
        model_free(&model);
    }
    return outcome;
}

outcome_t cmd_emit(int argc, const char** argv)
{
    options_t options = {0};
    const struct poptOption table[] = {
        {"output", 'o', POPT_ARG_STRING, &options.output, 0, "the header to write (default: stdout)", "FILE"},
        {"scalar", 0, POPT_ARG_STRING, &options.scalar, 0,
         "the firmware's numbers: f32 (default), q31 or q15", "NAME"},
        {"symbol", 0, POPT_ARG_STRING, &options.symbol, 0,
         "what every name in the header begins with (default: the model's name)", "NAME"},
        {"table-error", 0, POPT_ARG_STRING, &options.table_error, 0,
         "what the tables of curves may change the output by, output units (default: 1e-4 of its range)",
         "E"},
        POPT_TABLEEND};
    const command_t command = {
        "emit", "MODEL", 1,
        "Writes the C header that lib/ runs: constants, error bounds, and golden vectors "
        "for the target's self-test."};
    const char* arguments[1] = {NULL};
    bool finished;
    outcome_t outcome = command_parse(&command, table, argc, argv, arguments, &finished);
    if (outcome == OUTCOME_OK && !finished) {
        outcome = emit_file(&options, arguments[0]);
    }
    free(options.output);
    free(options.scalar);
    free(options.symbol);
    free(options.table_error);
    return outcome;
}
