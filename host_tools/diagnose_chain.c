#include "diagnose_chain.h"

#include "input_file.h"
#include "model_file.h"
#include "reference.h"
#include "series.h"
#include "white_noise.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The words of the --chain that begins at argv[0], "--chain A B C" or "--chain=A B C"; returns how many
/// arguments it takes, 0 when it is none or not whole.
static int chain_words(int argc, const char** argv, chain_paths_t* paths)
{
    static const char joined[] = "--chain=";
    const bool is_joined = strncmp(argv[0], joined, sizeof joined - 1) == 0;
    const int length = is_joined ? 3 : 4;
    if (argc < length || !(is_joined || strcmp(argv[0], "--chain") == 0)) {
        return 0;
    }
    const char** rest = argv + length - 2;
    const chain_paths_t found = {is_joined ? argv[0] + sizeof joined - 1 : argv[1], rest[0], rest[1]};
    if (found.full[0] == '-' || found.compressed[0] == '-' || found.scalar[0] == '-') {
        return 0;
    }
    *paths = found;
    return length;
}

int chain_take(int argc, const char** argv, const char** rest, chain_paths_t* paths)
{
    int count = 0;
    bool options_end = false;
    for (int i = 0; i < argc; i++) {
        options_end = options_end || strcmp(argv[i], "--") == 0;
        const int taken = options_end ? 0 : chain_words(argc - i, argv + i, paths);
        if (taken > 0) {
            i += taken - 1;
        } else {
            rest[count++] = argv[i];
        }
    }
    return count;
}

static outcome_t read_plain_model(const char* path, model_t* model)
{
    const outcome_t outcome = model_read(path, model);
    if (outcome == OUTCOME_OK && json_array_size(model->effects) > 0) {
        return message_error(OUTCOME_BAD_INPUT, (location_t){.file = input_name(path)},
                             "the model has effects, which firmware does not run: --chain expects the models "
                             "that the header was made of");
    }
    return outcome;
}

static bool same_or_unnamed(const char* a, const char* b)
{
    return a[0] == '\0' || b[0] == '\0' || strcmp(a, b) == 0;
}

outcome_t chain_read(const chain_paths_t* paths, chain_t* chain)
{
    *chain = (chain_t){.paths = *paths, .scalar = scalar_find(paths->scalar)};
    if (chain->scalar == NUM_SCALARS) {
        return message_error(
            OUTCOME_USAGE, NOWHERE,
            "--chain: \"%s\" is no scalar that headers are made with, expected " SCALAR_NAMES, paths->scalar);
    }
    outcome_t outcome = read_plain_model(paths->full, &chain->full);
    if (outcome == OUTCOME_OK) {
        outcome = read_plain_model(paths->compressed, &chain->compressed);
    }
    if (outcome == OUTCOME_OK && !(same_or_unnamed(chain->full.input_unit, chain->compressed.input_unit) &&
                                   same_or_unnamed(chain->full.output_unit, chain->compressed.output_unit))) {
        return message_error(
            OUTCOME_BAD_INPUT, (location_t){.file = input_name(paths->compressed)},
            "its units are \"%s\" and \"%s\", expected those of the full model, \"%s\" and \"%s\"",
            chain->compressed.input_unit, chain->compressed.output_unit, chain->full.input_unit,
            chain->full.output_unit);
    }
    return outcome;
}

void chain_free(chain_t* chain)
{
    model_free(&chain->full);
    model_free(&chain->compressed);
}

double chain_misfit(const model_t* model, start_t start, const record_t* calibration, double* noise)
{
    double* difference = xmalloc(calibration->num_samples * sizeof *difference);
    reference_run(model, start, calibration->input, calibration->num_samples, difference);
    for (size_t t = 0; t < calibration->num_samples; t++) {
        difference[t] = calibration->output[t] - difference[t];
    }
    const size_t n = series_drop_carried(calibration->carried, difference, calibration->num_samples);
    // What identify left out, the memory at the start not being known, is no misfit of the model.
    const size_t given = scope_first_fitted(model);
    const size_t first = given < n ? given : 0;
    double sum = 0;
    for (size_t t = first; t < n; t++) {
        sum += difference[t] * difference[t];
    }
    *noise = white_noise(difference, n);
    free(difference);
    return sqrt(sum / (double)(n - first));
}

/// The full model's own misfit where it is known, else the diagnosed model's.
static double full_misfit(const chain_t* chain, start_t start, const diagnose_options_t* options)
{
    double noise;
    if (options->calibration != NULL) {
        return chain_misfit(&chain->full, start, options->calibration, &noise);
    }
    const json_t* rmse = json_object_get(chain->full.identification, "rmse");
    return json_is_number(rmse) ? json_number_value(rmse) : options->calibration_rmse;
}

outcome_t chain_budget(const chain_t* chain, const record_t* record, const diagnose_options_t* options,
                       const diagnosis_t* diagnosis, budget_t* budget)
{
    start_t start = options->start;
    if (start == START_MODEL) {
        start = START_NEGATIVE_SATURATION;
        message_note(NOWHERE,
                     "--chain: firmware knows no \"initial\" states, the budget starts from negative "
                     "saturation");
    }
    const budget_chain_t stages = {.full = &chain->full,
                                   .compressed = &chain->compressed,
                                   .compressed_path = chain->paths.compressed,
                                   .scalar = chain->scalar,
                                   .start = start,
                                   .verdict = diagnosis->is_unknown ? NULL : diagnosis->cause[0].hypothesis,
                                   .noise = diagnosis->noise,
                                   .misfit = full_misfit(chain, start, options)};
    effect_run_t run = effect_run_new(&chain->full, record, true);
    const outcome_t outcome = budget_find(&stages, &run, record->output, budget);
    effect_run_free(&run);
    return outcome;
}
