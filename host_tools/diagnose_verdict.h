/// The verdict over judged hypotheses: which is likeliest, how likely, and whether any will do.
#ifndef HYST_HOST_DIAGNOSE_VERDICT_H
#define HYST_HOST_DIAGNOSE_VERDICT_H

#include "diagnose.h"
#include "diagnose_search.h"

/// What hypotheses are weighed with, in squares of output units.
typedef struct {
    double noise; ///< the sensor's
    double known; ///< what the body left of its calibration, noise included
    double floor; ///< what no effect has to explain: noise, and what the body is known or expected to do
                  ///< beside the model on a record like this
    double grain; ///< differences below it do not count
    double floor_grain; ///< of that, in parts of the floor
} scale_t;

/// misfit: mean square of what the body leaves of its calibration. doubt: mean square by which
/// the body may be off on the record. gap: mean square of what the body leaves of the record.
scale_t scale_new(double noise, double misfit, double doubt, double gap);
/// The same where errors within half a converter's step are none: a normal error of standard deviation s
/// leaves of a step h the mean square (2/h) int a^2 P(a < error < a + h) da, about 0.53 s^3 / h where s is
/// small. gap: as for scale_new, of such errors. samples: judged; few of them lie near a step, so that what
/// is left is known less well.
scale_t scale_behind_steps(const scale_t* scale, double step, double gap, size_t samples);
/// Lowers the floor to what the record allows. least: the smallest mean square that a hypothesis leaves.
void scale_lower(scale_t* scale, double least);
/// What the floor may still be lowered to, where the body is as good on the record as on its calibration.
double scale_least_floor(const scale_t* scale);
/// How well a hypothesis stands, the less the better: the logarithm of what it leaves above the floor, and a
/// price for each effect.
double verdict_score(const scale_t* scale, const hypothesis_t* hypothesis);
/// The index of the best.
size_t verdict_best(const scale_t* scale, const candidates_t* candidates);
/// Fills the causes (but for their shrink), the verdict's first and then by probability, and what follows
/// from them.
void verdict_find(const scale_t* scale, const candidates_t* candidates, diagnosis_t* diagnosis);

#endif
