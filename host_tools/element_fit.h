/// Finds the element of a calibration record.
#ifndef HYST_HOST_ELEMENT_FIT_H
#define HYST_HOST_ELEMENT_FIT_H

#include "element.h"
#include <stdbool.h>

/// What to fit to: a record from negative saturation.
typedef struct {
    const double* input;
    const double* output;
    const bool* carried; ///< [num_samples] true: only there for the memory, or NULL
    size_t num_samples;
    double input_min, input_max;
    double noise; ///< RMS of the output's, > 0
} element_record_t;

/// Least squares of the simulated output over several starts, the curve smooth where the record does not say
/// more. *rmse: what it leaves of the samples that are not carried; infinite where there is no such element.
element_t element_fit(element_kind_t kind, const element_record_t* record, double* rmse);
/// derivatives[num_samples][ELEMENT_FREE] of element_run's output by shapes, gain and curve.
void element_derivatives(const element_t* element, const double* input, size_t num_samples,
                         double* derivatives);
/// precision[ELEMENT_FREE][ELEMENT_FREE]: upper triangle by columns of the inverse covariance of the fitted
/// numbers, as if every sample's error were independent and of the noise's size.
void element_precision(const element_t* element, const element_record_t* record, double* precision);

#endif
