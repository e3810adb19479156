#include "command.h"
#include "compress.h"
#include "ensemble.h"
#include "model_file.h"
#include "output_file.h"
#include "output_range.h"
#include "record.h"
#include "worst_input.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    char* output;
    char* cost;
    char* plays;
    char* tolerance;
    char* method;
    char* worst_input;
    int unscaled;
    int json;
} options_t;

/// 3 s of partitions of 30 plays, about.
static const double most_partitions = 1e7;
/// An entropy cost's time grows with the square of the plays: 2 minutes.
static const size_t most_entropy_plays = 100000;

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

static outcome_t parse_method(const options_t* options, request_t* request)
{
    const bool exhaustive = options->method != NULL && strcmp(options->method, "exhaustive") == 0;
    if (options->method != NULL && !exhaustive && strcmp(options->method, "dp") != 0) {
        return message_error(OUTCOME_USAGE, NOWHERE, "--method \"%s\", expected dp or exhaustive",
                             options->method);
    }
    const partition_cost_t cost = request->compress.cost;
    if (exhaustive && (request->to_tolerance || cost == COST_UNIFORM || cost == COST_ENSEMBLE)) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "--method exhaustive needs --plays M and a cost of partitions, not %s",
                             compress_cost_name(cost));
    }
    request->compress.exhaustive = exhaustive;
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
    if (options->worst_input != NULL && output_is_stdout(options->worst_input)) {
        return message_error(OUTCOME_USAGE, NOWHERE, "--worst-input needs a file other than stdout");
    }
    const outcome_t outcome = parse_method(options, request);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    return request->to_tolerance ? parse_tolerance(options->tolerance, &request->tolerance)
                                 : parse_plays(options->plays, &request->compress.num_plays);
}

/// What is reported.
typedef struct {
    const request_t* request;
    const model_t* before;
    const model_t* after;
    const compression_t* compression;
    double attained; ///< the error under the worst input; NAN when it was not asked for
} result_t;

static json_t* partition_json(const partition_t* partition)
{
    json_t* beta = json_array();
    for (size_t k = 0; k <= partition->num_groups; ++k) {
        json_array_append_new(beta, json_integer((json_int_t)partition->beta[k]));
    }
    return beta;
}

static void report_json(const result_t* result)
{
    const compress_options_t* options = &result->request->compress;
    const compression_t* compression = result->compression;
    json_t* root = json_pack(
        "{s:s, s:o, s:f, s:f, s:I, s:I, s:I, s:I, s:b}", "cost_name", compress_cost_name(options->cost),
        "partition", partition_json(&compression->partition), "cost", compression->partition.cost,
        "error_bound", compression->error_bound, "evaluations",
        (json_int_t)compression->partition.evaluations, "plays", (json_int_t)result->after->num_plays,
        "plays_before", (json_int_t)result->before->num_plays, "fixed_plays",
        (json_int_t)compression->num_fixed, "scaled", compress_is_scaled(options) ? 1 : 0);
    if (options->cost == COST_WASSERSTEIN) {
        json_object_set_new(root, "envelope_weight", json_real(compression->envelope_weight));
        json_object_set_new(root, "constant", json_real(compression->constant));
    }
    if (!isnan(result->attained)) {
        json_object_set_new(root, "attained", json_real(result->attained));
    }
    json_dumpf(root, stdout, JSON_REAL_PRECISION(15));
    putchar('\n');
    json_decref(root);
}

static void report_error(const result_t* result)
{
    const double range = model_output_max(result->before) - model_output_min(result->before);
    const double bound = result->compression->error_bound;
    printf("error bound  %.6g", bound);
    if (range > 0.0) {
        printf(" (%.3g %% of the output's range)", 100.0 * bound / range);
    }
    if (!isnan(result->attained)) {
        printf("\nattained     %.6g", result->attained);
        if (bound > 0.0) {
            printf(" (%.6g of the bound)", result->attained / bound);
        }
    }
    putchar('\n');
}

static void report_text(const result_t* result)
{
    const compression_t* compression = result->compression;
    printf("plays        %zu -> %zu", result->before->num_plays, result->after->num_plays);
    printf(compression->num_fixed > 0 ? " (%zu cannot move: now part of the constant)\n" : "\n",
           compression->num_fixed);
    printf("cost         %.6g (%s)\n", compression->partition.cost,
           compress_cost_name(result->request->compress.cost));
    report_error(result);
    printf("partition   ");
    for (size_t k = 0; k <= compression->partition.num_groups; ++k) {
        printf(" %zu", compression->partition.beta[k]);
    }
    printf("\nevaluations  %zu\n", compression->partition.evaluations);
}

