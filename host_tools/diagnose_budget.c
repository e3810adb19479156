#include "diagnose_budget.h"

#include "firmware.h"
#include "reference.h"
#include "series.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/// The chain's outputs on the record, each [num_samples]; neighbours differ by one step, and the first from
/// the measured output by what the effects leave.
enum { WITH_EFFECTS, FULL, COMPRESSED, CLAMPED, TABULATED, FIRMWARE, NUM_STAGES };

static const struct {
    const char* name;
    const char* text;
} parts[BUDGET_PARTS] = {
    [BUDGET_UNMODELLED] = {"unmodelled", "effects that the model leaves out"},
    [BUDGET_IDENTIFICATION] = {"identification", "the full model's misfit on its calibration record"},
    [BUDGET_COMPRESSION] = {"compression", "fewer plays"},
    [BUDGET_CLAMPING] = {"clamping", "inputs beyond the model's range"},
    [BUDGET_TABLE] = {"table", "chords for curves"},
    [BUDGET_ROUNDING] = {"rounding", "storing and computing in the header's scalar"},
    [BUDGET_NOISE] = {"noise", "the sensor's noise"},
    [BUDGET_UNEXPLAINED] = {"unexplained", "what none of the others accounts for"},
};

const char* budget_part_name(budget_part_t part)
{
    return parts[part].name;
}

const char* budget_part_text(budget_part_t part)
{
    return parts[part].text;
}

void budget_describe_cross(const budget_t* budget, char* text, size_t size)
{
    (void)snprintf(text, size, "what the parts add or cancel between them, most of it %s with %s (%+.3f %%)",
                   parts[budget->pair[0]].name, parts[budget->pair[1]].name, 100 * budget->pair_share);
}

static outcome_t run_header(const budget_chain_t* chain, const effect_run_t* run, const double* clamped_input,
                            double* tabulated_output, double* firmware_output)
{
    firmware_t firmware;
    outcome_t outcome = firmware_new(chain->compressed, chain->compressed_path, chain->scalar, &firmware);
    if (outcome == OUTCOME_OK) {
        model_t chords = firmware_chords(&firmware, chain->compressed);
        reference_run(&chords, chain->start, clamped_input, run->num_samples, tabulated_output);
        model_free(&chords);
        outcome = firmware_run(&firmware, chain->start, run->input, run->num_samples, firmware_output);
    }
    firmware_free(&firmware);
    return outcome;
}

static outcome_t run_stages(const budget_chain_t* chain, const effect_run_t* run, double* stage[NUM_STAGES])
{
    const size_t n = run->num_samples;
    const hypothesis_t* verdict = chain->verdict;
    effect_simulate(run, chain->full, chain->start, verdict != NULL ? verdict->use : NULL,
                    verdict != NULL ? verdict->num_uses : 0, stage[WITH_EFFECTS]);
    reference_run(chain->full, chain->start, run->input, n, stage[FULL]);
    reference_run(chain->compressed, chain->start, run->input, n, stage[COMPRESSED]);
    double* clamped = xmalloc(n * sizeof *clamped);
    for (size_t t = 0; t < n; t++) {
        clamped[t] = fmin(fmax(run->input[t], chain->compressed->input_min), chain->compressed->input_max);
    }
    reference_run(chain->compressed, chain->start, clamped, n, stage[CLAMPED]);
    const outcome_t outcome = run_header(chain, run, clamped, stage[TABULATED], stage[FIRMWARE]);
    free(clamped);
    return outcome;
}

static int by_share(const void* a, const void* b)
{
    const double x = ((const budget_entry_t*)a)->share;
    const double y = ((const budget_entry_t*)b)->share;
    return (x < y) - (x > y);
}

