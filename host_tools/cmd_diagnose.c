#include "command.h"
#include "diagnose.h"
#include "diagnose_chain.h"
#include "diagnose_json.h"
#include "diagnose_report.h"
#include "diagnose_shrink.h"
#include "diagnose_text.h"
#include "diagnose_trial.h"
#include "model_file.h"
#include "output_file.h"
#include "record_fill.h"
#include "reference.h"
#include "report_plot.h"
#include <cblas.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    char* output;
    char* calibration;
    char* test;
    char* next_input;
    char* report;
    char* chain_text; ///< what popt finds of a --chain that is not whole
    chain_paths_t chain;
    char* initial;
    char* columns;
    double sample_rate;
    int threads; ///< 0: not given
    int json;
} options_t;

static void print_report(const diagnosis_t* d, const model_t* model)
{
    printf("gap: rmse %.6g %s, %.3g %% of the output's range; noise and known misfit account for %.6g\n",
           d->rmse, model->output_unit, 100 * d->relative, d->noise_floor);
    if (d->scope.first_judged > 0) {
        printf("left out: the first %zu samples, whose memory is as unknown as that of the calibration's "
               "start\n",
               d->scope.first_judged);
    }
    if (d->num_judged + d->scope.first_judged < d->num_samples) {
        printf("judged by %zu of %zu samples, in full-rate stretches spread over the record\n", d->num_judged,
               d->num_samples);
    }
    for (size_t i = 0; i < d->num_regions && i < 3 && d->closable > 0; i++) {
        char text[200];
        where_describe(&d->region[i], model->input_unit, model->output_unit, text, sizeof text);
        printf("where: %s (%.1f times its part of the samples)\n", text, d->region[i].lift);
    }
    for (size_t k = 0; k < d->num_causes && k < 5; k++) {
        const cause_t* cause = &d->cause[k];
        char names[400];
        text_names(cause->hypothesis, names, sizeof names);
        printf("cause: %4.0f %%  %s, leaves %.6g, shrink %.0f %% (%.0f to %.0f %%)\n",
               100 * cause->probability, names, cause->rmse_after, 100 * cause->shrink,
               100 * cause->shrink_low, 100 * cause->shrink_high);
    }
    char verdict[400];
    text_verdict(d, verdict, sizeof verdict);
    printf("verdict: %s%s\n", verdict, d->confident ? "" : " (not confident)");
    if (d->advice[0] != '\0') {
        printf("advice: %s\n", d->advice);
    }
}

/// The calibration record's misfit and noise: from the record when it is given, else from what identify
/// wrote.
static outcome_t calibrate(const options_t* given, const model_t* model, record_t* record,
                           diagnose_options_t* options)
{
    if (given->calibration == NULL) {
        const json_t* rmse =
            model->identification != NULL ? json_object_get(model->identification, "rmse") : NULL;
        options->calibration_rmse = json_is_number(rmse) ? json_number_value(rmse) : 0;
        return OUTCOME_OK;
    }
    const record_options_t wanted = {.columns = given->columns,
                                     .sample_rate = given->sample_rate,
                                     .needs_input = true,
                                     .needs_output = true};
    const outcome_t outcome = record_read(given->calibration, &wanted, record);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    record_fill(record);
    options->calibration = record;
    options->calibration_rmse = chain_misfit(model, options->start, record, &options->calibration_noise);
    return OUTCOME_OK;
}

/// The model with the verdict's effects, for -o.
static outcome_t write_augmented(const char* path, const model_t* model, const diagnosis_t* d)
{
    model_t augmented = model_copy(model);
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    const size_t num_uses = diagnosis_handed_out(d, uses);
    if (num_uses > 0) {
        json_decref(augmented.effects);
        augmented.effects = parameters_to_json(uses, num_uses);
    }
    if (!d->is_unknown && num_uses < d->cause[0].hypothesis->num_uses) {
        message_note(NOWHERE,
                     "-o: %zu of the verdict's %zu effects would not help on another record and %s left out",
                     d->cause[0].hypothesis->num_uses - num_uses, d->cause[0].hypothesis->num_uses,
                     d->cause[0].hypothesis->num_uses - num_uses == 1 ? "is" : "are");
    }
    const outcome_t outcome = model_write(path, &augmented);
    model_free(&augmented);
    return outcome;
}

