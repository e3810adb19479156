/// The GPI model in double precision, as the JSON model file holds it (CONTRACT, "Model").
#ifndef HYST_HOST_MODEL_H
#define HYST_HOST_MODEL_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

/// How many plays a model may have; firmware takes HYST_MAX_PLAYS of lib/ (hyst emit).
enum { MODEL_MAX_PLAYS = 1000000 };

typedef enum { CURVE_LINEAR, CURVE_TANH, CURVE_TABLE } curve_type_t;

/// gain * f(slope * v + shift) + offset with f the identity or tanh; or piecewise linear through (x, y),
/// continued beyond its ends with the end cells' slopes.
typedef struct {
    curve_type_t type;
    double slope, shift, gain, offset; ///< linear and tanh
    size_t num_knots;                  ///< table: >= 2
    double* x;                         ///< [num_knots] strictly increasing, input units
    double* y;                         ///< [num_knots]
} curve_t;

/// Which past a run starts from (CONTRACT, --initial).
typedef enum {
    START_NEGATIVE_SATURATION, ///< every play as left by a descent to input.min
    START_POSITIVE_SATURATION, ///< every play as left by an ascent to input.max
    START_DEMAGNETISED, ///< as left by a slowly decaying alternation about the middle of the input's range
    START_MODEL,        ///< the model's own `initial`
} start_t;

typedef struct {
    char* name;       ///< owned, never NULL
    char* input_unit; ///< owned, may be empty, never NULL
    char* output_unit;
    double input_min, input_max;
    curve_t ascending, descending, nonhysteretic; ///< any constant of the model is in nonhysteretic
    size_t num_plays;
    double* radius;         ///< [num_plays] >= 0, not decreasing
    double* weight;         ///< [num_plays] >= 0
    double* initial;        ///< [num_plays] the plays' starting states, or NULL
    json_t* effects;        ///< owned array of modelled effects, or NULL
    json_t* identification; ///< owned object: what identify found out (fit error ...), or NULL; carried along
} model_t;

/// Value, slope (right-hand at a table's knot) at v. Total for finite v.
double curve_value(const curve_t* curve, double v);
double curve_slope(const curve_t* curve, double v);
/// The least v with curve_value(v) >= value for a strictly increasing curve, within [low, high].
double curve_inverse(const curve_t* curve, double value, double low, double high);
/// Adds a constant to the curve's value everywhere; scales value about 0.
void curve_add(curve_t* curve, double constant);
void curve_scale(curve_t* curve, double factor);
curve_t curve_linear(double slope, double shift);
curve_t curve_tanh(double slope, double shift);
/// Copies x and y [num_knots].
curve_t curve_table(const double* x, const double* y, size_t num_knots);
curve_t curve_copy(const curve_t* curve);
void curve_free(curve_t* curve);

/// An empty model: identity envelopes, D = 0, range [0, 1], no plays. model_free takes any model and zeroes
/// it.
model_t model_new(const char* name);
model_t model_copy(const model_t* model);
void model_free(model_t* model);
/// Allocates radius and weight for num_plays plays, zeroed; frees former ones and `initial`.
void model_set_num_plays(model_t* model, size_t num_plays);

/// Half the envelopes' range, (ascending(input_max) - descending(input_min)) / 2: a play whose radius reaches
/// it never moves (THEORY section 1).
double model_largest_moving_radius(const model_t* model);
/// The largest (ascending(v) - descending(v)) / 2 over the range, not below 0: no radius may be less, or the
/// play's two branches cross.
double model_least_radius(const model_t* model);

/// What two quantities in envelope units may differ by and still count as equal, so that a model survives
/// being written with 15 digits.
double model_tolerance(const model_t* model);
/// The inputs [*low, *high] within the range at which every play of `initial` (not NULL) is inside its strip
/// [ascending(v) - r, descending(v) + r]; false when there are none.
bool model_initial_inputs(const model_t* model, double* low, double* high);

/// The first thing wrong with a model, as a path into its JSON ("weights", index 3) and a sentence.
typedef struct {
    const char* key;    ///< NULL: nothing is wrong
    const char* subkey; ///< NULL: the key itself
    long index;         ///< -1: not an element
    char text[200];     ///< what is wrong, what was expected
} model_fault_t;
/// Checks everything: finite numbers, range, radii >= 0 and not decreasing, weights >= 0, envelopes strictly
/// increasing over the range, D not decreasing, ascending - r <= descending + r for the least radius,
/// `initial` within reach. Tables must cover nothing in particular (they continue), but need >= 2 knots with
/// increasing x.
model_fault_t model_check(const model_t* model);

/// malloc/calloc that end the program with a message and OUTCOME_IO when memory is out; never return NULL.
void* xmalloc(size_t size);
void* xcalloc(size_t count, size_t size);
void* xrealloc(void* pointer, size_t size);
char* xstrdup(const char* text);

#endif
