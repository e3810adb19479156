#include "diagnose_guess.h"

#include "series.h"
#include "sinusoid.h"
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static double* difference_new(const gap_t* gap, const double* predicted)
{
    const size_t n = gap->run->num_samples;
    double* difference = xmalloc(n * sizeof *difference);
    for (size_t t = 0; t < n; t++) {
        difference[t] = gap->output[t] - predicted[t];
    }
    return difference;
}

static void guess_disturbance(const gap_t* gap, const double* predicted, effect_use_t* use)
{
    const effect_run_t* run = gap->run;
    double* difference = difference_new(gap, predicted);
    const sinusoid_t peak = strongest_sinusoid(run->time, run->sample_time, difference, run->num_samples);
    free(difference);
    const double guess[EFFECT_MAX_PARAMETERS] = {peak.frequency, peak.sine, peak.cosine};
    memcpy(use->parameter, guess, sizeof guess);
}

/// The line from where the machine runs evenly; then how far its phase was off before, by trying: more than
/// a quarter of a period off no gradient leads there.
static void guess_run_up(const gap_t* gap, const double* predicted, effect_use_t* use)
{
    enum { SHIFTS = 21, SETTLINGS = 3 };
    static const double settling[SETTLINGS] = {0.04, 0.08, 0.15};
    const effect_run_t* run = gap->run;
    const size_t n = run->num_samples;
    const size_t even = n * 3 / 10;
    double* difference = difference_new(gap, predicted);
    double* moved = xmalloc(n * sizeof *moved);
    const double frequency =
        strongest_sinusoid(run->time + even, run->sample_time, difference + even, n - even).frequency;
    double most = -1;
    for (size_t k = 0; k < SHIFTS * SETTLINGS; k++) {
        const double tau = settling[k % SETTLINGS] * run->duration;
        const double shift = ((double)(k / SETTLINGS) - SHIFTS / 2) * 0.1;
        for (size_t t = 0; t < n; t++) {
            moved[t] = run->time[t] + shift / frequency * exp(-(run->time[t] - run->time[0]) / tau);
        }
        sinusoid_t line = {.frequency = frequency};
        const double energy = sinusoid_fit(moved, difference, n, &line);
        if (energy > most) {
            const double guess[EFFECT_MAX_PARAMETERS] = {frequency, line.sine, line.cosine, 0, 0,
                                                         0,         0,         shift,       0, tau};
            most = energy;
            memcpy(use->parameter, guess, sizeof guess);
        }
    }
    free(difference);
    free(moved);
}

/// By trying: the response to a mode follows the work's own spectrum, so the gap's need not peak there. Modes
/// a tenth apart, as wide as their damping.
static void guess_mode(const gap_t* gap, const double* predicted, effect_use_t* use)
{
    enum { MODES = 48 };
    const effect_run_t* run = gap->run;
    const size_t n = run->num_samples;
    double* ringing = xmalloc(n * sizeof *ringing);
    effect_use_t trial = *use;
    double least = HUGE_VAL;
    for (size_t k = 0; k < MODES; k++) {
        const double guess[EFFECT_MAX_PARAMETERS] = {0.45 / run->sample_time * pow(1.1, -(double)k), 0.1};
        memcpy(trial.parameter, guess, sizeof guess);
        memcpy(ringing, predicted, n * sizeof *ringing);
        effect_use_apply(run, &trial, ringing);
        const double left = series_mean_square(ringing, gap->output, n);
        if (left < least) {
            least = left;
            memcpy(use->parameter, guess, sizeof guess);
        }
    }
    free(ringing);
}

/// A cause that follows a column c behind the plays, to second order: what is left as a sum of c, c y, c^2
/// and c^2 y, of which the last two tell the bend that goes best with the first two.
static void guess_column(const gap_t* gap, const double* predicted, effect_use_t* use)
{
    enum { TERMS = 4 };
    const effect_run_t* run = gap->run;
    double* column = effect_use_column(run, use);
    const double size = fmax(series_span(column, run->num_samples), DBL_MIN);
    double gram[TERMS * TERMS] = {0};
    double part[TERMS] = {0};
    for (size_t t = 0; t < run->num_samples; t++) {
        const double c = gap_is_judged(gap, t) ? column[t] / size : 0;
        const double y = predicted[t] / run->output_span;
        const double term[TERMS] = {c * y, c, c * c * y, c * c};
        for (size_t i = 0; i < TERMS; i++) {
            part[i] += term[i] * (gap->output[t] - predicted[t]);
            for (size_t k = 0; k < TERMS; k++) {
                gram[i * TERMS + k] += term[i] * term[k];
            }
        }
    }
    free(column);
    if (LAPACKE_dposv(LAPACK_COL_MAJOR, 'U', TERMS, 1, gram, TERMS, part, TERMS) == 0) {
        const double first = part[0] * part[0] + part[1] * part[1];
        const double bend = first > 0 ? (part[0] * part[2] + part[1] * part[3]) / first : 0;
        const double guess[EFFECT_MAX_PARAMETERS] = {part[0] / size / run->output_span, part[1] / size, 0,
                                                     fmin(fmax(bend, -0.5), 0.5) / size};
        memcpy(use->parameter, guess, sizeof guess);
    }
}

bool guess_parameters(const gap_t* gap, const double* predicted, effect_use_t* use)
{
    const bool disturbs = strcmp(use->effect->name, "periodic_disturbance") == 0;
    const bool rings = strcmp(use->effect->name, "resonance") == 0;
    const bool follows = use->effect->needs_column && use->effect->mechanism == NULL;
    if (disturbs && use->effect->mechanism != NULL) {
        guess_run_up(gap, predicted, use);
    } else if (disturbs) {
        guess_disturbance(gap, predicted, use);
    } else if (rings) {
        guess_mode(gap, predicted, use);
    } else if (follows) {
        guess_column(gap, predicted, use);
    }
    return disturbs || rings || follows;
}
