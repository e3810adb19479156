/// Finds the Duhem body of a calibration record.
#ifndef HYST_HOST_DUHEM_FIT_H
#define HYST_HOST_DUHEM_FIT_H

#include "duhem.h"
#include "record.h"

/// Least squares of the simulated output of the bench's record where that is not carried, smooth where the
/// record does not say more, and where it never was like the model. noise: RMS of the output's noise, > 0.
/// *rmse: what it leaves. precision[DUHEM_FREE][DUHEM_FREE]: upper triangle by columns of the free numbers'
/// inverse covariance, as if every sample's error were independent and of the noise's size.
duhem_t duhem_fit(const model_t* model, start_t start, const record_t* bench, double noise, double* rmse,
                  double* precision);

#endif
