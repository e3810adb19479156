/// The q15 interface under the names that cost_main.c and size_main.c use.
#ifndef HYST_COST_SCALAR_H
#define HYST_COST_SCALAR_H

#include "hyst/hyst_q15.h"
#include "hyst/hyst_q15_bank.h"

#define SCALAR(name) hyst_q15_##name

typedef int16_t sample_t;
typedef hyst_q15_segment_t memory_t;
typedef uint16_t saved_t;
typedef hyst_q15_reach_t reach_t;

#include "../fixed.h"

#endif