/// One sample a second: the models do not depend on the rate.
static outcome_t write_input(const char* path, const double* input, size_t num_samples)
{
    double* time = xcalloc(num_samples, sizeof(double));
    for (size_t i = 0; i < num_samples; ++i) {
        time[i] = (double)i;
    }
    const record_column_t columns[] = {{"time", time, false}, {"input", input, false}};
    const outcome_t outcome = record_write(path, columns, 2, num_samples);
    free(time);
    return outcome;
}

static outcome_t write_worst_input(const char* path, result_t* result)
{
    const model_t* after = result->after;
    const replacement_t replacement = {.plays = {after->radius, after->weight, after->num_plays},
                                       .envelope_weight = result->compression->envelope_weight,
                                       .constant = result->compression->constant};
    size_t num_samples;
    double* input = worst_input(result->before, &replacement, &num_samples);
    result->attained = largest_difference(result->before, after, input, num_samples);
    const outcome_t outcome = write_input(path, input, num_samples);
    free(input);
    return outcome;
}

/// Refuses what would take too long.
static outcome_t check_effort(const request_t* request, const char* path, const model_t* model)
{
    const compress_options_t* options = &request->compress;
    const bool entropy = options->cost == COST_ENTROPY_SUM || options->cost == COST_ENTROPY_MAX;
    if (options->exhaustive && compress_partition_count(model, options) > most_partitions) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "--method exhaustive would try %.3g partitions, expected at most %.0f: use dp",
                             compress_partition_count(model, options), most_partitions);
    }
    if (entropy && model->num_plays > most_entropy_plays) {
        return message_error(
            OUTCOME_USAGE, (location_t){.file = path},
            "%zu plays, expected at most %zu for an entropy cost: use wasserstein or variance",
            model->num_plays, most_entropy_plays);
    }
    return OUTCOME_OK;
}

/// Cost ensemble searches, and says so where that leads nowhere.
static outcome_t check_search(const char* path, outcome_t outcome)
{
    if (outcome == OUTCOME_USAGE) {
        return message_error(outcome, NOWHERE,
                             "--cost ensemble keeps at most %d plays, expected fewer or another cost",
                             ENSEMBLE_MOST_PLAYS);
    }
    if (outcome != OUTCOME_OK) {
        return message_error(
            outcome, (location_t){.file = path},
            "the least squares of --cost ensemble did not settle, expected milder weights or another cost");
    }
    return OUTCOME_OK;
}

static outcome_t compress_read(const options_t* options, const request_t* request, const char* path,
                               const model_t* before)
{
    outcome_t outcome = check_effort(request, path, before);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    compression_t compression;
    model_t after = request->to_tolerance
                        ? compress_to_tolerance(before, &request->compress, request->tolerance, &compression)
                        : compress_model(before, &request->compress, &compression);
    if (!request->to_tolerance && request->compress.num_plays > after.num_plays) {
        message_note((location_t){.file = path}, "only %zu plays are there to keep, %zu were asked for",
                     after.num_plays, request->compress.num_plays);
    }
    result_t result = {request, before, &after, &compression, (double)NAN};
    outcome = check_search(path, compression.outcome);
    if (outcome == OUTCOME_OK && options->worst_input != NULL) {
        outcome = write_worst_input(options->worst_input, &result);
    }
    if (outcome == OUTCOME_OK) {
        outcome = model_write(options->output, &after);
    }
    if (outcome == OUTCOME_OK && !output_is_stdout(options->output)) {
        (options->json != 0 ? report_json : report_text)(&result);
    }
    compression_free(&compression);
    model_free(&after);
    return outcome;
}

static outcome_t compress_file(const options_t* options, const request_t* request, const char* path)
{
    model_t before;
    outcome_t outcome = model_read(path, &before);
    if (outcome == OUTCOME_OK) {
        outcome = compress_read(options, request, path, &before);
        model_free(&before);
    }
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
        {"cost", 0, POPT_ARG_STRING, &options.cost, 0,
         "entropy-sum (default), entropy-max, wasserstein (least error bound), variance, ensemble (least "
         "RMS error) or uniform",
         "NAME"},
        {"method", 0, POPT_ARG_STRING, &options.method, 0,
         "dp (default), or exhaustive: try every partition, 10^7 at most", "NAME"},
        {"worst-input", 0, POPT_ARG_STRING, &options.worst_input, 0,
         "write the reversals that attain the error bound, as a record", "FILE"},
        {"unscaled", 0, POPT_ARG_NONE, &options.unscaled, 0,
         "do not count a play by how far it can move, Eq. (19)", NULL},
        {"json", 0, POPT_ARG_NONE, &options.json, 0, "print the result as JSON (needs -o FILE)", NULL},
        POPT_TABLEEND};
    const command_t command = {"compress", "MODEL", 1,
                               "Merges neighbouring plays until M are left, at the least cost of any "
                               "partition. The error bound holds\n"
                               "for every input within the range from negative saturation; --worst-input "
                               "gives the input that attains it."};
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
    free(options.method);
    free(options.worst_input);
    return outcome;
}
