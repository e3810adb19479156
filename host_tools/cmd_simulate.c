#include "effect_record.h"
#include "model_run.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/// How the model's output compares with the measured one.
typedef struct {
    double rmse, relative, max_error; ///< relative: rmse over the measured output's range, 0 where that is 0
} fit_t;

static fit_t compare(const double* measured, const double* modelled, size_t num_samples)
{
    double sum = 0.0;
    double low = measured[0];
    double high = measured[0];
    fit_t fit = {0};
    for (size_t i = 0; i < num_samples; ++i) {
        const double error = fabs(modelled[i] - measured[i]);
        sum += error * error;
        fit.max_error = fmax(fit.max_error, error);
        low = fmin(low, measured[i]);
        high = fmax(high, measured[i]);
    }
    fit.rmse = sqrt(sum / (double)num_samples);
    fit.relative = high > low ? fit.rmse / (high - low) : 0.0;
    return fit;
}

static outcome_t write_simulated(const char* path, const record_t* record, const double* output)
{
    record_column_t* columns = xcalloc(record->num_auxiliary + 3, sizeof *columns);
    size_t count = 0;
    if (record->time != NULL) {
        columns[count++] = (record_column_t){"time", record->time, false};
    }
    columns[count++] = (record_column_t){"input", record->input, false};
    columns[count++] = (record_column_t){"output", output, false};
    for (size_t i = 0; i < record->num_auxiliary; ++i) {
        columns[count++] = (record_column_t){record->auxiliary[i].name, record->auxiliary[i].value, false};
    }
    const outcome_t outcome = record_write(path, columns, count, record->num_samples);
    free(columns);
    return outcome;
}

static void report(const model_run_t* run, const double* output)
{
    const record_t* record = run->record;
    printf(run->json ? "{\"samples\": %zu" : "%zu samples", record->num_samples);
    if (record->output != NULL) {
        const fit_t fit = compare(record->output, output, record->num_samples);
        printf(run->json ? ", \"rmse\": %.9g, \"relative\": %.9g, \"max_error\": %.9g"
                         : ", rmse %.9g (%.3g of the measured output's range), largest error %.9g",
               fit.rmse, fit.relative, fit.max_error);
    }
    puts(run->json ? "}" : "");
}

static outcome_t simulate(const model_run_t* run)
{
    command_warn_outside(run->model, run->record);
    double* output = effect_simulate_record(run->model, run->start, run->record, run->uses, run->num_uses);
    outcome_t outcome = model_run_check_finite(run, "output", output);
    if (outcome == OUTCOME_OK) {
        outcome = write_simulated(run->output, run->record, output);
    }
    if (outcome == OUTCOME_OK && run->report) {
        report(run, output);
    }
    free(output);
    return outcome;
}

outcome_t cmd_simulate(int argc, const char** argv)
{
    const command_t command = {
        "simulate", "MODEL RECORD", 2,
        "Writes time, input, the model's output for that input, and the record's "
        "auxiliary columns. The model's\n"
        "effects are run with it (without time, a second a sample). Where the\n"
        "record has an output column, says how far the model's is from it; inputs that "
        "its logger lost are then\n"
        "put back. Beyond the model's input range its curves are continued, with a "
        "warning."};
    return model_run(&command, (record_options_t){.needs_input = true}, simulate, argc, argv);
}
