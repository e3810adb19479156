#include "command.h"
#include "diagnose.h"
#include "diagnose_structure.h"
#include "model_file.h"
#include "reference.h"
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
    char* initial;
    char* columns;
    double sample_rate;
    int json;
} options_t;

/// A cause's effects by name; an exogenous one with its column.
static json_t* names_of(const hypothesis_t* hypothesis)
{
    json_t* names = json_array();
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        const effect_use_t* use = &hypothesis->use[i];
        json_array_append_new(names, use->column[0] != '\0'
                                         ? json_sprintf("%s:%s", use->effect->name, use->column)
                                         : json_string(use->effect->name));
    }
    return names;
}

static bool is_transferable(const hypothesis_t* hypothesis)
{
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        if (!hypothesis->use[i].effect->transferable) {
            return false;
        }
    }
    return true;
}

static json_t* region_json(const region_t* region)
{
    json_t* object = json_pack("{s:s}", "axis", where_axis_name(region->axis));
    if (region->axis == AXIS_DIRECTION) {
        json_object_set_new(object, "value",
                            json_string(region->from > 0   ? "ascending"
                                        : region->from < 0 ? "descending"
                                                           : "holding"));
    } else {
        json_object_set_new(object, "from", json_real(region->from));
        json_object_set_new(object, "to", json_real(region->to));
    }
    json_object_set_new(object, "share", json_real(region->share));
    json_object_set_new(object, "lift", json_real(region->lift));
    json_object_set_new(object, "share_low", json_real(region->share_low));
    json_object_set_new(object, "share_high", json_real(region->share_high));
    return object;
}

static json_t* parameters_of(const hypothesis_t* hypothesis)
{
    json_t* list = json_array();
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        json_array_append_new(list, effect_use_to_json(&hypothesis->use[i]));
    }
    return list;
}

static json_t* cause_json(const cause_t* cause)
{
    json_t* object =
        json_pack("{s:o, s:f, s:f, s:f, s:f, s:f}", "effects", names_of(cause->hypothesis), "probability",
                  cause->probability, "rmse_after", cause->rmse_after, "shrink", cause->shrink, "shrink_low",
                  cause->shrink_low, "shrink_high", cause->shrink_high);
    json_object_set_new(object, "parameters", parameters_of(cause->hypothesis));
    if (!is_transferable(cause->hypothesis)) {
        json_object_set_new(object, "transferable", json_false());
    }
    return object;
}

static json_t* verdict_effects(const diagnosis_t* d)
{
    return d->is_unknown ? json_pack("[s]", "unknown") : names_of(d->cause[0].hypothesis);
}

static json_t* verdict_json(const diagnosis_t* d)
{
    json_t* sets = json_array();
    for (size_t k = 0; k < d->num_indistinguishable; k++) {
        json_array_append_new(sets, names_of(d->cause[d->indistinguishable[k]].hypothesis));
    }
    return json_pack("{s:o, s:b, s:o, s:s}", "effects", verdict_effects(d), "confident", d->confident,
                     "indistinguishable", sets, "advice", d->advice);
}

static json_t* diagnosis_json(const diagnosis_t* d)
{
    json_t* where = json_array();
    for (size_t i = 0; i < d->num_regions; i++) {
        json_array_append_new(where, region_json(&d->region[i]));
    }
    json_t* causes = json_array();
    for (size_t k = 0; k < d->num_causes && k < 10; k++) {
        json_array_append_new(causes, cause_json(&d->cause[k]));
    }
    return json_pack("{s:s, s:i, s:{s:f, s:f, s:f, s:f, s:f}, s:o, s:o, s:o}", "format", "hyst-diagnosis",
                     "version", 1, "gap", "rmse", d->rmse, "relative", d->relative, "noise", d->noise,
                     "noise_floor", d->noise_floor, "closable", d->closable, "where", where, "causes", causes,
                     "verdict", verdict_json(d));
}

