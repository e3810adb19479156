/// How far the gap shrinks once a cause's effects are modelled, and which of them are worth handing out.
#ifndef HYST_HOST_DIAGNOSE_SHRINK_H
#define HYST_HOST_DIAGNOSE_SHRINK_H

#include "diagnose.h"

/// The model alone with these effects over a run, whatever body stands in there: output[run->num_samples].
void shrink_simulate(const gap_t* gap, const effect_run_t* run, const effect_use_t* uses, size_t num_uses,
                     double* output);
/// What that leaves of the judged samples: sum of squares of each block.
void shrink_block_errors(const gap_t* gap, const effect_use_t* uses, size_t num_uses, double* error);

/// The effects that the augmented model gets of a cause: uses[HYPOTHESIS_MAX_EFFECTS]; returns how many.
size_t cause_handed_out(const cause_t* cause, effect_use_t* uses);

/// Sets what a cause hands out, its shrink and interval, and rmse_after. plain: block errors without effects.
/// held_out: the hypothesis's block_error is there, and is taken where every effect is handed out. doubtful:
/// another cause may be the true one.
void shrink_find(const gap_t* gap, const double* plain, bool held_out, bool doubtful, cause_t* cause);

#endif
