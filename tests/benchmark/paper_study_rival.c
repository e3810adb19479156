#include "paper_study_rival.h"
#include "ensemble_gram.h"
#include "ensemble_polish.h"
#include "replace_plays.h"
#include <stdlib.h>

enum { NUM_STARTS = 20 };

static int compare(const void* a, const void* b)
{
    const double first = *(const double*)a;
    const double second = *(const double*)b;
    return (first > second) - (first < second);
}

/// The part of the output that the moving plays make, in scaled states.
static double* play_part(const model_t* model, const drive_t* drive)
{
    double* output = xcalloc(drive->num_samples, sizeof(double));
    double* state = xcalloc(drive->num_samples, sizeof(double));
    for (size_t j = 0; j < model->num_plays && model->radius[j] < drive->unit; ++j) {
        drive_states(drive, model->radius[j] / drive->unit, state, NULL);
        for (size_t t = 0; t < drive->num_samples; ++t) {
            output[t] += model->weight[j] * state[t];
        }
    }
    free(state);
    return output;
}

static ensemble_plays_t best_fit(const drive_t* drive, const double* output, double mean, double low,
                                 double high, size_t num_plays, uint64_t seed)
{
    random_t random = random_new(seed);
    ensemble_plays_t best = {0};
    for (int start = 0; start < NUM_STARTS; ++start) {
        ensemble_plays_t plays = ensemble_plays_new(num_plays);
        for (size_t k = 0; k < num_plays; ++k) {
            plays.radius[k] = random_uniform(&random, low, high);
        }
        qsort(plays.radius, num_plays, sizeof(double), compare);
        if (ensemble_polish(drive, output, mean, low, high, &plays) == OUTCOME_OK &&
            (best.num_plays == 0 || plays.rms < best.rms)) {
            ensemble_plays_free(&best);
            best = plays;
        } else {
            ensemble_plays_free(&plays);
        }
    }
    if (best.num_plays == 0) {
        message_error(OUTCOME_NUMERICAL, NOWHERE, "no start of the fit to one input converged");
        exit(OUTCOME_NUMERICAL);
    }
    return best;
}

model_t study_rival(const model_t* model, const study_input_t* input, size_t num_plays, uint64_t seed,
                    double* error_bound)
{
    drive_t drive = drive_of(model, input->input, input->num_samples);
    double* output = play_part(model, &drive);
    const double mean = centre(output, drive.num_samples);
    const size_t num_moving = model_count_moving(model);
    const double low = model->radius[0] / drive.unit;
    const double high = model->radius[num_moving - 1] / drive.unit;
    ensemble_plays_t fit = best_fit(&drive, output, mean, low, high, num_plays, seed);
    for (size_t k = 0; k < num_plays; ++k) {
        fit.radius[k] *= drive.unit;
    }
    const replacement_t replacement = {.plays = {fit.radius, fit.weight, num_plays},
                                       .constant = drive.unit * fit.constant};
    model_t small = replace_plays(model, &replacement);
    *error_bound = transport_bound(replacement_transport(model, &replacement), replacement.constant);
    ensemble_plays_free(&fit);
    free(output);
    drive_free(&drive);
    return small;
}