/// Shrink that came true on the test record.
static double realised(const trial_t* trial)
{
    return trial->before > 0 ? 1 - trial->after / trial->before : 0;
}

static json_t* trial_to_json(const trial_t* trial)
{
    return trial->is_measured ? json_pack("{s:f, s:f, s:f, s:f, s:f}", "rmse", trial->before, "rmse_after",
                                          trial->after, "shrink", realised(trial), "predicted_shrink",
                                          trial->predicted, "extrapolated", trial->extrapolated)
                              : json_pack("{s:f, s:f}", "predicted_shrink", trial->predicted, "extrapolated",
                                          trial->extrapolated);
}

static void print_trial(const trial_t* trial)
{
    if (trial->is_measured) {
        printf("test: rmse %.6g before, %.6g after, shrink %.0f %% (for this input %.0f %% were predicted)\n",
               trial->before, trial->after, 100 * realised(trial), 100 * trial->predicted);
    } else {
        printf("test: for this input a shrink of %.0f %% is predicted\n", 100 * trial->predicted);
    }
}

static outcome_t run_trial(const options_t* given, const model_t* model, start_t start,
                           const record_t* record, const diagnosis_t* d, trial_t* trial)
{
    record_t test = {0};
    outcome_t outcome = record_read(given->test,
                                    &(record_options_t){.columns = given->columns,
                                                        .sample_rate = given->sample_rate,
                                                        .needs_input = true,
                                                        .may_lack_output = true},
                                    &test);
    if (outcome == OUTCOME_OK) {
        outcome = trial_run(model, start, d, record, &test, trial);
    }
    record_free(&test);
    return outcome;
}

static outcome_t write_next_input(const char* path, const diagnosis_t* d)
{
    if (d->next.num_samples == 0) {
        message_note(NOWHERE, "--next-input: no further experiment is needed, nothing was written");
        return OUTCOME_OK;
    }
    const record_column_t columns[] = {{"time", d->next.time, false}, {"input", d->next.input, false}};
    return record_write(path, columns, 2, d->next.num_samples);
}

/// What a run found out.
typedef struct {
    diagnosis_t diagnosis;
    bool has_trial;
    trial_t trial;
    bool has_budget;
    budget_t budget;
} findings_t;

/// JSON has no infinity: OUTCOME_NUMERICAL (reported) where a number is one. *object: owned by the caller.
static outcome_t findings_json(const findings_t* found, json_t** object)
{
    *object = diagnosis_to_json(&found->diagnosis);
    bool is_whole = *object != NULL;
    if (is_whole && found->has_trial) {
        is_whole = json_object_set_new(*object, "test", trial_to_json(&found->trial)) == 0;
    }
    if (is_whole && found->has_budget) {
        const budget_t* budget = &found->budget;
        json_t* total = json_pack("{s:f, s:f, s:[s, s], s:f}", "rmse", budget->total, "cross_share",
                                  budget->cross_share, "cross_pair", budget_part_name(budget->pair[0]),
                                  budget_part_name(budget->pair[1]), "cross_pair_share", budget->pair_share);
        is_whole = json_object_set_new(*object, "budget", budget_to_json(budget)) == 0 &&
                   json_object_set_new(*object, "budget_total", total) == 0;
    }
    return is_whole ? OUTCOME_OK
                    : message_error(OUTCOME_NUMERICAL, NOWHERE,
                                    "--json: a number of the result is not finite, expected outputs in a "
                                    "unit that leaves room for their squares");
}

