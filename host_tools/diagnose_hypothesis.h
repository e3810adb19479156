/// A hypothesis: the model with none, one or several effects, fitted to a record and judged on held-out
/// stretches.
#ifndef HYST_HOST_DIAGNOSE_HYPOTHESIS_H
#define HYST_HOST_DIAGNOSE_HYPOTHESIS_H

#include "effect.h"
#include "message.h"
#include "nuisance.h"

enum { HYPOTHESIS_MAX_EFFECTS = 3, HYPOTHESIS_BLOCKS = 24, HYPOTHESIS_FOLDS = 4 };

/// The gap and everything a fit needs of the record.
typedef struct {
    const model_t* model;
    const effect_run_t* run;
    start_t start;
    const double* output; ///< [run->num_samples] measured
    const bool* carried;  ///< [run->num_samples] true: only there for the memory (record_thin.h), or NULL
    size_t num_judged;    ///< samples that are not carried
    size_t
        block_end[HYPOTHESIS_BLOCKS]; ///< contiguous stretches; block b belongs to fold b % HYPOTHESIS_FOLDS
    double variance;                  ///< of what the output holds besides
    double dead_zone;                 ///< errors up to it are none: half a step of the output's converter
    nuisance_filter_t filter[HYPOTHESIS_FOLDS + 1]; ///< with each fold held out, and with none
} gap_t;

/// carried: as in gap_t; the blocks hold equally many of the other samples. nuisance: what the body leaves
/// open (no directions: nothing). variance: of what the output holds besides.
gap_t gap_new(const model_t* model, const effect_run_t* run, start_t start, const double* output,
              const bool* carried, const nuisance_t* nuisance, double variance);
void gap_free(gap_t* gap);
bool gap_is_judged(const gap_t* gap, size_t sample);
size_t gap_block_of(const gap_t* gap, size_t sample);

typedef struct {
    size_t num_uses; ///< 0: the plain model
    effect_use_t use[HYPOTHESIS_MAX_EFFECTS];
    double fit_rmse; ///< fitted to the whole record, the prices of what the body leaves open and of
                     ///< parameters off where plants have them (scatter) included
    bool cut_short;  ///< the last fit had not settled when its evaluations were used up
    bool is_another; ///< an effect's parameters make it another effect, or an answer to the input
    double block_error[HYPOTHESIS_BLOCKS]; ///< sum of squares of each block, predicted by a fit to the other
                                           ///< folds with the memory carried over; by hypothesis_judge
    double* predicted; ///< [num_samples] by the fit to the whole record, with what the body leaves open
                       ///< chosen for it; or NULL before it
} hypothesis_t;

hypothesis_t hypothesis_of(const effect_use_t* uses, size_t num_uses);
void hypothesis_free(hypothesis_t* hypothesis);
/// Whether one of its effects is the use's by name and column.
bool hypothesis_names_use(const hypothesis_t* hypothesis, const effect_use_t* use);
/// Whether all its effects act on what the plays give, so that a fit runs them once.
bool hypothesis_is_behind_plays(const hypothesis_t* hypothesis);
/// Whether the last one does, and not all.
bool hypothesis_ends_behind_plays(const hypothesis_t* hypothesis);
/// What an effect of it that is not of the catalogue looks like: what that explains is unknown. NULL: there
/// is none.
const char* hypothesis_outside(const hypothesis_t* hypothesis);
/// Whether both name the same effects (mechanisms aside).
bool hypothesis_same_names(const hypothesis_t* a, const hypothesis_t* b);

/// The effects' parameters at their start values (start 0 ... 2); neutral when start is -1.
void hypothesis_set_start(hypothesis_t* hypothesis, const gap_t* gap, int start);
/// Fits from the present parameters to all blocks but those of `held_out` (-1: to all); sets fit_rmse
/// and is_another.
void hypothesis_fit(hypothesis_t* hypothesis, const gap_t* gap, int held_out, int max_evaluations);
/// The same on all blocks with the last effect's parameters only.
void hypothesis_fit_last(hypothesis_t* hypothesis, const gap_t* gap, int max_evaluations);
/// Fits from the present parameters when `guessed`, and from all starts; keeps the best, fills `predicted`.
void hypothesis_search(hypothesis_t* hypothesis, const gap_t* gap, bool guessed, int max_evaluations);
/// A parameter at a bound hardly moves any more, though beside others it may belong elsewhere: fits once more
/// with those from the inside, and keeps that if it is better.
void hypothesis_retry_inside(hypothesis_t* hypothesis, const gap_t* gap, int max_evaluations);
/// Fills `predicted` for the present parameters.
void hypothesis_predict(hypothesis_t* hypothesis, const gap_t* gap);
/// Mean square by which it is weighed: with what the body leaves open priced, `fit_rmse` is the record's
/// marginal likelihood. Infinite for one that is another.
double hypothesis_mean_square(const hypothesis_t* hypothesis);
/// What its effects have to gain to be worth it: a logarithm of the ratio of what is left.
double hypothesis_price(const hypothesis_t* hypothesis);
/// Fills block_error by fits from the present parameters.
void hypothesis_judge(hypothesis_t* hypothesis, const gap_t* gap);

#endif
