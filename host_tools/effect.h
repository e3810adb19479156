/// The catalogue of effects (CONTRACT, "Effects: the catalogue's names"): what a plant can do beside its GPI
/// model. One file each (effect_NAME.c) behind this interface; adding one is that file and one line in
/// effect.c.
///
/// Order of a run: drive side (on the input) -> hysteresis -> body (on the hysteresis's output) -> sensor
/// side. Every effect is causal and knows time in seconds: the same parameters mean the same at any sample
/// rate, also an uneven one.
#ifndef HYST_HOST_EFFECT_H
#define HYST_HOST_EFFECT_H

#include "everett.h"
#include "fast_plays.h"
#include "hysteresis.h"
#include "message.h"
#include "model.h"
#include "record.h"
#include "stand_in.h"
#include <stdbool.h>

typedef enum { EFFECT_DRIVE, EFFECT_HYSTERESIS, EFFECT_BODY, EFFECT_SENSOR } effect_stage_t;

/// What an effect sees of the record it runs over.
typedef struct {
    size_t num_samples;
    const double* time;     ///< [num_samples] seconds; a record without time: one second a sample
    const double* input;    ///< [num_samples] the command, before any effect
    const record_t* record; ///< for auxiliary columns; may be NULL when no effect names one
    double** course;    ///< [record->num_auxiliary][num_samples] owned: theirs (column_course.h); NULL: no
                        ///< effect follows one
    double input_min;   ///< the model's
    double input_span;  ///< the model's input_max - input_min
    double output_span; ///< the range of the model's own output over this input
    double sample_time; ///< median of the time steps [s]
    double duration;    ///< [s]
    double output_min, output_max;    ///< the model's output between its two saturations, whatever the input
    double input_rate;                ///< the largest |d input/dt| between two samples
    double travel;                    ///< the sum of |d input|
    double largest_radius;            ///< of a play that the model's range can move, envelope units
    const loop_middle_t* middle;      ///< of the model
    const loop_middle_t* body_middle; ///< for searches: of what stands in for the model or is added; or NULL
    const fast_plays_t* fast;         ///< for searches: the model's plays prepared for one start, or NULL
    const stand_in_t* body; ///< for searches: stands in for the model's hysteresis, effects in it act as they
                            ///< do on the model's; or NULL
    double input_frequency; ///< for searches: of the line that carries most of the input [Hz]; 0: none does
    const everett_t* everett; ///< for searches: what a plant of Preisach's kind adds to the plays; or NULL
} effect_run_t;

enum { EFFECT_MAX_PARAMETERS = 40 };

/// A parameter, as it stands in the model file and in reports.
typedef struct {
    const char* name;
    const char* unit;   ///< "s", "Hz", "input", "output", "1", "input/s", ...
    double least, most; ///< what is physical; beyond it a model file is refused
    bool optional;      ///< 0 when a model file leaves it out
    bool is_unit;       ///< in what another counts: searches leave it at its neutral value
    bool of_model;      ///< says what the identified model's parts hold of the plant's, 0 ... 1: another body
                        ///< that stood in for a search had its own
    double scatter;     ///< how far plants scatter about 0, as a standard deviation: what a record does not
                        ///< tell a search leaves there; 0: any value is as likely
} effect_parameter_t;

/// Bounds and starts of a parameter on one record, for fitting.
typedef struct {
    double low, high;
    double neutral;   ///< the value (or limit) at which the effect does nothing, within [low, high]
    double start[3];  ///< where a search may begin, the likeliest first
    bool logarithmic; ///< search its logarithm (low > 0)
} effect_limits_t;

