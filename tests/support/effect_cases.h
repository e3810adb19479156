/// One model, one input, and every effect with parameters worth recovering from them.
#ifndef HYST_TESTS_EFFECT_CASES_H
#define HYST_TESTS_EFFECT_CASES_H

#include "effect.h"

enum { CASE_SAMPLES = 4000 };

/// gain: the largest amplification of a disturbance by what the effect does (the L1 norm of its impulse
/// response).
typedef struct {
    const char* name;
    const char* mechanism;
    double parameter[EFFECT_MAX_PARAMETERS];
    double gain;
} effect_case_t;

size_t effect_case_count(void);
const effect_case_t* effect_case_at(size_t index);
effect_use_t effect_case_use(const effect_case_t* of);

/// tanh envelopes, eight plays.
model_t effect_case_model(void);
/// The record of the cases: smooth motion with a hold, a column "temperature". Between the coarse samples,
/// which it always has, the input is linear: sub[num_sub] are the places (0 ... 1) of further samples in each
/// of them.
record_t effect_case_record(const double* sub, size_t num_sub);
/// No output of the model moves faster over the record: its steepest slope times the input's largest rate.
double effect_case_speed(const model_t* model, const record_t* record);
/// What two right computations of a case may differ by: a sampled course is known between its samples to half
/// a sample's motion, which the effect amplifies.
double effect_case_bound(const effect_case_t* of, const model_t* model, const record_t* record);

#endif
