#include "command.h"
#include "identify.h"
#include "model_file.h"
#include "record_fill.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_PLAYS = 30 };

typedef struct {
    char* output;
    char* envelope;
    char* name;
    char* input_unit;
    char* output_unit;
    char* input_range;
    char* columns;
    double sample_rate;
    int plays;
    int json;
} options_t;

/// "left-out", "estimated", or the saturation that was recognised.
static const char* memory_name(const identify_result_t* result)
{
    switch (result->memory) {
    case MEMORY_LEFT_OUT:
        return "left-out";
    case MEMORY_ASSUMED:
        return result->start == START_POSITIVE_SATURATION ? "positive-saturation" : "negative-saturation";
    case MEMORY_ESTIMATED:
        return "estimated";
    }
    return "unknown";
}

static outcome_t parse_envelope(const char* text, identify_envelope_t* envelope)
{
    static const char* const names[] = {[IDENTIFY_AUTO] = "auto",
                                        [IDENTIFY_LINEAR] = "linear",
                                        [IDENTIFY_TANH] = "tanh",
                                        [IDENTIFY_TABLE] = "table"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (text == NULL || strcmp(text, names[i]) == 0) {
            *envelope = (identify_envelope_t)i;
            return OUTCOME_OK;
        }
    }
    return message_error(OUTCOME_USAGE, NOWHERE, "--envelope %s, expected auto, linear, tanh or table", text);
}

static outcome_t parse_options(const options_t* given, identify_options_t* options)
{
    if (given->plays < 1 || given->plays > IDENTIFY_MAX_PLAYS) {
        return message_error(OUTCOME_USAGE, NOWHERE, "--plays %d, expected 1 to %d", given->plays,
                             IDENTIFY_MAX_PLAYS);
    }
    options->num_plays = (size_t)given->plays;
    if (given->input_range != NULL) {
        int length = 0;
        if (sscanf(given->input_range, "%lf,%lf%n", &options->input_min, &options->input_max, &length) != 2 ||
            given->input_range[length] != '\0' || !(options->input_min < options->input_max)) {
            return message_error(OUTCOME_USAGE, NOWHERE,
                                 "--input-range %s, expected MIN,MAX with MIN below MAX", given->input_range);
        }
        options->has_range = true;
    }
    return parse_envelope(given->envelope, &options->envelope);
}

static json_t* undetermined_of(const identify_result_t* result)
{
    json_t* list = json_array();
    for (size_t j = 0; j < result->model.num_plays; j++) {
        if (result->undetermined[j]) {
            json_array_append_new(list, json_integer((json_int_t)j));
        }
    }
    return list;
}

/// What the model file carries along: figures that later steps and the generated header repeat.
static json_t* identification_of(const identify_result_t* result)
{
    return json_pack("{s:f, s:f, s:f, s:f, s:I, s:I, s:s, s:o}", "rmse", result->rmse, "relative",
                     result->relative, "max_error", result->max_error, "monotone_floor",
                     result->monotone_floor, "samples", (json_int_t)result->num_samples, "first_fitted",
                     (json_int_t)result->first_fitted, "memory", memory_name(result), "undetermined",
                     undetermined_of(result));
}

static void print_json(const identify_result_t* result)
{
    json_t* report = json_copy(result->model.identification);
    json_object_set_new(report, "plays", json_integer((json_int_t)result->model.num_plays));
    json_object_set_new(report, "ascending", json_string(identify_curve_name(result->model.ascending.type)));
    json_object_set_new(report, "nonhysteretic",
                        json_string(identify_curve_name(result->model.nonhysteretic.type)));
    json_object_set_new(report, "clockwise", json_boolean(result->clockwise));
    json_t* candidates = json_array();
    for (size_t i = 0; i < result->num_candidates; i++) {
        const identify_candidate_t* c = &result->candidate[i];
        json_array_append_new(candidates, json_pack("{s:s, s:s, s:f}", "envelope",
                                                    identify_curve_name(c->envelope), "nonhysteretic",
                                                    identify_curve_name(c->nonhysteretic), "rmse", c->rmse));
    }
    json_object_set_new(report, "candidates", candidates);
    json_dumpf(report, stdout, JSON_INDENT(1) | JSON_REAL_PRECISION(15));
    putchar('\n');
    json_decref(report);
}

static void print_memory(const identify_result_t* result)
{
    switch (result->memory) {
    case MEMORY_LEFT_OUT:
        printf("memory at the start: unknown; the first %zu samples, until both ends of the input's range "
               "were visited, "
               "are left out\n",
               result->first_fitted);
        break;
    case MEMORY_ASSUMED:
        printf("memory at the start: %s saturation, as the record's first stretch agrees\n",
               result->start == START_POSITIVE_SATURATION ? "positive" : "negative");
        break;
    case MEMORY_ESTIMATED:
        printf("memory at the start: estimated, and written to the model as \"initial\"\n");
        break;
    }
}

