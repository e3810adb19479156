/// The unknown memory at a record's start: leave out the stretch where it shows, recognise a saturation, or
/// estimate it.
#ifndef HYST_HOST_IDENTIFY_START_H
#define HYST_HOST_IDENTIFY_START_H

#include "identify_fit.h"
#include "identify_samples.h"

typedef struct {
    bool leave_out; ///< samples before the memory is wiped out do not enter the fit
    start_t start;  ///< what the run starts from; START_MODEL: `fraction`
    size_t num_plays;
    double* fraction; ///< [num_plays] where in its strip each play begins, -1 ... 1, owned
} start_plan_t;

/// Decides from the input alone: little of the record is lost by leaving the start out, or it begins at an
/// end of its range, or its memory must be estimated.
void start_plan_choose(start_plan_t* plan, const samples_t* samples, size_t num_plays);
void start_plan_free(start_plan_t* plan);

/// When a saturation explains the left-out stretch as well as the fit explains the rest, or as any past
/// would, uses the stretch too: plan->leave_out becomes false, plan->start the saturation, and all samples
/// are marked used.
void start_try_assumptions(start_plan_t* plan, fit_t* fit, samples_t* samples);

/// Least-squares estimate of `fraction` for the present fit.
void start_estimate(start_plan_t* plan, const fit_t* fit, const samples_t* samples);

/// Writes the estimated memory as the model's `initial`, the states at its first input.
void start_write_initial(const start_plan_t* plan, model_t* model, double first_input);

#endif
