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
/// Those of the verdict: none where it is unknown.
size_t diagnosis_handed_out(const diagnosis_t* diagnosis, effect_use_t* uses);

/// Parameters that say what the model's parts hold are fitted to the model, where another body stood in, and
/// those that the record says nothing about (a clip that one sample touches) become neutral: what a fit
/// left them at may act on another record.
void shrink_settle(const gap_t* gap, hypothesis_t* hypothesis);

/// What is expected of all causes together: the causes' predictions averaged by probability, which is nearest
/// in the mean square to whichever is true. average[gap's samples].
void shrink_average(const gap_t* gap, const cause_t* causes, size_t num_causes, double* average);

/// Sets what a cause hands out and what of that is bound to this record, its shrink and interval, and
/// rmse_after. Kept back are effects without which the record is met better (an output rounded like the
/// plant's is nearer to it only where the model is off by less than half a step) or `average` is (NULL: not
/// asked). plain: block errors without effects. held_out: the hypothesis's block_error is there, and is taken
/// where every effect is handed out.
void shrink_find(const gap_t* gap, const double* plain, bool held_out, const double* average, cause_t* cause);
/// Of a verdict that is not confident, after shrink_find: keeps back all of it where it takes away no more
/// than forecasts are off by.
void shrink_mind_doubt(const gap_t* gap, const double* plain, cause_t* cause);

#endif
