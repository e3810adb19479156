/// A hysteretic element of textbook form beside a curve without memory: output = gain * state + curve(input).
/// Where a plant's calibration shows that it is of this kind, it stands in for the plays (as duhem.h, of
/// which both kinds are special cases): with seven numbers instead of a grid of slopes, what the calibration
/// says holds for other work, too.
///   Bouc-Wen:         dz/dx = steepness (1 - |z|^order pull), pull one of four by the signs of z and of dx
///   Jiles-Atherton:   dW/dh = (A - W) / (pinning sign(dh) - coupling (A - W)), A = L((h + coupling
///   M)/shape),
///                     M = bowing A + (1 - bowing) W, L(x) = coth x - 1/x; W does not move against the field
/// x: the input as a part of the model's range; h: 2 x - 1 - centre. Sources: Y. K. Wen, J. Eng. Mech. Div.
/// ASCE 102 (1976) 249; J. Song, A. Der Kiureghian, J. Eng. Mech. 132 (2006) 610 (pulls by signs); D. C.
/// Jiles, D. L. Atherton, J. Magn. Magn. Mater. 61 (1986) 48.
#ifndef HYST_HOST_ELEMENT_H
#define HYST_HOST_ELEMENT_H

#include <stddef.h>

typedef enum { ELEMENT_BOUC_WEN, ELEMENT_JILES_ATHERTON, ELEMENT_KINDS } element_kind_t;

enum {
    ELEMENT_SHAPES = 7, ///< numbers that the state's course depends on
    ELEMENT_CURVE = 15, ///< cubic B-splines over the range
    /// numbers that a calibration leaves more or less open: shapes, gain, curve
    ELEMENT_FREE = ELEMENT_SHAPES + 1 + ELEMENT_CURVE
};

/// Which number of `shape` is which. The last two: how far beside the middle of a step its slope is taken, in
/// half steps, of the input (Bouc-Wen: no part in it) and of the state. A plant answers large steps at their
/// ends, or as it stood before them; a calibration of small ones leaves that open.
enum { BOUC_WEN_STEEPNESS, BOUC_WEN_ORDER, BOUC_WEN_FALLING, BOUC_WEN_RISING_BACK, BOUC_WEN_FALLING_BACK };
enum { ATHERTON_SHAPE, ATHERTON_PINNING, ATHERTON_COUPLING, ATHERTON_BOWING, ATHERTON_CENTRE };
enum { ELEMENT_INPUT_AHEAD = ELEMENT_SHAPES - 2, ELEMENT_STATE_AHEAD };

typedef struct {
    element_kind_t kind;
    double input_min, input_max;
    /// Bouc-Wen: steepness, order, and of the pulls those at z < 0 falling, z < 0 rising, z > 0 falling; z is
    /// in units in which the pull at z > 0 rising is 1.
    double shape[ELEMENT_SHAPES];
    double gain;                 ///< output units
    double curve[ELEMENT_CURVE]; ///< output units
} element_t;

/// Sample by sample.
typedef struct {
    const element_t* element;
    double part;  ///< the input as a part of the range, at most half of it beyond
    double inner; ///< z, or W
    double state; ///< z, or M
    double ideal; ///< A there; Bouc-Wen has none
} element_state_t;

/// In negative saturation: at the range's foot after a whole cycle.
element_state_t element_saturated(const element_t* element);
/// The input as a part of the range, at most half of it beyond.
double element_part(const element_t* element, double input);
/// Moves to `input` [input units], limited likewise; the state there.
double element_step(element_state_t* state, double input);
/// The curve's splines at a part of the range, limited to it: spline[ELEMENT_CURVE], summing to 1.
void element_splines(double part, double* spline);

/// The curve at an input [input units], beyond the range going on straight.
double element_nonhysteretic(const element_t* element, double input);
/// output[num_samples] for input[num_samples] from negative saturation; the first one raised by `shift`, from
/// where the rest follows.
void element_run(const element_t* element, double shift, const double* input, size_t num_samples,
                 double* output);

#endif
