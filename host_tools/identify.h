/// Identification: a GPI model from a measured record.
#ifndef HYST_HOST_IDENTIFY_H
#define HYST_HOST_IDENTIFY_H

#include "message.h"
#include "model.h"
#include "record.h"

/// Which envelopes may be used; auto tries all and keeps the simplest that is not clearly worse.
typedef enum { IDENTIFY_AUTO, IDENTIFY_LINEAR, IDENTIFY_TANH, IDENTIFY_TABLE } identify_envelope_t;

typedef struct {
    size_t num_plays;
    identify_envelope_t envelope;
    bool has_range;              ///< the model's input range is given rather than the record's own
    double input_min, input_max; ///< it must contain the record's
} identify_options_t;

/// What became of the unknown memory at the record's start.
typedef enum {
    MEMORY_LEFT_OUT, ///< samples before first_fitted, where it still shows, are left out of the fit
    MEMORY_ASSUMED, ///< the saturation named by `start` explains the stretch as well as the rest is explained
    MEMORY_ESTIMATED, ///< fitted; stands in the model's `initial`
} identify_memory_t;

/// One family of curves that was tried.
typedef struct {
    curve_type_t envelope, nonhysteretic;
    double rmse; ///< output units, over the thinned record
} identify_candidate_t;

enum { IDENTIFY_MAX_CANDIDATES = 8, IDENTIFY_MAX_PLAYS = 1000 };

typedef struct {
    model_t model;
    size_t num_samples;  ///< of the record that were measured
    size_t first_fitted; ///< the first of them that entered the fit
    double rmse;         ///< of the model over the fitted samples, output units
    double relative;     ///< rmse over the output's range
    double max_error;    ///< largest |error| over the fitted samples
    double output_range;
    double monotone_floor; ///< rmse that no model with non-decreasing branches can go below on this record
    bool clockwise;        ///< the ascending branch lies above the descending one: no play does that
    identify_memory_t memory;
    start_t start;
    size_t num_undetermined; ///< plays that the record never moves: weight 0, not a finding
    bool* undetermined;      ///< [model.num_plays]
    size_t num_candidates;
    identify_candidate_t candidate[IDENTIFY_MAX_CANDIDATES];
} identify_result_t;

/// Fits the record's output to its input, both finite; what is carried moves the plays and is not fitted.
/// OUTCOME_BAD_INPUT: too short, constant input or output, or outside a given range. OUTCOME_NUMERICAL: the
/// least squares did not settle. Both reported; *result is then empty.
outcome_t identify(const record_t* record, const identify_options_t* options, identify_result_t* result);
void identify_result_free(identify_result_t* result);

/// Names for reports.
const char* identify_curve_name(curve_type_t type);

#endif
