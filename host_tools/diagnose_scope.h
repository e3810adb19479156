/// What of a record a model can be judged by: from where on its memory is known, how much of its input lies
/// where the model was identified, and whether that input is periodic.
#ifndef HYST_HOST_DIAGNOSE_SCOPE_H
#define HYST_HOST_DIAGNOSE_SCOPE_H

#include "effect.h"

typedef struct {
    /// How many samples at the record's start are not to be judged by. Where identify left out the
    /// calibration's start, since no memory that it can assume explains it, the same plant's record is left
    /// out likewise, to where both ends were visited of the input range of its first 30 %.
    size_t first_judged;
    /// The part of the samples, 0 ... 1, whose input lies beyond the model's range.
    double beyond;
    /// The part of the samples in loops that the calibration never made: the same way up or down from a
    /// reversal near the same input, to an eighth of the range, does not occur there. 0 without a
    /// calibration.
    double unvisited;
} scope_t;

/// The first sample of the calibration that the model was fitted to: those before are of an unknown past.
size_t scope_first_fitted(const model_t* model);
/// calibration: the record that the model was identified from, or NULL.
scope_t scope_of(const model_t* model, const record_t* calibration, const record_t* record);
/// Whether the record keeps to the model's range, by and large.
bool scope_is_within(const scope_t* scope);
/// Whether it also keeps to loops like the calibration's, so that what the model says there was measured.
bool scope_is_known(const scope_t* scope);
/// What to identify the model from instead, where it was not; else nothing.
void scope_advise(const scope_t* scope, const model_t* model, char* text, size_t size);
/// The frequency of the line that carries more than half of the input's variance, of at least four periods;
/// 0: there is none.
double scope_input_frequency(const effect_run_t* run);

#endif
