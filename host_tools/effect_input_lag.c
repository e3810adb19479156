/// input_lag: first-order lag ahead of the hysteresis (thermal mass, an amplifier's RC).
///     tau dv'/dt = v - v', at rest at its first value before the record
/// Exact for a course that is linear between the samples. tau >= 0 [s], fitted over a fiftieth of a sample
/// ... half the record. Inverse: the lead v = v' + tau dv'/dt.
#include "effect_catalogue.h"
#include "effect_lag.h"
#include "effect_limits.h"

const effect_t effect_input_lag = {
    .name = "input_lag",
    .stage = EFFECT_DRIVE,
    .transferable = true,
    .num_parameters = 1,
    .parameter = &lag_parameter,
    .limits = lag_limits,
    .apply = lag_apply,
    .invert = lag_invert,
};
