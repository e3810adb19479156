/// The q31 interface under the names that cost_main.c and size_main.c use.
#ifndef HYST_COST_SCALAR_H
#define HYST_COST_SCALAR_H

#include "hyst/hyst_q31.h"
#include "hyst/hyst_q31_bank.h"

#define SCALAR(name) hyst_q31_##name

typedef int32_t sample_t;
typedef hyst_q31_segment_t memory_t;
typedef uint32_t saved_t;
typedef hyst_q31_reach_t reach_t;

#include "../fixed.h"

#endif
