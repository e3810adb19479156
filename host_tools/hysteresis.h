/// The plays' run with the effects that live inside the hysteresis. With all members at their neutral values
/// it gives reference_run's output to rounding.
#ifndef HYST_HOST_HYSTERESIS_H
#define HYST_HOST_HYSTERESIS_H

#include "field.h"
#include "loop_middle.h"
#include "model.h"

/// How the output's slope goes with the remanence: about the major loop's middle it scales by 1 + by_level *
/// level + even * (level^2 - 1) + odd * (level^3 - level).
typedef struct {
    double by_level, even, odd;
} stiffness_t;

/// What effects set; hysteresis_neutral() does nothing.
typedef struct {
    double play_lag;   ///< [s] every play follows where the rate-independent rule would put it with this time
                       ///< constant
    double lag_spread; ///< play_lag is 1 + lag_spread as long at the largest radius, in between by the radius
    double lag_hold;   ///< how far the strip is on its way as a sample begins: 0, it goes straight; 1, it is
                       ///< there at once
    double lag_direct; ///< 0 ... 1: this part of the major loop's middle comes at once, as the plays would
                       ///< give it without a lag, not with play_lag behind
    double approach; ///< [input/s] how fast the input came to its first sample, as plays with a lag tell; 0:
                     ///< at leisure
    double beyond; ///< 0 ... 1: where an approach from a saturation begins, in the strip of each play at that
                   ///< end of the range: 0, as a rise within the range leaves it; 1, as one from far beyond
    double widening; ///< envelope units per input unit/s: every radius grows by widening * |dv/dt|
    double
        level_gain; ///< the plays' sum moves 1 + level_gain * level as far, level = (v - middle) / half range
    double level_product; ///< the plays' sum, about its middle, scales by 1 + level_product * level
    double moving; ///< the plays see v + moving * half range * (their sum about its middle) / its half range
    double remanence_field; ///< the plays see v + remanence_field * half range * the output's remanence
    double
        shift_share; ///< 0 ... 1: how much of the mean fields, or of `shift`, the nonhysteretic part sees too
    stiffness_t stiffness;
    const loop_middle_t* middle; ///< for those above; may be NULL where they are 0
    field_t field;               ///< how what the plays see follows the input
    const double* shift; ///< [num_samples] added to what the plays see, where a search knows it; or NULL
    double wear;         ///< the plays' sum moves exp(-wear * travel / input_span) as far
    double fade;         ///< the plays' sum, about its middle, scales by exp(-fade * travel / input_span)
    double* width;       ///< [num_samples] owned: extra envelope units on every radius (exogenous), or NULL
    double* coercive;    ///< [num_samples] owned: what the plays see, about the range's middle, scales by 1 -
                         ///< this (exogenous), or NULL
    double* coercive_direct; ///< [num_samples] owned: the same of what the nonhysteretic part sees, or NULL
    const double*
        start_fraction; ///< [num_nodes] initial_state: where a play begins, node by node over the radii,
                        ///< between its strip's bottom (-1), the run's own start (0) and its top (1); or NULL
    size_t num_nodes;
    const double* turn; ///< [num_turns] initial_state: the inputs at which the past turned, between the run's
                        ///< own start and its first sample; or NULL
    size_t num_turns;
} hysteresis_t;

hysteresis_t hysteresis_neutral(void);
bool hysteresis_is_neutral(const hysteresis_t* hysteresis);
/// Whether the memory at the first sample is another than the run's own start leaves.
bool hysteresis_has_past(const hysteresis_t* hysteresis);
/// That start again.
void hysteresis_forget_past(hysteresis_t* hysteresis);
/// Whether nothing differs but what the plays see (field, coercive, shift).
bool hysteresis_sees_alone(const hysteresis_t* hysteresis);
void hysteresis_free(hysteresis_t* hysteresis);
/// Whether the plays themselves run as in the plain model, only on another input and with
/// another use of their sum, once the past has turned where it did.
bool hysteresis_keeps_plays(const hysteresis_t* hysteresis);
/// By how much the nonhysteretic part sees less than the field at a sample, where a coercive field takes it
/// along.
double hysteresis_set_back(const hysteresis_t* hysteresis, const model_t* model, size_t sample, double field);
/// Whether the output's slope goes with the remanence.
bool hysteresis_is_stiffened(const hysteresis_t* hysteresis);
/// What that makes of an output y at v.
double hysteresis_stiffened(const hysteresis_t* hysteresis, const model_t* model, double v, double y);
/// What the field inside becomes of the input: field[num_samples]. Of the nonhysteretic part `share` sees it.
void hysteresis_field(const hysteresis_t* hysteresis, const double* time, const double* input,
                      size_t num_samples, double* field);
/// What the plays see at a sample of what the field inside has become, the mean fields not in it.
double hysteresis_seen(const hysteresis_t* hysteresis, const model_t* model, size_t sample, double field);
/// What remanence_field adds to what the plays see where the output is y at v.
double hysteresis_remanent_shift(const hysteresis_t* hysteresis, const model_t* model, double v, double y);
/// The output of such a run whose plays' sums are known: sum[num_samples], nonhysteretic[num_samples],
/// overwritten with the output.
void hysteresis_from_sums(const model_t* model, const hysteresis_t* hysteresis, const double* input,
                          const double* sum, size_t num_samples, double* nonhysteretic);
/// output[num_samples] for input[num_samples] at time[num_samples] (seconds, increasing).
void hysteresis_run(const model_t* model, start_t start, const hysteresis_t* hysteresis, const double* time,
                    const double* input, size_t num_samples, double* output);

/// Sample by sample.
typedef struct {
    const model_t* model;
    const hysteresis_t* hysteresis;
    double* memory; ///< [3 num_plays + 1] the states, scratch, what each play's lag leaves out of the last
                    ///< step, and that step
    field_state_t field;          ///< the input as it comes to the plays
    size_t sample;                ///< the present sample's index
    double input;                 ///< what the plays see
    double ascending, descending; ///< the envelopes there, where the plays have a lag
    double travel;
    double command;              ///< the input before field and mean field
    double sum;                  ///< of weight * state
    double nonhysteretic;        ///< the nonhysteretic part
    double sum_middle, sum_half; ///< of what it spans between the saturations
    double correction;           ///< what increments scaled by level_gain and wear have added so far
    double middle;               ///< the plays' middle in the major loop, where lag_direct counts
    double lagged_middle;        ///< the same with play_lag behind
    double ahead;                ///< what lag_direct adds
} hysteresis_state_t;
/// At the first sample, with the input first_input.
hysteresis_state_t hysteresis_start(const model_t* model, start_t start, const hysteresis_t* hysteresis,
                                    double first_input);
void hysteresis_state_free(hysteresis_state_t* state);
double hysteresis_output(const hysteresis_state_t* state);
/// The next sample, `step` seconds on; the output there.
double hysteresis_step(hysteresis_state_t* state, double input, double step);
/// The input within the model's range whose next sample gives `wanted`, nearest end where none does (then
/// *clamped). Looks, does not commit. Not for widening.
double hysteresis_inverse(const hysteresis_state_t* state, double wanted, double step, bool* clamped);

#endif
