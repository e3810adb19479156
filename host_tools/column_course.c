#include "column_course.h"

#include "model.h"
#include "sample_steps.h"
#include "series.h"
#include "white_noise.h"
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The likelihood is taken over so many stretches of so many samples, evenly spread over a longer record.
enum { STRETCHES = 4, STRETCH = 8192, LEAST_SAMPLES = 16 };
enum { BANDS = 2, ROWS = BANDS + 1 };

/// Smoothing in samples^3, tried in steps of half a decade: from next to none to some 300 samples wide.
static const double log10_least = -2;
static const double log10_most = 8;
static const double log10_step = 0.5;
static const double noise_at_most = 0.25;
/// Of the changes of sign that are possible; white noise makes 0.73.
static const double least_changes = 0.6;
/// A move from sample to sample of so many times the noise is a jump, and lasts as many samples.
static const double jump_from = 8;
static const double jump_lasts = 1000;

/// A = R + smoothing Q'Q of Reinsch's spline over one stretch; its unknowns are the second derivatives
/// inside.
typedef struct {
    size_t num_samples;
    const double* value;
    const double* step; ///< [num_samples - 1] times between samples, in usual ones
    double* bend;       ///< [num_samples - 2] Q' value
    double* band;       ///< [ROWS * (num_samples - 2)] A's upper bands, then its factor's
    double* solved;     ///< [num_samples - 2] A^-1 bend
} spline_t;

static size_t unknowns(const spline_t* s)
{
    return s->num_samples - 2;
}

static spline_t spline_new(const double* value, const double* step, size_t num_samples)
{
    spline_t s = {.num_samples = num_samples, .value = value, .step = step};
    const size_t m = unknowns(&s);
    s.bend = xmalloc(m * (2 + ROWS) * sizeof *s.bend);
    s.solved = s.bend + m;
    s.band = s.solved + m;
    for (size_t j = 0; j < m; j++) {
        s.bend[j] = (value[j + 2] - value[j + 1]) / step[j + 1] - (value[j + 1] - value[j]) / step[j];
    }
    return s;
}

static void spline_free(spline_t* s)
{
    free(s->bend);
}

/// Column j of A at band[ROWS * j]: two above the diagonal, one above it, on it.
static void fill_band(spline_t* s, double smoothing)
{
    for (size_t j = 0; j < unknowns(s); j++) {
        const double a = 1 / s->step[j];
        const double b = 1 / s->step[j + 1];
        double* column = &s->band[ROWS * j];
        column[2] = (s->step[j] + s->step[j + 1]) / 3 + smoothing * (a * a + (a + b) * (a + b) + b * b);
        column[1] = column[0] = 0;
        if (j > 0) {
            const double before = 1 / s->step[j - 1];
            column[1] = s->step[j] / 6 - smoothing * a * (before + 2 * a + b);
            column[0] = j > 1 ? smoothing * before * a : 0;
        }
    }
}

/// Solves for the second derivatives; returns log det A, infinite where A is singular to working precision.
static double spline_solve(spline_t* s, double smoothing)
{
    const lapack_int m = (lapack_int)unknowns(s);
    fill_band(s, smoothing);
    memcpy(s->solved, s->bend, unknowns(s) * sizeof *s->solved);
    if (LAPACKE_dpbtrf(LAPACK_COL_MAJOR, 'U', m, BANDS, s->band, ROWS) != 0 ||
        LAPACKE_dpbtrs(LAPACK_COL_MAJOR, 'U', m, BANDS, 1, s->band, ROWS, s->solved, m) != 0) {
        return HUGE_VAL;
    }
    double log_det = 0;
    for (size_t j = 0; j < unknowns(s); j++) {
        log_det += 2 * log(s->band[ROWS * j + BANDS]);
    }
    return log_det;
}

/// bend' A^-1 bend: of the walk's variance, the estimate times the number of unknowns.
static double spline_energy(const spline_t* s)
{
    double energy = 0;
    for (size_t j = 0; j < unknowns(s); j++) {
        energy += s->bend[j] * s->solved[j];
    }
    return energy;
}

/// Twice the negative log of the values' likelihood, the walk's variance at its best; smaller is likelier.
static double unlikeliness(spline_t* stretch, size_t count, double smoothing)
{
    double log_det = 0;
    double energy = 0;
    double m = 0;
    for (size_t k = 0; k < count; k++) {
        log_det += spline_solve(&stretch[k], smoothing);
        energy += spline_energy(&stretch[k]);
        m += (double)unknowns(&stretch[k]);
    }
    return m * log(energy / m) + log_det;
}