static void print_names(const hypothesis_t* hypothesis)
{
    for (size_t i = 0; i < hypothesis->num_uses; i++) {
        const effect_use_t* use = &hypothesis->use[i];
        printf("%s%s%s%s", i > 0 ? " + " : "", use->effect->name, use->column[0] != '\0' ? ":" : "",
               use->column);
    }
    if (hypothesis->num_uses == 0) {
        printf("nothing beside noise");
    }
}

static void print_report(const diagnosis_t* d, const model_t* model)
{
    printf("gap: rmse %.6g %s, %.3g %% of the output's range; noise and known misfit account for %.6g\n",
           d->rmse, model->output_unit, 100 * d->relative, d->noise_floor);
    for (size_t i = 0; i < d->num_regions && i < 3 && d->closable > 0; i++) {
        char text[200];
        where_describe(&d->region[i], model->input_unit, model->output_unit, text, sizeof text);
        printf("where: %s (%.1f times its part of the samples)\n", text, d->region[i].lift);
    }
    for (size_t k = 0; k < d->num_causes && k < 5; k++) {
        const cause_t* cause = &d->cause[k];
        printf("cause: %4.0f %%  ", 100 * cause->probability);
        print_names(cause->hypothesis);
        printf(", leaves %.6g, shrink %.0f %% (%.0f to %.0f %%)\n", cause->rmse_after, 100 * cause->shrink,
               100 * cause->shrink_low, 100 * cause->shrink_high);
    }
    printf("verdict: ");
    if (d->is_unknown) {
        printf("unknown: no named effect explains it");
    } else {
        print_names(d->cause[0].hypothesis);
    }
    printf("%s\n", d->confident ? "" : " (not confident)");
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
    options->calibration = record;
    double* difference = xmalloc(record->num_samples * sizeof *difference);
    reference_run(model, options->start, record->input, record->num_samples, difference);
    double sum = 0;
    for (size_t t = 0; t < record->num_samples; t++) {
        difference[t] = record->output[t] - difference[t];
        sum += difference[t] * difference[t];
    }
    options->calibration_rmse = sqrt(sum / (double)record->num_samples);
    options->calibration_noise = white_noise(difference, record->num_samples);
    free(difference);
    return OUTCOME_OK;
}

/// The model with the verdict's effects, for -o.
static outcome_t write_augmented(const char* path, const model_t* model, const diagnosis_t* d)
{
    model_t augmented = model_copy(model);
    if (!d->is_unknown && d->cause[0].hypothesis->num_uses > 0) {
        json_decref(augmented.effects);
        augmented.effects = parameters_of(d->cause[0].hypothesis);
    }
    const outcome_t outcome = model_write(path, &augmented);
    model_free(&augmented);
    return outcome;
}

/// The verdict on a record that the diagnosis has not seen.
typedef struct {
    bool given;
    double before, after; ///< RMSE of the plain and of the augmented model
} realised_t;

static double rmse_on(const effect_run_t* run, const model_t* model, start_t start,
                      const hypothesis_t* hypothesis, const double* output)
{
    double* predicted = xmalloc(run->num_samples * sizeof *predicted);
    effect_simulate(run, model, start, hypothesis != NULL ? hypothesis->use : NULL,
                    hypothesis != NULL ? hypothesis->num_uses : 0, predicted);
    double sum = 0;
    for (size_t t = 0; t < run->num_samples; t++) {
        sum += (predicted[t] - output[t]) * (predicted[t] - output[t]);
    }
    free(predicted);
    return sqrt(sum / (double)run->num_samples);
}