static void print_report(const identify_result_t* result)
{
    const model_t* model = &result->model;
    size_t active = 0;
    for (size_t j = 0; j < model->num_plays; j++) {
        active += model->weight[j] > 0;
    }
    printf("curves: %s envelopes, %s non-hysteretic part\n", identify_curve_name(model->ascending.type),
           identify_curve_name(model->nonhysteretic.type));
    printf("plays: %zu, of which %zu carry weight", model->num_plays, active);
    if (result->num_undetermined > 0) {
        printf(", %zu are undetermined: the record never moves them", result->num_undetermined);
    }
    printf("\nfit: rmse %.6g %s, %.3f %% of the output's range; largest error %.6g\n", result->rmse,
           model->output_unit, 100 * result->relative, result->max_error);
    print_memory(result);
}

/// Says what keeps a fit from being better, where the record itself shows it.
static void explain_misfit(const identify_result_t* result, const char* path)
{
    const double floor = result->monotone_floor / result->output_range;
    if (result->relative < 0.008) {
        return;
    }
    if (result->clockwise) {
        message_warning(
            (location_t){.file = path},
            "the loop runs clockwise (the ascending branch lies above the descending one, as a friction "
            "force over displacement does): no play operators with weights >= 0 follow that; the model is "
            "the best curve without a loop. Check the columns' order and signs");
    }
    if (floor > 0.25 * result->relative || floor > 0.008) {
        message_warning(
            (location_t){.file = path},
            "the output moves against its input within stretches of rising or falling input (noise, "
            "dynamics or a falling characteristic): no GPI model can come below %.3f %% of range here",
            100 * floor);
    }
    if (!result->clockwise && floor <= 0.25 * result->relative) {
        message_warning(
            (location_t){.file = path},
            "the fit leaves %.3f %% of range that no rate-independent play model with these curves "
            "explains: the record holds dynamics, drift or another kind of hysteresis",
            100 * result->relative);
    }
}

static outcome_t finish(const options_t* given, const char* path, identify_result_t* result)
{
    model_t* model = &result->model;
    free(model->name);
    free(model->input_unit);
    free(model->output_unit);
    model->name = xstrdup(given->name != NULL ? given->name : "model");
    model->input_unit = xstrdup(given->input_unit != NULL ? given->input_unit : "");
    model->output_unit = xstrdup(given->output_unit != NULL ? given->output_unit : "");
    model->identification = identification_of(result);
    const bool to_stdout = given->output != NULL && strcmp(given->output, "-") == 0;
    outcome_t outcome = OUTCOME_OK;
    if (given->output != NULL) {
        outcome = model_write(given->output, model);
    }
    if (outcome == OUTCOME_OK && !to_stdout) {
        if (given->json) {
            print_json(result);
        } else {
            print_report(result);
        }
    }
    explain_misfit(result, path);
    return outcome;
}

static outcome_t run(const options_t* given, const char* path)
{
    identify_options_t options = {0};
    outcome_t outcome = parse_options(given, &options);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    if (given->output == NULL && !given->json) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "identify: nowhere to put the result, expected -o MODEL or --json");
    }
    record_t record = {0};
    outcome = record_read(path,
                          &(record_options_t){.columns = given->columns,
                                              .sample_rate = given->sample_rate,
                                              .needs_input = true,
                                              .needs_output = true},
                          &record);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    record_fill(&record);
    identify_result_t result;
    outcome = identify(&record, &options, &result);
    if (outcome == OUTCOME_OK) {
        outcome = finish(given, record.path, &result);
    }
    identify_result_free(&result);
    record_free(&record);
    return outcome;
}

outcome_t cmd_identify(int argc, const char** argv)
{
    options_t given = {.plays = DEFAULT_PLAYS};
    const struct poptOption options[] = {
        {"output", 'o', POPT_ARG_STRING, &given.output, 0, "where the model goes", "MODEL"},
        {"plays", 0, POPT_ARG_INT, &given.plays, 0, "play operators (30)", "N"},
        {"envelope", 0, POPT_ARG_STRING, &given.envelope, 0, "which envelopes to try (auto)",
         "auto|linear|tanh|table"},
        {"input-range", 0, POPT_ARG_STRING, &given.input_range, 0, "the model's input range (the record's)",
         "MIN,MAX"},
        {"name", 0, POPT_ARG_STRING, &given.name, 0, "the model's name", "NAME"},
        {"input-unit", 0, POPT_ARG_STRING, &given.input_unit, 0, "unit of the input", "UNIT"},
        {"output-unit", 0, POPT_ARG_STRING, &given.output_unit, 0, "unit of the output", "UNIT"},
        RECORD_OPTIONS(&given.columns, &given.sample_rate),
        {"json", 0, POPT_ARG_NONE, &given.json, 0, "the result as JSON on stdout", NULL},
        POPT_TABLEEND};
    const command_t command = {
        "identify", "RECORD", 1,
        "Fits a generalized Prandtl-Ishlinskii model to a measured record: envelopes, non-hysteretic part "
        "and weights\n"
        ">= 0. The record should sweep the whole input range at least once each way; loops of several sizes "
        "tell\n"
        "envelopes from weights. Slow records: what depends on rate is not in this model."};
    const char* path = NULL;
    bool finished = false;
    outcome_t outcome = command_parse(&command, options, argc, argv, &path, &finished);
    if (outcome == OUTCOME_OK && !finished) {
        outcome = run(&given, path);
    }
    free(given.output);
    free(given.envelope);
    free(given.name);
    free(given.input_unit);
    free(given.output_unit);
    free(given.input_range);
    free(given.columns);
    return outcome;
}
