#include "model_run.h"
#include "reference.h"
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

static inverted_t invert_all(const model_t* model, start_t start, const double* wanted, size_t num_samples)
{
    inverted_t result = {.input = xcalloc(num_samples, sizeof(double)),
                         .output = xcalloc(num_samples, sizeof(double)),
                         .clamped = xcalloc(num_samples, sizeof(double))};
    reference_t reference = reference_start(model, start);
    for (size_t i = 0; i < num_samples; ++i) {
        const reference_inverse_t found = reference_inverse(&reference, wanted[i]);
        result.input[i] = found.input;
        result.output[i] = reference_step(&reference, found.input);
        if (found.clamped) {
            result.clamped[i] = 1.0;
            result.num_clamped += 1;
        } else {
            result.max_error = fmax(result.max_error, fabs(result.output[i] - wanted[i]));
        }
    }
    reference_free(&reference);
    return result;
}

static void inverted_free(inverted_t* inverted)
{
    free(inverted->input);
    free(inverted->output);
    free(inverted->clamped);
    *inverted = (inverted_t){0};
}

static outcome_t write_inverted(const char* path, const record_t* record, const inverted_t* inverted)
{
    const record_column_t columns[] = {{"time", record->time, false},
                                       {"input", inverted->input, false},
                                       {"output", inverted->output, false},
                                       {"clamped", inverted->clamped, true}};
    const size_t first = record->time != NULL ? 0 : 1;
    return record_write(path, columns + first, 4 - first, record->num_samples);
}

static outcome_t invert(const model_run_t* run)
{
    const record_t* record = run->record;
    inverted_t inverted = invert_all(run->model, run->start, record->output, record->num_samples);
    if (inverted.num_clamped > 0) {
        message_warning((location_t){.file = record->path},
                        "%zu of %zu wanted outputs cannot be reached and are clamped", inverted.num_clamped,
                        record->num_samples);
    }
    const outcome_t outcome = write_inverted(run->output, record, &inverted);
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
    const command_t command = {"invert", "MODEL RECORD", 2,
                               "Takes the record's output as wanted and writes time, the input within the "
                               "model's range that gives it,\n"
                               "the model's output there, and whether it was clamped to what can be reached "
                               "(0 or 1). Starts at the\n"
                               "input that the starting memory was left at: the least, the largest or the "
                               "middle of the range, for the\n"
                               "model's own states the middle of the inputs at which they are at rest."};
    return model_run(&command, (record_options_t){.needs_output = true}, invert, argc, argv);
}
