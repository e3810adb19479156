/// The catalogue of effects (CONTRACT, "Effects: the catalogue's names").
#ifndef HYST_HOST_EFFECT_H
#define HYST_HOST_EFFECT_H

#include <stdbool.h>

bool effect_is_known(const char* name);

#endif