typedef struct effect effect_t;
struct effect {
    const char* name;      ///< the catalogue's
    const char* mechanism; ///< NULL, or which of several under one name ("lag", "envelope_shift"):
                           ///< "mechanism" in JSON
    const char* what;      ///< it is, for people
    const char* law; ///< its equation, in the parameters' names and the symbols of `hyst effects`; lines
                     ///< of what other parameters mean may follow
    effect_stage_t stage;
    bool transferable; ///< false: what was fitted holds for this record alone (drift, initial_state)
    bool needs_column; ///< exogenous: follows a named auxiliary column
    size_t num_parameters;
    const effect_parameter_t* parameter;
    bool is_linear;     ///< in its parameters: a search finds the same from every start
    bool has_threshold; ///< its first parameter gives no gradient where it does not act, or a narrow valley:
                        ///< searches try values
    /// What is wrong with parameters that are each physical (tau_fast above tau_slow), or NULL. May be NULL.
    const char* (*fault)(const double* parameter);
    /// Puts parameters that a search left in another order into theirs, without a change of what they do. May
    /// be NULL.
    void (*normalise)(double* parameter);
    /// Sets what was fitted to this record's own course to what is expected of another. May be NULL.
    void (*for_another_record)(double* parameter);
    void (*limits)(const effect_run_t* run, size_t parameter, effect_limits_t* limits);
    /// Whether with these parameters it cannot be told from another effect of the catalogue in the run (creep
    /// of one time constant is a lag), so that a fit that ends there says nothing for this one. May be NULL.
    bool (*is_another)(const effect_run_t* run, const double* parameter);
    /// Whether with these parameters it cannot be told from an answer to the run's own input, though it is
    /// meant to be unrelated to it: such a fit says nothing for it either. May be NULL.
    bool (*follows_input)(const effect_run_t* run, const double* parameter);
    /// drive, body, sensor: series[num_samples] in place. column: the auxiliary column's course, centred on
    /// its first value [num_samples], or NULL.
    void (*apply)(const effect_run_t* run, const double* parameter, const double* column, double* series);
    /// hysteresis: sets its part of how the plays run (hysteresis.h); several compose. exogenous has both.
    void (*configure)(const effect_run_t* run, const double* parameter, const double* column,
                      hysteresis_t* hysteresis);
    /// The inverse of apply, in place: the series that apply turns into this one. NULL: it has none.
    void (*invert)(const effect_run_t* run, const double* parameter, const double* column, double* series);
    double covers;   ///< by how much it counts for more than one effect when hypotheses are weighed, because
                     ///< its parameters can be another's as well
    bool superseded; ///< another mechanism of its name explains what it does: for model files, not for
                     ///< searches
    const char* outside; ///< no effect of the contract's catalogue: a search may find it, the verdict is then
                         ///< "unknown", and this tells what it looks like; NULL: one of the catalogue
    bool rounds;         ///< to the steps of a converter
    bool clips;          ///< invert leaves what it cannot reach where apply does not give it back
    const char* no_inverse; ///< why the effect has no inverse, as the end of a sentence; NULL: it has one
};

/// Every effect and mechanism, in the order in which a run applies them.
size_t effect_count(void);
const effect_t* effect_at(size_t index);
bool effect_is_known(const char* name);

/// An effect with its parameters, as a model's `effects` holds it.
typedef struct {
    const effect_t* effect;
    double parameter[EFFECT_MAX_PARAMETERS];
    char column[64]; ///< exogenous: the auxiliary column's name; else empty
    bool has_reference;
    double
        reference; ///< exogenous: the column's value at which nothing changes; without it the record's first
    bool is_of_one_record; ///< "transferable": false in the model file: fitted to one record's own course
} effect_use_t;

/// The use's column as its effect takes it, allocated; NULL when it follows none.
double* effect_use_column(const effect_run_t* run, const effect_use_t* use);
/// The run's description over a record (time, or 1 s a sample without it). follows_columns: whether effects
/// may run over it that follow an auxiliary column.
effect_run_t effect_run_new(const model_t* model, const record_t* record, bool follows_columns);
void effect_run_free(effect_run_t* run);
/// The middle of the major loop of what the run's `body` or `everett` makes of the model.
loop_middle_t* effect_run_find_middle(const effect_run_t* run, const model_t* model, start_t start);

/// The model with effects over the run's input, from `start`: output[num_samples]. uses in any order; applied
/// in the catalogue's. A model's own `effects` are not read. It is the second of these after the first:
void effect_simulate(const effect_run_t* run, const model_t* model, start_t start, const effect_use_t* uses,
                     size_t num_uses, double* output);
/// Drive side and hysteresis only, so that a search over the rest need not run the plays again.
void effect_simulate_hysteresis(const effect_run_t* run, const model_t* model, start_t start,
                                const effect_use_t* uses, size_t num_uses, double* output);
/// Body and sensor side, in place.
void effect_simulate_rest(const effect_run_t* run, const effect_use_t* uses, size_t num_uses, double* series);

/// Whether the record has every column that the uses follow; else OUTCOME_BAD_INPUT with the columns there
/// are.
outcome_t effect_check_columns(const record_t* record, const effect_use_t* uses, size_t num_uses);
/// One body, sensor or drive effect, or its inverse, over a series, with the column it follows.
void effect_use_apply(const effect_run_t* run, const effect_use_t* use, double* series);
void effect_use_invert(const effect_run_t* run, const effect_use_t* use, double* series);
/// How the plays run with these uses; hysteresis_free when done.
hysteresis_t effect_hysteresis(const effect_run_t* run, const effect_use_t* uses, size_t num_uses);

/// The limits of a use's parameter: its effect's, for exogenous in terms of the column's own size.
effect_limits_t effect_use_limits(const effect_run_t* run, const effect_use_t* use, size_t parameter);

/// The first thing wrong with a model's `effects` (NULL: nothing to check). "unknown" passes: it is a name
/// without a run.
model_fault_t effect_fault(const json_t* effects);
/// uses[*num_uses] from a model's `effects`, allocated; OUTCOME_BAD_INPUT with a message (location: the model
/// file's place where known) for an unknown type or mechanism, a missing, unknown or unphysical parameter.
outcome_t effect_uses_of_model(const model_t* model, const char* model_path, effect_use_t** uses,
                               size_t* num_uses);
/// What a search found, as its effect's parameters are meant to be read.
void effect_use_normalise(effect_use_t* use);
/// An entry for a model's `effects`: {"type", "mechanism"?, "column"?, parameters...}.
json_t* effect_use_to_json(const effect_use_t* use);

#endif
