/// The next experiment: the input that would separate two explanations that a record cannot tell apart.
#ifndef HYST_HOST_DIAGNOSE_NEXT_H
#define HYST_HOST_DIAGNOSE_NEXT_H

#include "diagnose_hypothesis.h"

typedef struct {
    const char* what; ///< "steps with long holds", ...
    size_t num_samples;
    double* time;      ///< [num_samples] s, owned
    double* input;     ///< [num_samples], owned
    double separation; ///< RMS distance of the two predictions over it [output]
} next_input_t;

/// Of steps with holds, one loop at several speeds, repeated loops, a sweep and loops of several sizes, all
/// within the model's range and as long as the record: the one on which the two hypotheses' predictions are
/// furthest apart.
next_input_t next_input_find(const gap_t* gap, const hypothesis_t* a, const hypothesis_t* b);
void next_input_free(next_input_t* next);

#endif
