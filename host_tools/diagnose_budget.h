/// The error budget along the chain: what each step from the plant to the firmware puts on the firmware's
/// output error on one record.
#ifndef HYST_HOST_DIAGNOSE_BUDGET_H
#define HYST_HOST_DIAGNOSE_BUDGET_H

#include "diagnose_hypothesis.h"
#include "scalar.h"

/// firmware - measured = rounding + table + clamping + compression + unmodelled + (the rest), sample by
/// sample; the rest's mean square is shared out over noise, identification and what none of them explains.
typedef enum {
    BUDGET_UNMODELLED,     ///< the verdict's effects, which the full model leaves out
    BUDGET_IDENTIFICATION, ///< the full model's misfit on its calibration record, above the noise
    BUDGET_COMPRESSION,    ///< fewer plays
    BUDGET_CLAMPING,       ///< inputs beyond the model's range, which firmware clamps
    BUDGET_TABLE,          ///< chords for curves
    BUDGET_ROUNDING,       ///< storing and computing in the header's scalar
    BUDGET_NOISE,          ///< the sensor's
    BUDGET_UNEXPLAINED,    ///< what is left
    BUDGET_PARTS
} budget_part_t;

typedef struct {
    budget_part_t part;
    double rmse;  ///< [output]
    double share; ///< of the total mean square
} budget_entry_t;

typedef struct {
    double total;                       ///< RMS of firmware output less measured output
    budget_entry_t entry[BUDGET_PARTS]; ///< largest first
    double cross_share; ///< what the steps' errors add or cancel between them: the shares and this sum to 1
    budget_part_t pair[2]; ///< the two steps that add or cancel most; BUDGET_UNEXPLAINED stands for the rest
    double pair_share;     ///< their part of cross_share
} budget_t;

/// What is compared, and what is known beside it.
typedef struct {
    const model_t* full;
    const model_t* compressed;
    const char* compressed_path; ///< for messages
    scalar_t scalar;             ///< the header's
    start_t start;               ///< not START_MODEL: firmware starts from saturation or demagnetised
    const hypothesis_t* verdict; ///< its effects, or NULL when there are none to name
    double noise;                ///< the sensor's standard deviation [output]
    double misfit;               ///< the full model's RMSE on its calibration record [output], 0: not known
} budget_chain_t;

const char* budget_part_name(budget_part_t part);
/// What a user reads for the part.
const char* budget_part_text(budget_part_t part);
/// The cross terms in words.
void budget_describe_cross(const budget_t* budget, char* text, size_t size);
/// run: over the record (effect_run_new of the full model); measured[run->num_samples]. The firmware is the
/// header that `hyst emit` makes of the compressed model by default. OUTCOME_NUMERICAL with a message when it
/// cannot be made, or when the error is no number.
outcome_t budget_find(const budget_chain_t* chain, const effect_run_t* run, const double* measured,
                      budget_t* budget);

#endif
