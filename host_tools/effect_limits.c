#include "effect_limits.h"
#include <math.h>

static double within(double value, double low, double high)
{
    return fmin(fmax(value, low), high);
}

effect_limits_t limits_linear(double low, double high, double neutral, double start, double second,
                              double third)
{
    return (effect_limits_t){
        .low = low,
        .high = high,
        .neutral = within(neutral, low, high),
        .start = {within(start, low, high), within(second, low, high), within(third, low, high)}};
}

effect_limits_t limits_logarithmic(double low, double high, double neutral, double start, double second,
                                   double third)
{
    effect_limits_t limits = limits_linear(low, high, neutral, start, second, third);
    limits.logarithmic = true;
    return limits;
}

effect_limits_t limits_time_constant(const effect_run_t* run)
{
    const double low = 0.02 * run->sample_time;
    return limits_logarithmic(low, fmax(0.5 * run->duration, 2.0 * low), low, 5.0 * run->sample_time,
                              0.01 * run->duration, 30.0 * run->sample_time);
}

double limits_output_span(const effect_run_t* run)
{
    return run->output_span > 0.0 ? run->output_span : 1.0;
}
