/// noncongruency:
///     product:    weights that depend on the input
///     moving:     a mean field
///     increment:  what a loop's two branches gain and lose does not cancel, so that each cycle also shifts
///                 the output
/// and two that leave the middle m(v) of the major loop alone, which the calibration already shows:
///     remanence_field:     a mean field of the remanent part of the output alone; of the nonhysteretic part
///                          `share` sees it too, 0 when left out
///     remanence_stiffness: a reversible response whose steepness goes with the remanence, its course smooth
///                          in the input; even and odd are 0 when left out
/// level_gain in (-1, 1), moving and field in [-1, 1], stiffness, even and odd in [-10, 10] [1]; above 1 the
/// loop runs the other way round at one end.
/// Inverse: by halving, sample by sample, where the output rises with the input (a field's factor times the
/// loop's relative steepness below 1).
/// Sources: I. D. Mayergoyz, Mathematical Models of Hysteresis, 1991, ch. II (input-dependent model); E.
/// Della Torre, IEEE Trans. Audio 14 (1966) 86 (moving model); E. Della Torre, J. Oti, G. Kadar, IEEE Trans.
/// Magn. 26 (1990) 3052 (reversible part that depends on the irreversible one).
#include "effect_catalogue.h"
#include "effect_limits.h"
#include <math.h>

static const effect_parameter_t gain_parameter[] = {{"level_gain", "1", .least = -0.99, .most = 0.99}};

static const effect_parameter_t moving_parameter[] = {{"moving", "1", .least = -1.0, .most = 1.0}};

static const effect_parameter_t field_parameters[] = {
    {"field", "1", .least = -1.0, .most = 1.0},
    {"share", "1", .least = 0.0, .most = 1.0, .optional = true, .of_model = true},
};

enum { STIFFNESS, EVEN, ODD };

static const effect_parameter_t stiffness_parameters[] = {
    [STIFFNESS] = {"stiffness", "1", .least = -10.0, .most = 10.0},
    [EVEN] = {"even", "1", .least = -10.0, .most = 10.0, .optional = true},
    [ODD] = {"odd", "1", .least = -10.0, .most = 10.0, .optional = true},
};

static void gain_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)run;
    (void)parameter;
    *result = limits_linear(-0.8, 0.8, 0.0, 0.1, -0.1, 0.4);
}

static void moving_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)run;
    (void)parameter;
    *result = limits_linear(-0.5, 0.5, 0.0, 0.05, -0.05, 0.2);
}

static void field_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)run;
    *result = parameter == 0 ? limits_linear(-0.3, 0.3, 0.0, 0.05, -0.05, 0.15)
                             : limits_linear(0.0, 1.0, 0.0, 0.3, 0.3, 0.3);
}

static void stiffness_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)run;
    *result = parameter == STIFFNESS ? limits_linear(-10.0, 10.0, 0.0, 0.1, -0.1, 0.5)
                                     : limits_linear(-10.0, 10.0, 0.0, 0.0, 0.0, 0.0);
}

static void configure_product(const effect_run_t* run, const double* parameter, const double* column,
                              hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->level_product += parameter[0];
}

static void configure_moving(const effect_run_t* run, const double* parameter, const double* column,
                             hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->moving += parameter[0];
}

static void configure_increment(const effect_run_t* run, const double* parameter, const double* column,
                                hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->level_gain += parameter[0];
}

static void configure_field(const effect_run_t* run, const double* parameter, const double* column,
                            hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->remanence_field += parameter[0];
    if (fabs(parameter[0]) > 0.0) {
        hysteresis->shift_share = parameter[1];
    }
}

static void configure_stiffness(const effect_run_t* run, const double* parameter, const double* column,
                                hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->stiffness.by_level += parameter[STIFFNESS];
    hysteresis->stiffness.even += parameter[EVEN];
    hysteresis->stiffness.odd += parameter[ODD];
}

static const char what[] = "minor loops between equal reversals differ with level, as no PI model allows";

const effect_t effect_noncongruency_product = {
    .name = "noncongruency",
    .mechanism = "product",
    .what = what,
    .law = "S' = S_m + (1 + level_gain level(v)) (S - S_m)",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(gain_parameter),
    .parameter = gain_parameter,
    .limits = gain_limits,
    .configure = configure_product,
};

const effect_t effect_noncongruency_moving = {
    .name = "noncongruency",
    .mechanism = "moving",
    .what = what,
    .law = "the plays see v + moving half_range (S - S_m) / S_h, the fraction held to +-1",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(moving_parameter),
    .parameter = moving_parameter,
    .limits = moving_limits,
    .configure = configure_moving,
    .superseded = true,
};

const effect_t effect_noncongruency_increment = {
    .name = "noncongruency",
    .mechanism = "increment",
    .what = what,
    .law = "dS' = (1 + level_gain level(v)) dS",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(gain_parameter),
    .parameter = gain_parameter,
    .limits = gain_limits,
    .configure = configure_increment,
    .superseded = true,
};

const effect_t effect_noncongruency_remanence_field = {
    .name = "noncongruency",
    .mechanism = "remanence_field",
    .what = what,
    .law = "the plays see v + field half_range (y - m(v)) / half_span\n"
           "share: the nonhysteretic part sees v + share of that shift",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(field_parameters),
    .parameter = field_parameters,
    .limits = field_limits,
    .configure = configure_field,
};

const effect_t effect_noncongruency_remanence_stiffness = {
    .name = "noncongruency",
    .mechanism = "remanence_stiffness",
    .what = what,
    .law = "y' = y + (stiffness level + even (level^2 - 1) + odd (level^3 - level)) (y - m(v))",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(stiffness_parameters),
    .parameter = stiffness_parameters,
    .limits = stiffness_limits,
    .configure = configure_stiffness,
};
