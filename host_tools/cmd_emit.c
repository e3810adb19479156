#include "c_text.h"
#include "command.h"
#include "emit_c.h"
#include "input_file.h"
#include "model_file.h"
#include "output_file.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    char* output;
    char* scalar;
    char* symbol;
    char* table_error;
} options_t;

static outcome_t check_options(const options_t* options)
{
    const char* scalar = options->scalar;
    if (scalar != NULL && (strcmp(scalar, "q31") == 0 || strcmp(scalar, "q15") == 0)) {
        return message_error(OUTCOME_USAGE, NOWHERE, "--scalar %s is not in this version, expected f32",
                             scalar);
    }
    if (scalar != NULL && strcmp(scalar, "f32") != 0) {
        return message_error(OUTCOME_USAGE, NOWHERE, "--scalar \"%s\" is no scalar, expected f32", scalar);
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

static outcome_t write_header(const char* path, const emission_t* emission)
{
    output_file_t file;
    outcome_t outcome = output_open(&file, path);
    if (outcome == OUTCOME_OK) {
        emit_c(file.stream, emission);
        outcome = output_commit(&file);
    }
    return outcome;
}

static outcome_t emit_tabulated(const options_t* options, location_t from, emission_t* emission)
{
    golden_t golden;
    const hyst_status_t status = golden_make(&emission->tabulated->model, &golden);
    if (status != HYST_STATUS_OK) {
        return message_error(OUTCOME_NUMERICAL, from, "the model has no valid form in float: %s",
                             hyst_status_text(status));
    }
    if (emission->model->initial != NULL) {
        message_note(from,
                     "the \"initial\" states are not part of the header: firmware starts from saturation");
    }
    char* own_symbol = options->symbol == NULL ? c_symbol_from(emission->model->name) : NULL;
    emission->golden = &golden;
    emission->symbol = options->symbol == NULL ? own_symbol : options->symbol;
    const outcome_t outcome = write_header(options->output, emission);
    free(own_symbol);
    return outcome;
}

static outcome_t emit_model(const options_t* options, const char* path, const model_t* model)
{
    const location_t from = {.file = input_name(path)};
    emission_t emission = {.model = model};
    outcome_t outcome = command_refuse_effects(path, model);
    if (outcome == OUTCOME_OK) {
        outcome = find_table_error(options, model, &emission.requested_table_error);
    }
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    tabulated_t tabulated;
    const char* fault = tabulate(model, emission.requested_table_error, &tabulated);
    if (fault != NULL) {
        return message_error(OUTCOME_NUMERICAL, from,
                             "cannot be put into float with a table error of %.9g: %s",
                             emission.requested_table_error, fault);
    }
    emission.tabulated = &tabulated;
    outcome = emit_tabulated(options, from, &emission);
    tabulated_free(&tabulated);
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
        {"scalar", 0, POPT_ARG_STRING, &options.scalar, 0, "the firmware's numbers: f32 (default)", "NAME"},
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
