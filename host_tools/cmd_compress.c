#include "command.h"
#include "compress.h"
#include "model_file.h"
#include "output_file.h"
#include "output_range.h"
#include <math.h>
#include <stdlib.h>

typedef struct {
    char* output;
    char* cost;
    char* plays;
    char* tolerance;
    int unscaled;
    int json;
} options_t;

/// What the options ask for.
typedef struct {
    compress_options_t compress;
    bool to_tolerance;
    double tolerance; ///< output units
} request_t;

static outcome_t parse_plays(const char* text, size_t* num_plays)
{
    char* end;
    const double value = strtod(text, &end);
    if (end == text || *end != '\0' || !(value >= 1.0 && value <= 1e9) || value > floor(value)) {
        return message_error(OUTCOME_USAGE, NOWHERE, "--plays \"%s\", expected a whole number above 0", text);
    }
    *num_plays = (size_t)value;
    return OUTCOME_OK;
}

static outcome_t parse_tolerance(const char* text, double* tolerance)
{
    char* end;
    *tolerance = strtod(text, &end);
    if (end == text || *end != '\0' || !(*tolerance >= 0.0) || !isfinite(*tolerance)) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "--tolerance \"%s\", expected a number of output units not below 0", text);
    }
    return OUTCOME_OK;
}

static outcome_t understand(const options_t* options, request_t* request)
{
    request->compress.cost = COST_ENTROPY_SUM;
    request->compress.unscaled = options->unscaled != 0;
    request->to_tolerance = options->tolerance != NULL;
    if (options->cost != NULL && !compress_cost_from_name(options->cost, &request->compress.cost)) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "--cost \"%s\" is not known to this version, expected one of %s", options->cost,
                             compress_cost_names);
    }
    if ((options->plays != NULL) == request->to_tolerance) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "expected either --plays M or --tolerance E (see hyst compress --help)");
    }
    if (options->json != 0 && output_is_stdout(options->output)) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "--json needs -o FILE: without it the model is written to stdout");
    }
    return request->to_tolerance ? parse_tolerance(options->tolerance, &request->tolerance)
                                 : parse_plays(options->plays, &request->compress.num_plays);
}

static json_t* partition_json(const partition_t* partition)
{
    json_t* beta = json_array();
    for (size_t k = 0; k <= partition->num_groups; ++k) {
        json_array_append_new(beta, json_integer((json_int_t)partition->beta[k]));
    }
    return beta;
}

static void report_json(const request_t* request, const model_t* before, const model_t* after,
                        const compression_t* compression)
{
    json_t* root = json_pack(
        "{s:s, s:o, s:f, s:f, s:I, s:I, s:I, s:I, s:b}", "cost_name",
        compress_cost_name(request->compress.cost), "partition", partition_json(&compression->partition),
        "cost", compression->partition.cost, "error_bound", compression->error_bound, "evaluations",
        (json_int_t)compression->partition.evaluations, "plays", (json_int_t)after->num_plays, "plays_before",
        (json_int_t)before->num_plays, "fixed_plays", (json_int_t)compression->num_fixed, "scaled",
        request->compress.unscaled ? 0 : 1);
    json_dumpf(root, stdout, JSON_REAL_PRECISION(15));
    putchar('\n');
    json_decref(root);
}

static void report_text(const request_t* request, const model_t* before, const model_t* after,
                        const compression_t* compression)
{
    const double range = model_output_max(before) - model_output_min(before);
    printf("plays        %zu -> %zu", before->num_plays, after->num_plays);
    printf(compression->num_fixed > 0 ? " (%zu cannot move: now part of the constant)\n" : "\n",
           compression->num_fixed);
    printf("cost         %.6g (%s)\n", compression->partition.cost,
           compress_cost_name(request->compress.cost));
    printf("error bound  %.6g", compression->error_bound);
    if (range > 0.0) {
        printf(" (%.3g %% of the output's range)", 100.0 * compression->error_bound / range);
    }
    printf("\npartition   ");
    for (size_t k = 0; k <= compression->partition.num_groups; ++k) {
        printf(" %zu", compression->partition.beta[k]);
    }
    printf("\nevaluations  %zu\n", compression->partition.evaluations);
}

static outcome_t compress_file(const options_t* options, const request_t* request, const char* path)
{
    model_t before;
    outcome_t outcome = model_read(path, &before);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    compression_t compression;
    model_t after = request->to_tolerance
                        ? compress_to_tolerance(&before, &request->compress, request->tolerance, &compression)
                        : compress_model(&before, &request->compress, &compression);
    if (!request->to_tolerance && request->compress.num_plays > after.num_plays) {
        message_note((location_t){.file = path}, "only %zu plays are there to keep, %zu were asked for",
                     after.num_plays, request->compress.num_plays);
    }
    outcome = model_write(options->output, &after);
    if (outcome == OUTCOME_OK && !output_is_stdout(options->output)) {
        (options->json != 0 ? report_json : report_text)(request, &before, &after, &compression);
    }
    compression_free(&compression);
    model_free(&after);
    model_free(&before);
    return outcome;
}

outcome_t cmd_compress(int argc, const char** argv)
{
    options_t options = {0};
    const struct poptOption table[] = {
        {"output", 'o', POPT_ARG_STRING, &options.output, 0, "the model to write (default: stdout)", "FILE"},
        {"plays", 0, POPT_ARG_STRING, &options.plays, 0, "how many plays to keep", "M"},
        {"tolerance", 0, POPT_ARG_STRING, &options.tolerance, 0,
         "keep the fewest plays whose error bound is at most E output units", "E"},
        {"cost", 0, POPT_ARG_STRING, &options.cost, 0, "entropy-sum (default), entropy-max or uniform",
         "NAME"},
        {"unscaled", 0, POPT_ARG_NONE, &options.unscaled, 0,
         "do not count a play by how far it can move, Eq. (19)", NULL},
        {"json", 0, POPT_ARG_NONE, &options.json, 0, "print the result as JSON (needs -o FILE)", NULL},
        POPT_TABLEEND};
    const command_t command = {"compress", "MODEL", 1,
                               "Merges neighbouring plays until M are left, losing as little entropy as any "
                               "partition can, and keeps the\n"
                               "output in negative saturation. The error bound holds for every input from "
                               "negative saturation."};
    const char* arguments[1] = {NULL};
    bool finished;
    request_t request = {0};
    outcome_t outcome = command_parse(&command, table, argc, argv, arguments, &finished);
    if (outcome == OUTCOME_OK && !finished) {
        outcome = understand(&options, &request);
        if (outcome == OUTCOME_OK) {
            outcome = compress_file(&options, &request, arguments[0]);
        }
    }
    free(options.output);
    free(options.cost);
    free(options.plays);
    free(options.tolerance);
    return outcome;
}
