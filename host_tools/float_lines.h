/// Lines between stored float values, with slopes and values rounded as lib/ requires: computed in float, no
/// line ends above the value it leads to.
#ifndef HYST_HOST_FLOAT_LINES_H
#define HYST_HOST_FLOAT_LINES_H

#include "hyst/hyst_f32.h"
#include <stddef.h>

/// The largest such slope from (low, low_value) to (high, high_value), low < high, low_value <= high_value.
float float_lines_slope(float low, float low_value, float high, float high_value);

/// The table of plays of `count` radii, sorted, and weights. Returns the moment.
float float_lines_loading(const float* radius, const float* weight, size_t count, hyst_f32_play_t* play);

#endif
