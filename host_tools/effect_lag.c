#include "effect_lag.h"
#include "effect_limits.h"
#include "extremes.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void series_derivatives(const effect_run_t* run, const double* series, double* slope, double* curvature)
{
    const size_t count = run->num_samples;
    for (size_t i = 0; i < count; ++i) {
        slope[i] = 0.0;
        curvature[i] = 0.0;
        if (i == 0) {
            continue;
        }
        const double before = run->time[i] - run->time[i - 1];
        const double left = (series[i] - series[i - 1]) / before;
        if (i + 1 == count) {
            slope[i] = left;
            continue;
        }
        const double after = run->time[i + 1] - run->time[i];
        const double right = (series[i + 1] - series[i]) / after;
        slope[i] = (after * left + before * right) / (before + after);
        curvature[i] = 2.0 * (right - left) / (before + after);
    }
}

static double largest_defect(const double* wanted, const double* given, size_t count, double* defect)
{
    double largest = 0.0;
    for (size_t i = 0; i < count; ++i) {
        defect[i] = wanted[i] - given[i];
        largest = fmax(largest, fabs(defect[i]));
    }
    return largest;
}

void series_invert(const effect_run_t* run, const double* parameter, series_map_t* apply, series_map_t* lead,
                   double* series)
{
    enum { CORRECTIONS = 20 };
    const size_t count = run->num_samples;
    const size_t size = count * sizeof(double);
    double* wanted = memcpy(xmalloc(size), series, size);
    double* trial = xmalloc(size);
    double* given = xmalloc(size);
    double* defect = xmalloc(size);
    memcpy(trial, series, size);
    lead(run, parameter, trial);
    // Better than nothing is what the wanted series itself would give.
    memcpy(given, series, size);
    apply(run, parameter, given);
    double least = largest_defect(wanted, given, count, defect);
    for (int i = 0; i < CORRECTIONS; ++i) {
        memcpy(given, trial, size);
        apply(run, parameter, given);
        const double largest = largest_defect(wanted, given, count, defect);
        if (!(largest < least)) {
            break;
        }
        least = largest;
        memcpy(series, trial, size);
        lead(run, parameter, defect);
        for (size_t k = 0; k < count; ++k) {
            trial[k] += defect[k];
        }
    }
    free(wanted);
    free(trial);
    free(given);
    free(defect);
}

static double tau_at(const double* lag, double value)
{
    const bool grows = fabs(lag[LAG_GROWTH]) > 0.0;
    const double level = grows ? smaller(larger((value - lag[LAG_MIDDLE]) / lag[LAG_HALF], -1.0), 1.0) : 0.0;
    return lag[LAG_TAU] * (1.0 + lag[LAG_GROWTH] * level);
}

static void series_even_lag(const effect_run_t* run, const double* lag, double* series)
{
    lag_kept_t kept = {0};
    double from = run->num_samples > 0 ? series[0] : 0.0;
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double step = run->time[i] - run->time[i - 1];
        const double to = series[i];
        series[i] =
            lag_next(lag_step_kept(&kept, step, lag[LAG_TAU], lag[LAG_HOLD]), series[i - 1], from, to);
        from = to;
    }
}

void series_lag(const effect_run_t* run, const double* lag, double* series)
{
    if (!(fabs(lag[LAG_GROWTH]) > 0.0)) {
        series_even_lag(run, lag, series);
        return;
    }
    double from = run->num_samples > 0 ? series[0] : 0.0;
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double step = run->time[i] - run->time[i - 1];
        const double state = series[i - 1];
        const double to = series[i];
        series[i] = lag_next(lag_step_held(step, tau_at(lag, state), lag[LAG_HOLD]), state, from, to);
        const double half_way = 0.5 * (state + series[i]);
        series[i] = lag_next(lag_step_held(step, tau_at(lag, half_way), lag[LAG_HOLD]), state, from, to);
        from = to;
    }
}

static void series_lead(const effect_run_t* run, const double* lag, double* series)
{
    const size_t size = run->num_samples * sizeof(double);
    double* slope = xmalloc(size);
    double* curvature = xmalloc(size);
    series_derivatives(run, series, slope, curvature);
    for (size_t i = 0; i < run->num_samples; ++i) {
        series[i] += tau_at(lag, series[i]) * slope[i];
    }
    free(slope);
    free(curvature);
}

void series_lag_invert(const effect_run_t* run, const double* lag, double* series)
{
    series_invert(run, lag, series_lag, series_lead, series);
}

effect_limits_t hold_limits(void)
{
    return limits_linear(0.0, 1.0, 0.0, 0.1, 0.9, 0.5);
}
