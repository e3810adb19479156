/// The next experiment: the input that would separate two explanations that a record cannot tell apart, or
/// show more of a gap that has none.
#ifndef HYST_HOST_DIAGNOSE_NEXT_H
#define HYST_HOST_DIAGNOSE_NEXT_H

#include "diagnose_hypothesis.h"
#include "diagnose_where.h"

typedef struct {
    const char* what; ///< "steps with long holds", ...
    size_t num_samples;
    double* time;      ///< [num_samples] s, owned
    double* input;     ///< [num_samples], owned
    double separation; ///< RMS distance of the two predictions over it [output]; 0 where a column's course
                       ///< decides, which nobody knows yet
} next_input_t;

/// Of steps with holds, one loop at several speeds, repeated loops, a sweep and loops of several sizes, all
/// within the model's range and as long as the record: the one on which the two hypotheses' predictions are
/// furthest apart.
next_input_t next_input_find(const gap_t* gap, const hypothesis_t* a, const hypothesis_t* b);
/// For a gap that nothing explains: of the same inputs the one that goes through values of the axis it lies
/// along, others being equal.
next_input_t next_input_along(const gap_t* gap, axis_t axis);
void next_input_free(next_input_t* next);

#endif
