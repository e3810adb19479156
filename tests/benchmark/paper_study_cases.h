/// The models and inputs of the study after sections 4 and 5 of Zhang et al. 2015.
#ifndef HYST_TESTS_PAPER_STUDY_CASES_H
#define HYST_TESTS_PAPER_STUDY_CASES_H

#include "model.h"
#include "random.h"

typedef enum {
    CASE_UNIFORM,   ///< equal weights, Table 2
    CASE_ONE_PEAK,  ///< Eq. (23), Table 3
    CASE_TWO_PEAKS, ///< Eq. (24), Table 4
    CASE_RANDOM,    ///< weights uniform on [0, 1)
    CASE_VO2,       ///< envelopes and radii of Table 6; weights ours
    NUM_CASES
} study_case_t;

enum { STUDY_PLAYS = 30 };

const char* study_case_name(study_case_t which);
/// 30 plays. The first four cases have the paper's radii j / 31 and, Table 1 missing, envelopes of our own:
/// tanh(v -+ 0.2) on [-4, 4]. `seed` is that of the random weights.
model_t study_model(study_case_t which, uint64_t seed);

typedef struct {
    size_t num_samples;
    double* input; ///< owned
} study_input_t;

void study_input_free(study_input_t* input);
/// 30 reversal points uniform over the model's range, from input_min on, a sample every 1/50 of the range.
study_input_t study_random_input(random_t* random, const model_t* model);
/// Like an identification record: alternations about the middle that decay from the whole range to a tenth.
study_input_t study_training_input(const model_t* model);
/// From input_min through three reversals: 0.9, 0.25, 0.7 of the range, to 0.4.
study_input_t study_third_order_input(const model_t* model);

typedef struct {
    double rmse;    ///< of the outputs' difference
    double mean;    ///< the difference's mean
    double largest; ///< its largest magnitude
} study_error_t;

/// Both from negative saturation.
study_error_t study_error(const model_t* model, const model_t* small, const study_input_t* input);

typedef struct {
    double mean, worst; ///< of the inputs' RMSE
    double refitted;    ///< RMSE over all inputs with the one constant that suits them best
} study_errors_t;

/// Over num_inputs random inputs.
study_errors_t study_random_errors(const model_t* model, const model_t* small, uint64_t seed, int num_inputs);

#endif
