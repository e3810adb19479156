/// Golden vectors: what a float model answers to a prescribed run, for the target to compare with.
#ifndef HYST_HOST_GOLDEN_H
#define HYST_HOST_GOLDEN_H

#include "hyst/hyst_f32.h"

enum { GOLDEN_STEPS = 96 };

/// Where step i goes, whatever the scalar: the input, as a part of the input's range, and the wanted output,
/// as a part of the reachable ones. Either may lie beyond 0 ... 1.
double golden_input(size_t i);
double golden_wanted(size_t i);

typedef struct {
    uint32_t input[GOLDEN_STEPS], output[GOLDEN_STEPS], wanted[GOLDEN_STEPS], inverse[GOLDEN_STEPS];
} golden_t;

/// Runs lib/ itself: over the whole range and beyond, through nested reversals that shrink and are wiped out
/// again, held samples, and wanted outputs within and beyond reach. Returns what hyst_f32_init says of the
/// model; *golden is set only with HYST_STATUS_OK.
hyst_status_t golden_make(const hyst_f32_model_t* model, golden_t* golden);

#endif
