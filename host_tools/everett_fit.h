/// The Everett function of a plant by its record, from negative saturation.
#ifndef HYST_HOST_EVERETT_FIT_H
#define HYST_HOST_EVERETT_FIT_H

#include "everett.h"
#include "record.h"

/// Fits what a record's output, where it is not carried, has beyond the model over its input: penalised
/// splines (P. H. C. Eilers, B. D. Marx, Statist. Sci. 11 (1996) 89), as smooth as makes the record most
/// probable (D. J. C. MacKay, Neural Comput. 4 (1992) 415). precision[EVERETT_FREE][EVERETT_FREE]: upper
/// triangle of the coefficients' inverse covariance for errors of variance 1, where the plant is not expected
/// to be off by more than `largest` [output]. *left: RMS that is left of stretches that the fit has not seen.
everett_t everett_fit(const model_t* model, const record_t* record, double largest, double* precision,
                      double* left);

#endif