static void print_budget(const budget_t* budget)
{
    printf("budget: the firmware's rmse is %.6g; of its square:\n", budget->total);
    for (size_t i = 0; i < BUDGET_PARTS; i++) {
        const budget_entry_t* entry = &budget->entry[i];
        printf("budget: %8.3f %%  %-14s %.6g  %s\n", 100 * entry->share, budget_part_name(entry->part),
               entry->rmse, budget_part_text(entry->part));
    }
    char cross[200];
    budget_describe_cross(budget, cross, sizeof cross);
    printf("budget: %8.3f %%  cross terms: %s\n", 100 * budget->cross_share, cross);
}

/// object: what --json prints, or NULL.
static void print_findings(const options_t* given, const model_t* model, const findings_t* found,
                           const json_t* object)
{
    if (given->json) {
        json_dumpf(object, stdout, JSON_INDENT(1) | JSON_REAL_PRECISION(9));
        putchar('\n');
        return;
    }
    if (given->report != NULL && output_is_stdout(given->report)) {
        return;
    }
    print_report(&found->diagnosis, model);
    if (found->has_trial) {
        print_trial(&found->trial);
    }
    if (found->has_budget) {
        print_budget(&found->budget);
    }
}

static outcome_t write_files(const options_t* given, const model_t* model, const findings_t* found,
                             const report_t* report)
{
    outcome_t outcome = OUTCOME_OK;
    if (given->report != NULL) {
        outcome = report_write(given->report, report);
    }
    if (outcome == OUTCOME_OK && given->output != NULL) {
        outcome = write_augmented(given->output, model, &found->diagnosis);
    }
    if (outcome == OUTCOME_OK && given->next_input != NULL) {
        outcome = write_next_input(given->next_input, &found->diagnosis);
    }
    return outcome;
}

/// The diagnosis, what else was asked for, and only then the files.
static outcome_t find_and_report(const options_t* given, const char** paths, const model_t* model,
                                 const record_t* record, const diagnose_options_t* options,
                                 const chain_t* chain)
{
    findings_t found = {.has_trial = given->test != NULL, .has_budget = given->chain.full != NULL};
    outcome_t outcome = diagnose(model, record, options, &found.diagnosis);
    if (outcome == OUTCOME_OK && found.has_trial) {
        outcome = run_trial(given, model, options->start, record, &found.diagnosis, &found.trial);
    }
    if (outcome == OUTCOME_OK && found.has_budget) {
        outcome = chain_budget(chain, record, options, &found.diagnosis, &found.budget);
    }
    json_t* object = NULL;
    if (outcome == OUTCOME_OK && given->json) {
        outcome = findings_json(&found, &object);
    }
    if (outcome == OUTCOME_OK) {
        effect_run_t run = effect_run_new(model, record, true);
        const report_t report = {.model = model,
                                 .model_path = paths[0],
                                 .record_path = paths[1],
                                 .run = &run,
                                 .measured = record->output,
                                 .diagnosis = &found.diagnosis,
                                 .budget = found.has_budget ? &found.budget : NULL};
        outcome = write_files(given, model, &found, &report);
        effect_run_free(&run);
    }
    if (outcome == OUTCOME_OK) {
        print_findings(given, model, &found, object);
    }
    json_decref(object);
    diagnosis_free(&found.diagnosis);
    return outcome;
}

static outcome_t run_on(const options_t* given, const model_t* model, const char** paths,
                        const chain_t* chain)
{
    record_t record = {0};
    const record_options_t wanted = {.columns = given->columns,
                                     .sample_rate = given->sample_rate,
                                     .needs_input = true,
                                     .needs_output = true};
    record_t calibration = {0};
    diagnose_options_t options = {.num_threads = (size_t)given->threads};
    outcome_t outcome = command_start(given->initial, model, &options.start);
    if (outcome == OUTCOME_OK) {
        outcome = calibrate(given, model, &calibration, &options);
    }
    if (outcome == OUTCOME_OK) {
        outcome = record_read(paths[1], &wanted, &record);
    }
    if (outcome == OUTCOME_OK) {
        command_warn_outside(model, &record);
        outcome = find_and_report(given, paths, model, &record, &options, chain);
    }
    record_free(&calibration);
    record_free(&record);
    return outcome;
}

