#include "effect_invert.h"
#include "reference.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

outcome_t effect_check_inverse(const char* model_path, const effect_use_t* uses, size_t num_uses)
{
    for (size_t u = 0; u < num_uses; ++u) {
        const effect_t* effect = uses[u].effect;
        if (effect->no_inverse != NULL) {
            return message_error(OUTCOME_BAD_INPUT, (location_t){.file = model_path},
                                 "the effect \"%s\" cannot be inverted: %s", effect->name,
                                 effect->no_inverse);
        }
    }
    return OUTCOME_OK;
}

/// What a clipping effect does not give back was out of its reach.
static void flag_clipped(const effect_run_t* run, const effect_use_t* use, const double* wanted,
                         const double* found, double* clamped)
{
    const size_t size = run->num_samples * sizeof(double);
    double* again = memcpy(xmalloc(size), found, size);
    effect_use_apply(run, use, again);
    for (size_t i = 0; i < run->num_samples; ++i) {
        if (fabs(again[i] - wanted[i]) > 1e-12 * (fabs(wanted[i]) + fabs(found[i]))) {
            clamped[i] = 1.0;
        }
    }
    free(again);
}

static void invert_use(const effect_run_t* run, const effect_use_t* use, double* series, double* clamped)
{
    const size_t size = run->num_samples * sizeof(double);
    double* wanted = memcpy(xmalloc(size), series, size);
    effect_use_invert(run, use, series);
    if (use->effect->clips) {
        flag_clipped(run, use, wanted, series, clamped);
    }
    free(wanted);
}

/// One stage, last effect first.
static void invert_stage(const effect_run_t* run, const effect_use_t* uses, size_t num_uses,
                         effect_stage_t stage, double* series, double* clamped)
{
    for (size_t e = effect_count(); e-- > 0;) {
        const effect_t* effect = effect_at(e);
        for (size_t u = num_uses; effect->stage == stage && u-- > 0;) {
            if (uses[u].effect == effect && effect->invert != NULL) {
                invert_use(run, &uses[u], series, clamped);
            }
        }
    }
}

static void invert_plain(const model_t* model, start_t start, size_t num_samples, const double* wanted,
                         double* input, double* clamped)
{
    reference_t reference = reference_start(model, start);
    for (size_t i = 0; i < num_samples; ++i) {
        const reference_inverse_t found = reference_inverse(&reference, wanted[i]);
        input[i] = found.input;
        (void)reference_step(&reference, found.input);
        clamped[i] = found.clamped ? 1.0 : clamped[i];
    }
    reference_free(&reference);
}

/// The first input that comes nearest to giving `wanted` there.
static double first_input(const model_t* model, start_t start, const hysteresis_t* hysteresis, double wanted)
{
    double low = model->input_min;
    double high = model->input_max;
    // 2^-60 of the range is below its last bit.
    for (int i = 0; i < 60; ++i) {
        const double middle = low + 0.5 * (high - low);
        hysteresis_state_t state = hysteresis_start(model, start, hysteresis, middle);
        if (hysteresis_output(&state) < wanted) {
            low = middle;
        } else {
            high = middle;
        }
        hysteresis_state_free(&state);
    }
    return high;
}

static void invert_hysteresis(const effect_run_t* run, const model_t* model, start_t start,
                              const hysteresis_t* hysteresis, const double* wanted, double* input,
                              double* clamped)
{
    input[0] = first_input(model, start, hysteresis, wanted[0]);
    hysteresis_state_t state = hysteresis_start(model, start, hysteresis, input[0]);
    const double missed = fabs(hysteresis_output(&state) - wanted[0]);
    clamped[0] = missed > 1e-9 * (run->output_max - run->output_min) ? 1.0 : clamped[0];
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double step = run->time[i] - run->time[i - 1];
        bool beyond;
        input[i] = hysteresis_inverse(&state, wanted[i], step, &beyond);
        (void)hysteresis_step(&state, input[i], step);
        clamped[i] = beyond ? 1.0 : clamped[i];
    }
    hysteresis_state_free(&state);
}

/// The command must stay within the model's range too, which a lead may leave.
static void limit_command(const model_t* model, size_t num_samples, double* input, double* clamped)
{
    const double rounding = 1e-12 * (model->input_max - model->input_min);
    for (size_t i = 0; i < num_samples; ++i) {
        const double within = fmin(fmax(input[i], model->input_min), model->input_max);
        clamped[i] = fabs(within - input[i]) > rounding ? 1.0 : clamped[i];
        input[i] = within;
    }
}

void effect_invert(const effect_run_t* run, const model_t* model, start_t start, const effect_use_t* uses,
                   size_t num_uses, const double* wanted, double* input, double* clamped)
{
    if (run->num_samples == 0) {
        return;
    }
    const size_t size = run->num_samples * sizeof(double);
    double* series = memcpy(xmalloc(size), wanted, size);
    memset(clamped, 0, size);
    invert_stage(run, uses, num_uses, EFFECT_SENSOR, series, clamped);
    invert_stage(run, uses, num_uses, EFFECT_BODY, series, clamped);
    hysteresis_t hysteresis = effect_hysteresis(run, uses, num_uses);
    if (hysteresis_is_neutral(&hysteresis)) {
        invert_plain(model, start, run->num_samples, series, input, clamped);
    } else {
        invert_hysteresis(run, model, start, &hysteresis, series, input, clamped);
    }
    hysteresis_free(&hysteresis);
    invert_stage(run, uses, num_uses, EFFECT_DRIVE, input, clamped);
    limit_command(model, run->num_samples, input, clamped);
    free(series);
}
