/// output_lag: first-order lag behind the hysteresis (a sensor, a filter).
///     tau dy'/dt = y - y', at rest at its first value before the record
/// Exact for a course that is linear between the samples. tau >= 0 [s], fitted over a fiftieth of a sample
/// ... half the record. Inverse: the lead y = y' + tau dy'/dt.
#include "effect_catalogue.h"
#include "effect_lag.h"
#include "effect_limits.h"

const effect_t effect_output_lag = {
    .name = "output_lag",
    .stage = EFFECT_SENSOR,
    .transferable = true,
    .num_parameters = 1,
    .parameter = &lag_parameter,
    .limits = lag_limits,
    .apply = lag_apply,
    .invert = lag_invert,
};