/// What can be refused before anything is read or fitted.
static outcome_t check_options(const options_t* given)
{
    if (given->chain_text != NULL) {
        return message_error(OUTCOME_USAGE, NOWHERE, "--chain takes three words, %s", CHAIN_ARGUMENTS);
    }
    if (given->threads < 0) {
        return message_error(OUTCOME_USAGE, NOWHERE, "--threads %d, expected at least 1 (0: one a processor)",
                             given->threads);
    }
    if (given->report == NULL) {
        return OUTCOME_OK;
    }
    if (given->json && output_is_stdout(given->report)) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "--json and --report both go to stdout, expected a file for the report");
    }
    return plot_check();
}

static outcome_t run(const options_t* given, const char** paths)
{
    openblas_set_num_threads(1);
    model_t model = model_new("");
    model_free(&model);
    chain_t chain = {0};
    outcome_t outcome = check_options(given);
    if (outcome == OUTCOME_OK) {
        outcome = model_read(paths[0], &model);
    }
    if (outcome == OUTCOME_OK) {
        outcome = command_refuse_effects(paths[0], &model, "the plain one, whose gap is to be explained");
    }
    if (outcome == OUTCOME_OK && given->chain.full != NULL) {
        outcome = chain_read(&given->chain, &chain);
    }
    if (outcome == OUTCOME_OK) {
        outcome = run_on(given, &model, paths, &chain);
    }
    chain_free(&chain);
    model_free(&model);
    return outcome;
}

outcome_t cmd_diagnose(int argc, const char** argv)
{
    options_t given = {0};
    const struct poptOption options[] = {
        {"output", 'o', POPT_ARG_STRING, &given.output, 0, "the model with the diagnosed effects", "MODEL"},
        {"calibration", 0, POPT_ARG_STRING, &given.calibration, 0, "the record the model was identified from",
         "RECORD"},
        {"test", 0, POPT_ARG_STRING, &given.test, 0,
         "another record: the realised shrink beside the predicted one; without an output, the predicted one",
         "RECORD"},
        {"next-input", 0, POPT_ARG_STRING, &given.next_input, 0,
         "writes the experiment that the advice names", "RECORD"},
        {"report", 0, POPT_ARG_STRING, &given.report, 0,
         "the diagnosis with plots, as one file (needs gnuplot)", "FILE.html"},
        {"chain", 0, POPT_ARG_STRING, &given.chain_text, 0,
         "also the firmware's error budget on the record, from the full model to the header",
         CHAIN_ARGUMENTS},
        {"initial", 0, POPT_ARG_STRING, &given.initial, 0, "the memory at the start",
         "negative-saturation|positive-saturation|demagnetised|model"},
        {"threads", 0, POPT_ARG_INT, &given.threads, 0,
         "for the searches (default: one a processor); the result is the same", "N"},
        RECORD_OPTIONS(&given.columns, &given.sample_rate),
        {"json", 0, POPT_ARG_NONE, &given.json, 0, "the result as JSON on stdout", NULL},
        POPT_TABLEEND};
    const command_t command = {
        "diagnose", "MODEL RECORD", 2,
        "Tells where the gap between a model and a record lies, which unmodelled "
        "effect causes it, and how far it\n"
        "shrinks once the effect is modelled. Causes are weighed by fits to the whole record;\n"
        "how far it shrinks is told from stretches of it."};
    const char* paths[2] = {NULL, NULL};
    bool finished = false;
    const char** rest = xcalloc((size_t)argc + 1, sizeof *rest);
    const int num_rest = chain_take(argc, argv, rest, &given.chain);
    outcome_t outcome = command_parse(&command, options, num_rest, rest, paths, &finished);
    if (outcome == OUTCOME_OK && !finished) {
        outcome = run(&given, paths);
    }
    free(rest);
    free(given.report);
    free(given.chain_text);
    free(given.output);
    free(given.calibration);
    free(given.test);
    free(given.next_input);
    free(given.initial);
    free(given.columns);
    return outcome;
}
