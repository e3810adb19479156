/// The families of curves that identification searches: parameters theta (unbounded, for the non-linear
/// search) to envelopes over the scaled input u in [-1, 1], with their tangents.
///
/// linear  both envelopes the identity; no parameters.
/// tanh    tanh(e^t0 (u - t1)) ascending, tanh(e^t2 (u - t3)) descending.
/// table   knot values; increments are softplus(t) so that every theta gives strictly increasing envelopes.
/// Scale
///         and offset of a table are a gauge: fixed by ascending(1) = 1 and descending(-1) = -1.
/// The non-hysteretic part adds two parameters when it is a tanh; linear and table parts are linear in their
/// coefficients and belong to the non-negative least squares.
#ifndef HYST_HOST_IDENTIFY_SHAPE_H
#define HYST_HOST_IDENTIFY_SHAPE_H

#include "model.h"

typedef struct {
    curve_type_t envelope;
    curve_type_t nonhysteretic;
    size_t num_knots;      ///< of every table, >= 2; 0 when there is none
    double* knot;          ///< [num_knots] scaled inputs, -1 ... 1, owned
    size_t num_parameters; ///< of theta
    size_t num_raw;        ///< of the raw parameters: what the curves depend on directly
} shape_t;

/// The derivative of a curve's value at one input: two raw parameters at most.
typedef struct {
    size_t index[2];
    double value[2];
} tangent_t;

/// Where an input lies in the knots: value = (1 - fraction) y[cell] + fraction y[cell + 1].
typedef struct {
    size_t cell;
    double fraction;
} place_t;

shape_t shape_new(curve_type_t envelope, curve_type_t nonhysteretic, const double* knot, size_t num_knots);
void shape_free(shape_t* shape);
place_t shape_place(const shape_t* shape, double u);

/// theta of a neutral start: tanh of the given steepness and centres, tables through the same curves.
void shape_start(const shape_t* shape, double steepness, double ascending_centre, double descending_centre,
                 double* theta);
/// theta of the table that follows another shape's curves as well as its knots allow.
void shape_start_like(const shape_t* table, const shape_t* other, const double* other_theta, double* theta);

/// raw[num_raw] from theta, and the matrix d raw / d theta: jacobian[raw + num_raw * parameter].
void shape_raw(const shape_t* shape, const double* theta, double* raw);
void shape_raw_jacobian(const shape_t* shape, const double* theta, double* jacobian);

/// Envelope values at u from raw, and their tangents (NULL: not wanted).
double shape_ascending(const shape_t* shape, const double* raw, double u, place_t place, tangent_t* tangent);
double shape_descending(const shape_t* shape, const double* raw, double u, place_t place, tangent_t* tangent);

/// How many non-negative coefficients the non-hysteretic part has, and its k-th column's value at u.
size_t shape_num_nonhysteretic(const shape_t* shape);
double shape_nonhysteretic(const shape_t* shape, const double* raw, size_t k, double u, place_t place,
                           tangent_t* tangent);

/// The curves in physical input units, u = (v - centre) / half_range. coefficients: of the non-hysteretic
/// part.
curve_t shape_curve_ascending(const shape_t* shape, const double* raw, double centre, double half_range);
curve_t shape_curve_descending(const shape_t* shape, const double* raw, double centre, double half_range);
curve_t shape_curve_nonhysteretic(const shape_t* shape, const double* raw, const double* coefficients,
                                  double constant, double centre, double half_range);

#endif
