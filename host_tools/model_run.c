#include "model_run.h"
#include "input_file.h"
#include "model_file.h"
#include "output_file.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    char* output;
    char* initial;
    char* columns;
    double sample_rate;
    int other_record;
    int json;
} options_t;

outcome_t model_run_check_finite(const model_run_t* run, const char* what, const double* values)
{
    for (size_t i = 0; i < run->record->num_samples; ++i) {
        if (!isfinite(values[i])) {
            return message_error(
                OUTCOME_NUMERICAL, (location_t){.file = run->model_path},
                "the %s is not finite at sample %zu: the model's effects are beyond what can be "
                "computed over this record",
                what, i + 1);
        }
    }
    return OUTCOME_OK;
}

static outcome_t check_streams(const options_t* options, const char* const* arguments)
{
    if (strcmp(arguments[0], "-") == 0 && strcmp(arguments[1], "-") == 0) {
        return message_error(OUTCOME_USAGE, NOWHERE, "the model and the record cannot both come from stdin");
    }
    if (options->json != 0 && output_is_stdout(options->output)) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "--json needs -o FILE: without it the record is written to stdout");
    }
    return OUTCOME_OK;
}

/// Says which effects were fitted to one record's own course, and over another record takes them out; returns
/// how many are left.
static size_t mind_transfer(const options_t* options, const char* model_path, effect_use_t* uses,
                            size_t num_uses)
{
    size_t count = 0;
    for (size_t i = 0; i < num_uses; ++i) {
        const bool left_out = uses[i].is_of_one_record && options->other_record != 0;
        if (uses[i].is_of_one_record) {
            message_note((location_t){.file = model_path},
                         left_out ? "the effect \"%s\" was fitted to one record's own course and is left out"
                                  : "the effect \"%s\" was fitted to one record's own course; over a record "
                                    "with another leave it out by --other-record",
                         uses[i].effect->name);
        }
        if (!left_out) {
            uses[count++] = uses[i];
        }
    }
    return count;
}

static outcome_t run_on(const options_t* options, const char* model_path, const model_t* model,
                        const record_t* record, model_run_work_t* work)
{
    effect_use_t* uses;
    model_run_t run = {.model = model,
                       .record = record,
                       .model_path = input_name(model_path),
                       .output = options->output,
                       .report = !output_is_stdout(options->output),
                       .json = options->json != 0};
    outcome_t outcome = effect_uses_of_model(model, run.model_path, &uses, &run.num_uses);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    run.num_uses = mind_transfer(options, run.model_path, uses, run.num_uses);
    run.uses = uses;
    if (run.num_uses > 0 && record->time == NULL) {
        message_warning(
            (location_t){.file = record->path},
            "the record has no time: for the model's effects a sample is a second (--sample-rate)");
    }
    outcome = effect_check_columns(record, uses, run.num_uses);
    if (outcome == OUTCOME_OK) {
        outcome = command_start(options->initial, model, &run.start);
    }
    if (outcome == OUTCOME_OK) {
        outcome = work(&run);
    }
    free(uses);
    return outcome;
}

static outcome_t read_and_run(const options_t* options, const char* const* arguments, record_options_t needs,
                              model_run_work_t* work)
{
    model_t model;
    outcome_t outcome = check_streams(options, arguments);
    if (outcome == OUTCOME_OK) {
        outcome = model_read(arguments[0], &model);
    }
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    needs.columns = options->columns;
    needs.sample_rate = options->sample_rate;
    record_t record;
    outcome = record_read(arguments[1], &needs, &record);
    if (outcome == OUTCOME_OK) {
        outcome = run_on(options, arguments[0], &model, &record, work);
    }
    record_free(&record);
    model_free(&model);
    return outcome;
}

outcome_t model_run(const command_t* command, record_options_t needs, model_run_work_t* work, int argc,
                    const char** argv)
{
    options_t options = {0};
    const struct poptOption table[] = {
        {"output", 'o', POPT_ARG_STRING, &options.output, 0, "the record to write (default: stdout)", "FILE"},
        {"initial", 0, POPT_ARG_STRING, &options.initial, 0,
         "the past: negative-saturation, positive-saturation, demagnetised or model", "NAME"},
        {"other-record", 0, POPT_ARG_NONE, &options.other_record, 0,
         "leave out the effects that a diagnosis fitted to one record's own course", NULL},
        RECORD_OPTIONS(&options.columns, &options.sample_rate),
        {"json", 0, POPT_ARG_NONE, &options.json, 0, "print the result as JSON (needs -o FILE)", NULL},
        POPT_TABLEEND};
    const char* arguments[2] = {NULL, NULL};
    bool finished;
    outcome_t outcome = command_parse(command, table, argc, argv, arguments, &finished);
    if (outcome == OUTCOME_OK && !finished) {
        outcome = read_and_run(&options, arguments, needs, work);
    }
    free(options.output);
    free(options.initial);
    free(options.columns);
    return outcome;
}
