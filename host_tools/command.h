/// What the verbs share: their table, and the parsing of their arguments.
#ifndef HYST_HOST_COMMAND_H
#define HYST_HOST_COMMAND_H

#include "message.h"
#include "model.h"
#include "record.h"
#include <popt.h>

/// What popt hands to command_parse for its own checks; a verb's own options use 0.
enum { OPTION_HELP = 'h', OPTION_SAMPLE_RATE = 'r' };

/// Every verb: argv[0] is the verb's name.
outcome_t cmd_identify(int argc, const char** argv);
outcome_t cmd_compress(int argc, const char** argv);
outcome_t cmd_emit(int argc, const char** argv);
outcome_t cmd_simulate(int argc, const char** argv);
outcome_t cmd_invert(int argc, const char** argv);
outcome_t cmd_diagnose(int argc, const char** argv);
outcome_t cmd_effects(int argc, const char** argv);

typedef struct {
    const char* verb;        ///< "simulate"
    const char* arguments;   ///< "MODEL RECORD", for the usage line
    int num_arguments;       ///< how many positional arguments it must get
    const char* description; ///< what --help says above the options
} command_t;

/// Parses argv by `options` (a popt table ending in POPT_TABLEEND; --help and --quiet are added to it) and
/// stores the positional arguments. Prints help on stdout and sets *finished when asked for it. A usage error
/// is reported as `hyst: error: ...` with OUTCOME_USAGE. Strings that popt stores through POPT_ARG_STRING
/// belong to the caller.
outcome_t command_parse(const command_t* command, const struct poptOption* options, int argc,
                        const char** argv, const char** arguments, bool* finished);

/// --initial NAME to a start_t; `given` says whether the option was given (then *start is set), a wrong name
/// is a usage error. Without the option a run starts from the model's `initial` when it has one, else from
/// negative saturation.
outcome_t command_start(const char* name, const model_t* model, start_t* start);

/// Refuses a model with effects, saying what was expected instead: OUTCOME_BAD_INPUT.
outcome_t command_refuse_effects(const char* path, const model_t* model, const char* expected);

/// The options of every verb that reads a record: --columns, --sample-rate.
#define RECORD_OPTIONS(columns_variable, rate_variable)                                                      \
    {"columns", 0, POPT_ARG_STRING, columns_variable, 0, "other column names", "time=T,input=U,output=Y"},   \
    {                                                                                                        \
        "sample-rate", 0, POPT_ARG_DOUBLE, rate_variable, OPTION_SAMPLE_RATE,                                \
            "samples per second where there is no time column", "HZ"                                         \
    }
/// Warns of inputs beyond the model's range, with their number.
void command_warn_outside(const model_t* model, const record_t* record);

#endif
