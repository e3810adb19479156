#include "effect.h"
#include <stddef.h>
#include <string.h>

bool effect_is_known(const char* name)
{
    static const char* const catalogue[] = {
        "gain_offset",
        "delay",
        "input_lag",
        "slew_limit",
        "rate_dependence",
        "creep",
        "noncongruency",
        "wear",
        "initial_state",
        "output_lag",
        "resonance",
        "backlash",
        "output_saturation",
        "output_nonlinearity",
        "drift",
        "periodic_disturbance",
        "quantization",
        "exogenous",
        "unknown",
    };
    for (size_t i = 0; i < sizeof catalogue / sizeof catalogue[0]; ++i) {
        if (strcmp(catalogue[i], name) == 0) {
            return true;
        }
    }
    return false;
}
