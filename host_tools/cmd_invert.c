#include "effect_invert.h"
#include "model_run.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct {
    double* input;
    double* output;  ///< the model's, at that input
    double* clamped; ///< 0 or 1
    size_t num_clamped;
    double max_error; ///< largest |output - wanted| of the samples that are not clamped
} inverted_t;

static inverted_t invert_all(const model_run_t* run)
{
    const size_t num_samples = run->record->num_samples;
    const double* wanted = run->record->output;
    inverted_t result = {.input = xcalloc(num_samples, sizeof(double)),
                         .output = xcalloc(num_samples, sizeof(double)),
                         .clamped = xcalloc(num_samples, sizeof(double))};
    effect_run_t over = effect_run_new(run->model, run->record, run->num_uses > 0);
    effect_invert(&over, run->model, run->start, run->uses, run->num_uses, wanted, result.input,
                  result.clamped);
    over.input = result.input;
    effect_simulate(&over, run->model, run->start, run->uses, run->num_uses, result.output);
    effect_run_free(&over);
    for (size_t i = 0; i < num_samples; ++i) {
        if (result.clamped[i] > 0.0) {
            result.num_clamped += 1;
        } else {
            result.max_error = fmax(result.max_error, fabs(result.output[i] - wanted[i]));
        }
    }
    return result;
}

static void inverted_free(inverted_t* inverted)
{
    free(inverted->input);
    free(inverted->output);
    free(inverted->clamped);
    *inverted = (inverted_t){0};
}

/// With the auxiliary columns where the model's effects follow one, so that the result can be simulated.
static outcome_t write_inverted(const model_run_t* run, const inverted_t* inverted)
{
    const record_t* record = run->record;
    record_column_t* columns = xcalloc(record->num_auxiliary + 4, sizeof *columns);
    size_t count = 0;
    if (record->time != NULL) {
        columns[count++] = (record_column_t){"time", record->time, false};
    }
    columns[count++] = (record_column_t){"input", inverted->input, false};
    columns[count++] = (record_column_t){"output", inverted->output, false};
    columns[count++] = (record_column_t){"clamped", inverted->clamped, true};
    bool follows = false;
    for (size_t u = 0; u < run->num_uses; ++u) {
        follows = follows || run->uses[u].effect->needs_column;
    }
    for (size_t i = 0; follows && i < record->num_auxiliary; ++i) {
        columns[count++] = (record_column_t){record->auxiliary[i].name, record->auxiliary[i].value, false};
    }
    const outcome_t outcome = record_write(run->output, columns, count, record->num_samples);
    free(columns);
    return outcome;
}

static void warn_clamped(const record_t* record, size_t num_clamped)
{
    if (num_clamped > 0) {
        message_warning((location_t){.file = record->path},
                        "%zu of %zu wanted outputs cannot be reached and are clamped", num_clamped,
                        record->num_samples);
    }
}

static outcome_t invert(const model_run_t* run)
{
    const record_t* record = run->record;
    const outcome_t invertible = effect_check_inverse(run->model_path, run->uses, run->num_uses);
    if (invertible != OUTCOME_OK) {
        return invertible;
    }
    inverted_t inverted = invert_all(run);
    outcome_t outcome = model_run_check_finite(run, "input", inverted.input);
    if (outcome == OUTCOME_OK) {
        outcome = model_run_check_finite(run, "output", inverted.output);
    }
    if (outcome == OUTCOME_OK) {
        warn_clamped(record, inverted.num_clamped);
        outcome = write_inverted(run, &inverted);
    }
    if (outcome == OUTCOME_OK && run->report) {
        printf(run->json ? "{\"samples\": %zu, \"clamped\": %zu, \"max_error\": %.9g}\n"
                         : "%zu samples, %zu clamped, largest round-trip error %.3g of those reached\n",
               record->num_samples, inverted.num_clamped, inverted.max_error);
    }
    inverted_free(&inverted);
    return outcome;
}

outcome_t cmd_invert(int argc, const char** argv)
{
    const command_t command = {
        "invert", "MODEL RECORD", 2,
        "Takes the record's output as wanted and writes time, the input within the "
        "model's range that gives it,\n"
        "the model's output there, and whether it was clamped to what can be reached "
        "(0 or 1). Starts at the\n"
        "input that the starting memory was left at: the least, the largest or the "
        "middle of the range, for the\n"
        "model's own states the middle of the inputs at which they are at rest. The model's effects are "
        "inverted with\n"
        "it; one that has no inverse (delay, slew_limit, quantization, widening, wear of the response) is "
        "refused."};
    return model_run(&command, (record_options_t){.needs_output = true}, invert, argc, argv);
}
