/// A body that stands in for the model's plays in searches, of one kind or the other.
#ifndef HYST_HOST_STAND_IN_H
#define HYST_HOST_STAND_IN_H

#include "duhem.h"
#include "element.h"

typedef struct {
    bool is_element; ///< `element` is meant, not `duhem`
    element_t element;
    duhem_t duhem;
} stand_in_t;

/// output[num_samples] for input[num_samples] after the start's past; the first one raised by `shift`, from
/// where the rest follows. An element knows negative saturation only.
void stand_in_run(const stand_in_t* body, const model_t* model, start_t start, double shift,
                  const double* input, size_t num_samples, double* output);

/// What is without memory in it, at an input.
double stand_in_nonhysteretic(const stand_in_t* body, const model_t* model, double input);

#endif