/// 0: none.
static double likeliest_smoothing(const double* value, const double* step, size_t num_samples)
{
    spline_t stretch[STRETCHES];
    const size_t count = num_samples > STRETCHES * STRETCH ? STRETCHES : 1;
    const size_t length = count > 1 ? STRETCH : num_samples;
    for (size_t k = 0; k < count; k++) {
        const size_t first = count > 1 ? k * (num_samples - length) / (count - 1) : 0;
        stretch[k] = spline_new(value + first, step + first, length);
    }
    double best = 0;
    double least = HUGE_VAL;
    for (double at = log10_least; at <= log10_most; at += log10_step) {
        const double smoothing = pow(10, at);
        const double found = unlikeliness(stretch, count, smoothing);
        // The least tried is none: what is likeliest there, or beyond, has no white noise.
        best = found < least && at > log10_least ? smoothing : best;
        least = found < least ? found : least;
    }
    for (size_t k = 0; k < count; k++) {
        spline_free(&stretch[k]);
    }
    return best;
}

/// course[num_samples] from the solved second derivatives: value - smoothing Q solved.
static void spline_values(const spline_t* s, double smoothing, double* course)
{
    memcpy(course, s->value, s->num_samples * sizeof *course);
    for (size_t j = 0; j < unknowns(s); j++) {
        const double a = 1 / s->step[j];
        const double b = 1 / s->step[j + 1];
        const double moved = smoothing * s->solved[j];
        course[j] -= moved * a;
        course[j + 1] += moved * (a + b);
        course[j + 2] -= moved * b;
    }
}

static bool is_noise_small(const double* value, const double* course, size_t num_samples)
{
    const double mean = series_mean(course, num_samples);
    double moved = 0;
    for (size_t i = 0; i < num_samples; i++) {
        moved += (course[i] - mean) * (course[i] - mean);
    }
    const double noise = series_mean_square(value, course, num_samples);
    return noise <= noise_at_most * noise_at_most * moved / (double)num_samples;
}

/// Whether second differences change their sign as often as white noise makes them: theirs are correlated by
/// -2/3, which is acos(-2/3) / pi = 0.73 of the time; those of a straight or a held course never do.
static bool shows_white_noise(const double* value, size_t num_samples)
{
    size_t changes = 0;
    for (size_t i = 3; i < num_samples; i++) {
        const double before = value[i - 3] - 2 * value[i - 2] + value[i - 1];
        const double after = value[i - 2] - 2 * value[i - 1] + value[i];
        changes += (before < 0 && after > 0) || (before > 0 && after < 0);
    }
    return (double)changes >= least_changes * (double)(num_samples - 3);
}

/// A jump counts as a long time: the course behind it owes nothing to the one before.
static double* steps_between(const double* time, const double* value, size_t num_samples)
{
    const double usual = sample_time_of(time, num_samples);
    const double largest = jump_from * white_noise(value, num_samples);
    double* step = xmalloc(num_samples * sizeof *step);
    for (size_t i = 0; i + 1 < num_samples; i++) {
        step[i] = (time[i + 1] - time[i]) / usual;
        step[i] =
            fabs(value[i + 1] - value[i]) > largest * fmax(step[i], 1) ? fmax(step[i], jump_lasts) : step[i];
    }
    return step;
}

double* column_course(const double* time, const double* value, size_t num_samples)
{
    double* course = xmalloc((num_samples + 1) * sizeof *course);
    memcpy(course, value, num_samples * sizeof *course);
    if (num_samples < LEAST_SAMPLES || !shows_white_noise(value, num_samples)) {
        return course;
    }
    double* step = steps_between(time, value, num_samples);
    const double smoothing = likeliest_smoothing(value, step, num_samples);
    spline_t whole = spline_new(value, step, num_samples);
    if (smoothing > 0 && isfinite(spline_solve(&whole, smoothing))) {
        spline_values(&whole, smoothing, course);
        if (!is_noise_small(value, course, num_samples)) {
            memcpy(course, value, num_samples * sizeof *course);
        }
    }
    spline_free(&whole);
    free(step);
    return course;
}
