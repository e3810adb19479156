/// The plays' run with the effects that live inside the hysteresis. With all members at their neutral values it gives
/// reference_run's output to rounding.
#ifndef HYST_HOST_HYSTERESIS_H
#define HYST_HOST_HYSTERESIS_H

#include "model.h"

/// What effects set; hysteresis_neutral() does nothing.
typedef struct {
    double play_lag;      ///< [s] every play follows where the rate-independent rule would put it with this time constant
    double widening;      ///< envelope units per input unit/s: every radius grows by widening * |dv/dt|
    double level_gain;    ///< the hysteretic output's increments scale by 1 + level_gain * (v - middle) / half range
    double wear;          ///< the hysteretic output's increments scale by exp(-wear * travel / input_span)
    const double* width;  ///< [num_samples] extra envelope units on every radius (exogenous), or NULL
    const double* start_fraction; ///< [num_nodes] initial_state: where in its strip a play begins, -1 ... 1, over the
                                  ///< radii, or NULL: the run's own start
    size_t num_nodes;
} hysteresis_t;

hysteresis_t hysteresis_neutral(void);
/// output[num_samples] for input[num_samples] at time[num_samples] (seconds, increasing).
void hysteresis_run(const model_t* model, start_t start, const hysteresis_t* hysteresis, const double* time,
                    const double* input, size_t num_samples, double* output);

#endif
