#include "identify_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Least increment of a table between neighbouring knots, as a part of an even increment: keeps envelopes
/// strictly increasing after rounding to single precision.
static const double least_increment = 1e-4;
/// The largest, likewise: steeper than any record tells, and the least ones still count beside it.
static const double most_increment = 1e3;

static size_t raw_of_envelopes(const shape_t* shape)
{
    switch (shape->envelope) {
    case CURVE_TANH:
        return 4;
    case CURVE_TABLE:
        return 2 * shape->num_knots;
    case CURVE_LINEAR:
        break;
    }
    return 0;
}

static size_t parameters_of_envelopes(const shape_t* shape)
{
    return shape->envelope == CURVE_TABLE ? 2 * (shape->num_knots - 1) : raw_of_envelopes(shape);
}

shape_t shape_new(curve_type_t envelope, curve_type_t nonhysteretic, const double* knot, size_t num_knots)
{
    shape_t shape = {.envelope = envelope, .nonhysteretic = nonhysteretic};
    if (envelope == CURVE_TABLE || nonhysteretic == CURVE_TABLE) {
        shape.num_knots = num_knots;
        shape.knot = xmalloc(num_knots * sizeof *knot);
        memcpy(shape.knot, knot, num_knots * sizeof *knot);
    }
    const size_t of_tanh = nonhysteretic == CURVE_TANH ? 2 : 0;
    shape.num_parameters = parameters_of_envelopes(&shape) + of_tanh;
    shape.num_raw = raw_of_envelopes(&shape) + of_tanh;
    return shape;
}

void shape_free(shape_t* shape)
{
    free(shape->knot);
    *shape = (shape_t){0};
}

