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
} scale_t;

/// misfit: mean square of what the body leaves of its calibration. doubt: mean square by which
/// the body may be off on the record. gap: mean square of what the body leaves of the record.
scale_t scale_new(double noise, double misfit, double doubt, double gap);
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