/// Mean squares by part from the stages; what the effects leave goes to the noise first, then to the misfit
/// that the calibration showed.
static void share_out(const budget_chain_t* chain, double* const* stage, const double* measured, size_t n,
                      double* mean_square)
{
    const double noise = chain->noise * chain->noise;
    const double left = series_mean_square(stage[WITH_EFFECTS], measured, n);
    mean_square[BUDGET_NOISE] = fmin(noise, left);
    mean_square[BUDGET_IDENTIFICATION] =
        fmin(fmax(chain->misfit * chain->misfit - noise, 0), left - mean_square[BUDGET_NOISE]);
    mean_square[BUDGET_UNEXPLAINED] = left - mean_square[BUDGET_NOISE] - mean_square[BUDGET_IDENTIFICATION];
    mean_square[BUDGET_UNMODELLED] = series_mean_square(stage[FULL], stage[WITH_EFFECTS], n);
    mean_square[BUDGET_COMPRESSION] = series_mean_square(stage[COMPRESSED], stage[FULL], n);
    mean_square[BUDGET_CLAMPING] = series_mean_square(stage[CLAMPED], stage[COMPRESSED], n);
    mean_square[BUDGET_TABLE] = series_mean_square(stage[TABULATED], stage[CLAMPED], n);
    mean_square[BUDGET_ROUNDING] = series_mean_square(stage[FIRMWARE], stage[TABULATED], n);
}

/// The pair of steps with the largest product in cross_share; `total` is the mean square that shares are of.
static void find_pair(double* const* stage, const double* measured, size_t n, double total, budget_t* budget)
{
    static const budget_part_t steps[] = {BUDGET_UNEXPLAINED, BUDGET_UNMODELLED, BUDGET_COMPRESSION,
                                          BUDGET_CLAMPING,    BUDGET_TABLE,      BUDGET_ROUNDING};
    for (size_t i = 0; i < NUM_STAGES; i++) {
        const double* before_i = i == 0 ? measured : stage[i - 1];
        for (size_t j = 0; j < i; j++) {
            const double* before_j = j == 0 ? measured : stage[j - 1];
            double product = 0;
            for (size_t t = 0; t < n; t++) {
                product += (stage[i][t] - before_i[t]) * (stage[j][t] - before_j[t]);
            }
            const double share = 2 * product / (double)n / total;
            if (fabs(share) > fabs(budget->pair_share)) {
                budget->pair[0] = steps[i];
                budget->pair[1] = steps[j];
                budget->pair_share = share;
            }
        }
    }
}

static outcome_t add_up(const budget_chain_t* chain, double* const* stage, const double* measured, size_t n,
                        budget_t* budget)
{
    double mean_square[BUDGET_PARTS];
    share_out(chain, stage, measured, n, mean_square);
    const double total = series_mean_square(stage[FIRMWARE], measured, n);
    double sum = total;
    for (int part = 0; part < BUDGET_PARTS; part++) {
        sum += mean_square[part];
    }
    if (!isfinite(sum) || !(total > 0)) {
        return message_error(OUTCOME_NUMERICAL, NOWHERE,
                             "the firmware's mean square error is %g, expected one above 0 to share out",
                             total);
    }
    *budget =
        (budget_t){.total = sqrt(total), .cross_share = 1, .pair = {BUDGET_UNMODELLED, BUDGET_UNEXPLAINED}};
    find_pair(stage, measured, n, total, budget);
    for (int part = 0; part < BUDGET_PARTS; part++) {
        const double share = mean_square[part] / total;
        budget->entry[part] = (budget_entry_t){(budget_part_t)part, sqrt(mean_square[part]), share};
        budget->cross_share -= share;
    }
    qsort(budget->entry, BUDGET_PARTS, sizeof budget->entry[0], by_share);
    return OUTCOME_OK;
}

outcome_t budget_find(const budget_chain_t* chain, const effect_run_t* run, const double* measured,
                      budget_t* budget)
{
    const size_t n = run->num_samples;
    double* storage = xmalloc(NUM_STAGES * n * sizeof *storage);
    double* stage[NUM_STAGES];
    for (size_t i = 0; i < NUM_STAGES; i++) {
        stage[i] = storage + i * n;
    }
    outcome_t outcome = run_stages(chain, run, stage);
    if (outcome == OUTCOME_OK) {
        outcome = add_up(chain, stage, measured, n, budget);
    }
    free(storage);
    return outcome;
}
