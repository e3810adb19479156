/// The search for explanations: hypotheses with none, one, two and three effects, fitted.
#ifndef HYST_HOST_DIAGNOSE_SEARCH_H
#define HYST_HOST_DIAGNOSE_SEARCH_H

#include "diagnose_hypothesis.h"

typedef struct {
    const gap_t* gap;
    const record_t* calibration; ///< for the auxiliary columns' values then, or NULL
    size_t num_threads;
    size_t count;
    hypothesis_t* hypothesis; ///< owned; 0 is the body without effects
    size_t num_singles;       ///< hypotheses 1 ... num_singles have one effect each
} candidates_t;

/// With the hypothesis of no effect.
candidates_t candidates_new(const gap_t* gap, const record_t* calibration, size_t num_threads);

/// Every effect in the catalogue, each mechanism and auxiliary column.
void candidates_add_singles(candidates_t* candidates);
/// Every pair with a leading single in it, briefly; the best of them are fitted further.
void candidates_add_pairs(candidates_t* candidates);
/// The best pair of names with each further effect; likewise.
void candidates_add_triples(candidates_t* candidates);

#endif
