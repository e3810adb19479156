#include "scalar.h"

#include <string.h>

static const char* const names[NUM_SCALARS] = {
    [SCALAR_F32] = "f32", [SCALAR_Q31] = "q31", [SCALAR_Q15] = "q15"};

const char* scalar_name(scalar_t scalar)
{
    return names[scalar];
}

scalar_t scalar_find(const char* name)
{
    scalar_t scalar = SCALAR_F32;
    while (scalar < NUM_SCALARS && strcmp(name, names[scalar]) != 0) {
        scalar++;
    }
    return scalar;
}
