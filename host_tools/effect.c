#include "effect.h"
#include "effect_catalogue.h"
#include <string.h>

static const effect_t* const catalogue[] = {
    &effect_gain_offset, &effect_delay,        &effect_input_lag,
    &effect_output_lag,  &effect_drift_linear, &effect_drift_spline,
};

size_t effect_count(void)
{
    return sizeof catalogue / sizeof catalogue[0];
}

const effect_t* effect_at(size_t index)
{
    return catalogue[index];
}

bool effect_is_known(const char* name)
{
    for (size_t i = 0; i < effect_count(); ++i) {
        if (strcmp(catalogue[i]->name, name) == 0) {
            return true;
        }
    }
    return strcmp(name, "unknown") == 0;
}
