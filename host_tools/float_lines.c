#include "float_lines.h"
#include <math.h>

static float end_of_line(float value, float slope, float width)
{
    const float rise = slope * width;
    return value + rise;
}

float float_lines_slope(float low, float low_value, float high, float high_value)
{
    const float width = high - low;
    float slope = (float)(((double)high_value - (double)low_value) / ((double)high - (double)low));
    // Three roundings of the rise at most, so a few steps of the last place.
    while (slope > 0.0f && end_of_line(low_value, slope, width) > high_value) {
        slope = nextafterf(slope, 0.0f);
    }
    return slope;
}

float float_lines_loading(const float* radius, const float* weight, size_t count, hyst_f32_play_t* play)
{
    double slope = 0.0;
    double loading = 0.0;
    double moment = 0.0;
    for (size_t j = 0; j < count; ++j) {
        play[j].opening = 2.0f * radius[j];
        play[j].loading = 0.0f;
        if (j > 0) {
            const float width = play[j].opening - play[j - 1].opening;
            loading += slope * ((double)play[j].opening - (double)play[j - 1].opening);
            play[j].loading =
                fmaxf((float)loading, end_of_line(play[j - 1].loading, play[j - 1].slope, width));
        }
        slope += (double)weight[j];
        moment += (double)weight[j] * (double)radius[j];
        play[j].slope = (float)slope;
    }
    return (float)moment;
}