static outcome_t realise(const options_t* given, const model_t* model, start_t start, const diagnosis_t* d,
                         realised_t* realised)
{
    if (given->test == NULL) {
        return OUTCOME_OK;
    }
    record_t record = {0};
    outcome_t outcome = record_read(given->test,
                                    &(record_options_t){.columns = given->columns,
                                                        .sample_rate = given->sample_rate,
                                                        .needs_input = true,
                                                        .needs_output = true},
                                    &record);
    const hypothesis_t* verdict = d->is_unknown ? NULL : d->cause[0].hypothesis;
    if (outcome == OUTCOME_OK && verdict != NULL) {
        outcome = effect_check_columns(&record, verdict->use, verdict->num_uses);
    }
    if (outcome == OUTCOME_OK) {
        effect_run_t run = effect_run_new(model, &record);
        *realised = (realised_t){true, rmse_on(&run, model, start, NULL, record.output),
                                 rmse_on(&run, model, start, verdict, record.output)};
        effect_run_free(&run);
    }
    record_free(&record);
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

static outcome_t report(const options_t* given, const model_t* model, start_t start, const diagnosis_t* d)
{
    realised_t realised = {0};
    outcome_t outcome = realise(given, model, start, d, &realised);
    if (outcome == OUTCOME_OK && given->output != NULL) {
        outcome = write_augmented(given->output, model, d);
    }
    if (outcome == OUTCOME_OK && given->next_input != NULL) {
        outcome = write_next_input(given->next_input, d);
    }
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    if (given->json) {
        json_t* object = diagnosis_json(d);
        if (realised.given) {
            json_object_set_new(object, "test",
                                json_pack("{s:f, s:f, s:f}", "rmse", realised.before, "rmse_after",
                                          realised.after, "shrink", 1 - realised.after / realised.before));
        }
        json_dumpf(object, stdout, JSON_INDENT(1) | JSON_REAL_PRECISION(9));
        putchar('\n');
        json_decref(object);
    } else {
        print_report(d, model);
        if (realised.given) {
            printf("test: rmse %.6g before, %.6g after, shrink %.0f %%\n", realised.before, realised.after,
                   100 * (1 - realised.after / realised.before));
        }
    }
    return OUTCOME_OK;
}

static outcome_t run_on(const options_t* given, const model_t* model, const char* path)
{
    record_t record = {0};
    const record_options_t wanted = {.columns = given->columns,
                                     .sample_rate = given->sample_rate,
                                     .needs_input = true,
                                     .needs_output = true};
    record_t calibration = {0};
    diagnose_options_t options = {0};
    outcome_t outcome = command_start(given->initial, model, &options.start);
    if (outcome == OUTCOME_OK) {
        outcome = calibrate(given, model, &calibration, &options);
    }
    if (outcome == OUTCOME_OK) {
        outcome = record_read(path, &wanted, &record);
    }
    diagnosis_t diagnosis = {0};
    if (outcome == OUTCOME_OK) {
        outcome = diagnose(model, &record, &options, &diagnosis);
    }
    if (outcome == OUTCOME_OK) {
        outcome = report(given, model, options.start, &diagnosis);
    }
    diagnosis_free(&diagnosis);
    record_free(&calibration);
    record_free(&record);
    return outcome;
}

static outcome_t run(const options_t* given, const char** paths)
{
    openblas_set_num_threads(1);
    model_t model = model_new("");
    model_free(&model);
    outcome_t outcome = model_read(paths[0], &model);
    if (outcome == OUTCOME_OK) {
        outcome = run_on(given, &model, paths[1]);
    }
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
         "another record: the realised shrink beside the predicted one", "RECORD"},
        {"next-input", 0, POPT_ARG_STRING, &given.next_input, 0,
         "writes the experiment that the advice names", "RECORD"},
        {"initial", 0, POPT_ARG_STRING, &given.initial, 0, "the memory at the start",
         "negative-saturation|positive-saturation|demagnetised|model"},
        RECORD_OPTIONS(&given.columns, &given.sample_rate),
        {"json", 0, POPT_ARG_NONE, &given.json, 0, "the result as JSON on stdout", NULL},
        POPT_TABLEEND};
    const command_t command = {"diagnose", "MODEL RECORD", 2,
                               "Tells where the gap between a model and a record lies, which unmodelled "
                               "effect causes it, and how far it\n"
                               "shrinks once the effect is modelled. Causes are judged on stretches of the "
                               "record that their fit has not seen."};
    const char* paths[2] = {NULL, NULL};
    bool finished = false;
    outcome_t outcome = command_parse(&command, options, argc, argv, paths, &finished);
    if (outcome == OUTCOME_OK && !finished) {
        outcome = run(&given, paths);
    }
    free(given.output);
    free(given.calibration);
    free(given.test);
    free(given.next_input);
    free(given.initial);
    free(given.columns);
    return outcome;
}
