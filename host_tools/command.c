#include "command.h"
#include "input_file.h"
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// The option that popt has just stored: a sample rate of 0 must not pass for one that was not given.
static outcome_t check_option(int option, const struct poptOption* options)
{
    for (const struct poptOption* entry = options; option == OPTION_SAMPLE_RATE && entry->longName != NULL;
         ++entry) {
        if (entry->val == OPTION_SAMPLE_RATE) {
            const double rate = *(const double*)entry->arg;
            if (!(rate > 0.0) || !isfinite(rate)) {
                return message_error(OUTCOME_USAGE, NOWHERE,
                                     "--sample-rate %g, expected a number of hertz above 0", rate);
            }
        }
    }
    return OUTCOME_OK;
}

/// popt's own copies of the arguments die with its context; argv's live on.
static const char* same_argument(int argc, const char** argv, const char* text)
{
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], text) == 0) {
            return argv[i];
        }
    }
    return NULL;
}

static outcome_t take_arguments(const command_t* command, poptContext context, int argc, const char** argv,
                                const char** arguments)
{
    int count = 0;
    for (const char* text = poptGetArg(context); text != NULL; text = poptGetArg(context)) {
        if (count < command->num_arguments) {
            arguments[count] = same_argument(argc, argv, text);
        }
        count += 1;
    }
    if (count > 0 && command->num_arguments == 0) {
        return message_error(OUTCOME_USAGE, NOWHERE, "%s takes no argument, but got %d (see hyst %s --help)",
                             command->verb, count, command->verb);
    }
    if (count != command->num_arguments) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "%s takes %d argument%s, %s, but got %d (see hyst %s --help)", command->verb,
                             command->num_arguments, command->num_arguments == 1 ? "" : "s",
                             command->arguments, count, command->verb);
    }
    return OUTCOME_OK;
}

static outcome_t parse(const command_t* command, const struct poptOption* options, poptContext context,
                       int argc, const char** argv, const char** arguments, bool* finished)
{
    int option;
    while ((option = poptGetNextOpt(context)) > 0) {
        if (option == OPTION_HELP) {
            *finished = true;
            poptPrintHelp(context, stdout, 0);
            printf("\n%s\n", command->description);
            return OUTCOME_OK;
        }
        const outcome_t outcome = check_option(option, options);
        if (outcome != OUTCOME_OK) {
            return outcome;
        }
    }
    if (option < -1) {
        return message_error(OUTCOME_USAGE, NOWHERE, "%s: %s (see hyst %s --help)",
                             poptBadOption(context, POPT_BADOPTION_NOALIAS), poptStrerror(option),
                             command->verb);
    }
    return take_arguments(command, context, argc, argv, arguments);
}

outcome_t command_parse(const command_t* command, const struct poptOption* options, int argc,
                        const char** argv, const char** arguments, bool* finished)
{
    *finished = false;
    int quiet = 0;
    const struct poptOption common[] = {
        {"quiet", 'q', POPT_ARG_NONE, &quiet, 0, "no warnings, no notes, no progress", NULL},
        {"help", 'h', POPT_ARG_NONE, NULL, OPTION_HELP, "this text", NULL},
        POPT_TABLEEND};
    const struct poptOption all[] = {
        {NULL, 0, POPT_ARG_INCLUDE_TABLE, (void*)(uintptr_t)options, 0, "Options", NULL},
        {NULL, 0, POPT_ARG_INCLUDE_TABLE, (void*)(uintptr_t)common, 0, "Common options", NULL},
        POPT_TABLEEND};
    char invocation[64];
    (void)snprintf(invocation, sizeof invocation, "hyst %s", command->verb);
    const char** renamed = xcalloc((size_t)argc + 1, sizeof *renamed);
    memcpy(renamed, argv, (size_t)argc * sizeof *renamed);
    renamed[0] = invocation;
    poptContext context = poptGetContext(NULL, argc, renamed, all, 0);
    char usage[64];
    (void)snprintf(usage, sizeof usage, "[OPTION...] %s", command->arguments);
    poptSetOtherOptionHelp(context, usage);
    const outcome_t outcome = parse(command, options, context, argc, argv, arguments, finished);
    poptFreeContext(context);
    free(renamed);
    message_set_quiet(quiet != 0);
    return outcome;
}

outcome_t command_start(const char* name, const model_t* model, start_t* start)
{
    static const struct {
        const char* name;
        start_t start;
    } starts[] = {{"negative-saturation", START_NEGATIVE_SATURATION},
                  {"positive-saturation", START_POSITIVE_SATURATION},
                  {"demagnetised", START_DEMAGNETISED},
                  {"model", START_MODEL}};
    *start = model->initial != NULL ? START_MODEL : START_NEGATIVE_SATURATION;
    if (name == NULL) {
        return OUTCOME_OK;
    }
    for (size_t i = 0; i < sizeof starts / sizeof starts[0]; ++i) {
        if (strcmp(name, starts[i].name) == 0) {
            *start = starts[i].start;
            return *start == START_MODEL && model->initial == NULL
                       ? message_error(OUTCOME_USAGE, NOWHERE,
                                       "--initial model, but the model has no \"initial\" states")
                       : OUTCOME_OK;
        }
    }
    return message_error(
        OUTCOME_USAGE, NOWHERE,
        "--initial \"%s\", expected negative-saturation, positive-saturation, demagnetised or model", name);
}

outcome_t command_refuse_effects(const char* path, const model_t* model, const char* expected)
{
    if (json_array_size(model->effects) == 0) {
        return OUTCOME_OK;
    }
    const json_t* type = json_object_get(json_array_get(model->effects, 0), "type");
    return message_error(OUTCOME_BAD_INPUT, (location_t){.file = input_name(path)},
                         "the model has effects (\"%s\" first), expected %s", json_string_value(type),
                         expected);
}

void command_warn_outside(const model_t* model, const record_t* record)
{
    size_t count = 0;
    for (size_t i = 0; i < record->num_samples; ++i) {
        count += record->input[i] < model->input_min || record->input[i] > model->input_max ? 1 : 0;
    }
    if (count > 0) {
        message_warning(
            (location_t){.file = record->path},
            "%zu of %zu inputs lie outside the model's range %.9g ... %.9g, where its curves are continued",
            count, record->num_samples, model->input_min, model->input_max);
    }
}