place_t shape_place(const shape_t* shape, double u)
{
    if (shape->num_knots == 0) {
        return (place_t){0};
    }
    size_t low = 0;
    size_t high = shape->num_knots - 1;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (shape->knot[middle] <= u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return (place_t){low, (u - shape->knot[low]) / (shape->knot[low + 1] - shape->knot[low])};
}

static double even_increment(const shape_t* shape)
{
    return 2.0 / (double)(shape->num_knots - 1);
}

static double softplus(double t)
{
    return t > 30 ? t : log1p(exp(t));
}

static double increment_of(const shape_t* shape, double t)
{
    return even_increment(shape) * (fmin(softplus(t), most_increment) + least_increment);
}

/// d increment / d t.
static double increment_slope(const shape_t* shape, double t)
{
    return softplus(t) < most_increment ? even_increment(shape) / (1 + exp(-t)) : 0;
}

static double parameter_of_increment(const shape_t* shape, double increment)
{
    const double part = fmax(increment / even_increment(shape) - least_increment, 1e-3);
    return part > 30 ? part : log(expm1(part));
}

/// Parameters of a table whose knot values rise by the given increments.
static void tables_from_values(const shape_t* shape, const double* ascending, const double* descending,
                               double* theta)
{
    const size_t cells = shape->num_knots - 1;
    const double scale = 2 / (ascending[cells] - descending[0]);
    for (size_t i = 0; i < cells; i++) {
        theta[i] = parameter_of_increment(shape, scale * (ascending[i + 1] - ascending[i]));
        theta[cells + i] = parameter_of_increment(shape, scale * (descending[i + 1] - descending[i]));
    }
}

void shape_start(const shape_t* shape, double steepness, double ascending_centre, double descending_centre,
                 double* theta)
{
    if (shape->envelope == CURVE_TANH) {
        theta[0] = theta[2] = log(steepness);
        theta[1] = ascending_centre;
        theta[3] = descending_centre;
    } else if (shape->envelope == CURVE_TABLE) {
        double* values = xmalloc(2 * shape->num_knots * sizeof *values);
        for (size_t i = 0; i < shape->num_knots; i++) {
            values[i] = tanh(steepness * (shape->knot[i] - ascending_centre));
            values[shape->num_knots + i] = tanh(steepness * (shape->knot[i] - descending_centre));
        }
        tables_from_values(shape, values, values + shape->num_knots, theta);
        free(values);
    }
    if (shape->nonhysteretic == CURVE_TANH) {
        theta[shape->num_parameters - 2] = 0;
        theta[shape->num_parameters - 1] = 0.5 * (ascending_centre + descending_centre);
    }
}

void shape_start_like(const shape_t* table, const shape_t* other, const double* other_theta, double* theta)
{
    double* raw = xcalloc(other->num_raw + 1, sizeof *raw);
    double* values = xmalloc(2 * table->num_knots * sizeof *values);
    shape_raw(other, other_theta, raw);
    for (size_t i = 0; i < table->num_knots; i++) {
        const double u = table->knot[i];
        const place_t place = shape_place(other, u);
        values[i] = shape_ascending(other, raw, u, place, NULL);
        values[table->num_knots + i] = shape_descending(other, raw, u, place, NULL);
    }
    tables_from_values(table, values, values + table->num_knots, theta);
    free(values);
    free(raw);
}

void shape_raw(const shape_t* shape, const double* theta, double* raw)
{
    const size_t k = shape->num_knots;
    if (shape->envelope == CURVE_TANH) {
        for (size_t side = 0; side < 4; side += 2) {
            raw[side] = exp(theta[side]);
            raw[side + 1] = -raw[side] * theta[side + 1];
        }
    } else if (shape->envelope == CURVE_TABLE) {
        raw[k - 1] = 1;
        raw[k] = -1;
        for (size_t i = k - 1; i-- > 0;) {
            raw[i] = raw[i + 1] - increment_of(shape, theta[i]);
        }
        for (size_t i = 0; i + 1 < k; i++) {
            raw[k + i + 1] = raw[k + i] + increment_of(shape, theta[k - 1 + i]);
        }
    }
    if (shape->nonhysteretic == CURVE_TANH) {
        const double* t = theta + shape->num_parameters - 2;
        double* q = raw + shape->num_raw - 2;
        q[0] = exp(t[0]);
        q[1] = -q[0] * t[1];
    }
}

/// slope = e^t0, shift = -e^t0 t1.
static void tanh_jacobian(const double* theta, size_t parameter, size_t row, size_t rows, double* jacobian)
{
    const double slope = exp(theta[parameter]);
    jacobian[row + rows * parameter] = slope;
    jacobian[row + 1 + rows * parameter] = -slope * theta[parameter + 1];
    jacobian[row + 1 + rows * (parameter + 1)] = -slope;
}

void shape_raw_jacobian(const shape_t* shape, const double* theta, double* jacobian)
{
    const size_t rows = shape->num_raw;
    const size_t k = shape->num_knots;
    memset(jacobian, 0, rows * shape->num_parameters * sizeof *jacobian);
    if (shape->envelope == CURVE_TANH) {
        tanh_jacobian(theta, 0, 0, rows, jacobian);
        tanh_jacobian(theta, 2, 2, rows, jacobian);
    } else if (shape->envelope == CURVE_TABLE) {
        for (size_t i = 0; i + 1 < k; i++) {
            const double ascending = increment_slope(shape, theta[i]);
            const double descending = increment_slope(shape, theta[k - 1 + i]);
            for (size_t below = 0; below <= i; below++) {
                jacobian[below + rows * i] = -ascending;
            }
            for (size_t above = i + 1; above < k; above++) {
                jacobian[k + above + rows * (k - 1 + i)] = descending;
            }
        }
    }
    if (shape->nonhysteretic == CURVE_TANH) {
        tanh_jacobian(theta, shape->num_parameters - 2, rows - 2, rows, jacobian);
    }
}

static double tanh_value(const double* raw, size_t first, double u, tangent_t* tangent)
{
    const double value = tanh(raw[first] * u + raw[first + 1]);
    if (tangent != NULL) {
        const double slope = 1 - value * value;
        *tangent = (tangent_t){{first, first + 1}, {slope * u, slope}};
    }
    return value;
}

static double table_value(const double* raw, size_t first, place_t place, tangent_t* tangent)
{
    const size_t i = first + place.cell;
    if (tangent != NULL) {
        *tangent = (tangent_t){{i, i + 1}, {1 - place.fraction, place.fraction}};
    }
    return (1 - place.fraction) * raw[i] + place.fraction * raw[i + 1];
}

static double envelope_value(const shape_t* shape, const double* raw, bool ascending, double u, place_t place,
                             tangent_t* tangent)
{
    switch (shape->envelope) {
    case CURVE_TANH:
        return tanh_value(raw, ascending ? 0 : 2, u, tangent);
    case CURVE_TABLE:
        return table_value(raw, ascending ? 0 : shape->num_knots, place, tangent);
    case CURVE_LINEAR:
        break;
    }
    if (tangent != NULL) {
        *tangent = (tangent_t){0};
    }
    return u;
}

double shape_ascending(const shape_t* shape, const double* raw, double u, place_t place, tangent_t* tangent)
{
    return envelope_value(shape, raw, true, u, place, tangent);
}

double shape_descending(const shape_t* shape, const double* raw, double u, place_t place, tangent_t* tangent)
{
    return envelope_value(shape, raw, false, u, place, tangent);
}

size_t shape_num_nonhysteretic(const shape_t* shape)
{
    return shape->nonhysteretic == CURVE_TABLE ? shape->num_knots - 1 : 1;
}

double shape_nonhysteretic(const shape_t* shape, const double* raw, size_t k, double u, place_t place,
                           tangent_t* tangent)
{
    if (tangent != NULL) {
        *tangent = (tangent_t){0};
    }
    switch (shape->nonhysteretic) {
    case CURVE_TANH:
        return tanh_value(raw, shape->num_raw - 2, u, tangent);
    case CURVE_TABLE:
        return place.cell > k ? 1 : place.cell == k ? place.fraction : 0;
    case CURVE_LINEAR:
        break;
    }
    return u;
}

/// A curve over u as one over v: the scaled input is (v - centre) / half_range.
static curve_t physical_tanh(const double* raw, double centre, double half_range)
{
    return curve_tanh(raw[0] / half_range, raw[1] - raw[0] * centre / half_range);
}

static curve_t physical_table(const shape_t* shape, const double* y, double centre, double half_range)
{
    double* x = xmalloc(shape->num_knots * sizeof *x);
    for (size_t i = 0; i < shape->num_knots; i++) {
        x[i] = centre + half_range * shape->knot[i];
    }
    const curve_t curve = curve_table(x, y, shape->num_knots);
    free(x);
    return curve;
}

static curve_t physical_envelope(const shape_t* shape, const double* raw, bool ascending, double centre,
                                 double half_range)
{
    switch (shape->envelope) {
    case CURVE_TANH:
        return physical_tanh(raw + (ascending ? 0 : 2), centre, half_range);
    case CURVE_TABLE:
        return physical_table(shape, raw + (ascending ? 0 : shape->num_knots), centre, half_range);
    case CURVE_LINEAR:
        break;
    }
    return curve_linear(1, 0);
}

curve_t shape_curve_ascending(const shape_t* shape, const double* raw, double centre, double half_range)
{
    return physical_envelope(shape, raw, true, centre, half_range);
}

curve_t shape_curve_descending(const shape_t* shape, const double* raw, double centre, double half_range)
{
    return physical_envelope(shape, raw, false, centre, half_range);
}

curve_t shape_curve_nonhysteretic(const shape_t* shape, const double* raw, const double* coefficients,
                                  double constant, double centre, double half_range)
{
    if (shape->nonhysteretic == CURVE_TANH) {
        curve_t curve = physical_tanh(raw + shape->num_raw - 2, centre, half_range);
        curve_scale(&curve, coefficients[0]);
        curve_add(&curve, constant);
        return curve;
    }
    if (shape->nonhysteretic == CURVE_TABLE) {
        double* y = xmalloc(shape->num_knots * sizeof *y);
        y[0] = constant;
        for (size_t i = 0; i + 1 < shape->num_knots; i++) {
            y[i + 1] = y[i] + coefficients[i];
        }
        const curve_t curve = physical_table(shape, y, centre, half_range);
        free(y);
        return curve;
    }
    return curve_linear(coefficients[0] / half_range, constant - coefficients[0] * centre / half_range);
}
