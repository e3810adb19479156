/// rate_dependence: the loop itself widens with the input's speed (viscous wall motion, eddy currents,
/// internal friction).
///     play_lag:  tau dw_j/dt = (where Eq. (6) puts the play, given w_j) - w_j: on a ramp every play trails
///     by
///                tau dw/dt, at rest inside its strip it stays
///     widening:  r_j + coefficient |dv/dt| for every radius
/// tau >= 0 [s]; coefficient >= 0 [envelope units per input/s], fitted up to where the mean rate doubles the
/// largest radius. Sources: viscous plays as in G. Bertotti's dynamic Preisach model, IEEE Trans. Magn. 28
/// (1992) 2599; widening radii: M. Al Janaideh, S. Rakheja, C.-Y. Su, Mechatronics 19 (2009) 656.
#include "effect_catalogue.h"
#include "effect_lag.h"
#include "effect_limits.h"
#include <math.h>

static const effect_parameter_t widening_parameter[] = {{"coefficient", "envelope/(input/s)", AT_LEAST_0}};

static void configure_lag(const effect_run_t* run, const double* parameter, const double* column,
                          hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->play_lag += parameter[0];
}

static void widening_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)parameter;
    const double rate = run->travel > 0.0 ? run->travel / run->duration : 1.0;
    const double high = run->largest_radius > 0.0 ? run->largest_radius / rate : 1.0;
    *result = limits_linear(0.0, high, 0.0, 0.03 * high, 0.15 * high, 0.005 * high);
}

static void configure_widening(const effect_run_t* run, const double* parameter, const double* column,
                               hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->widening += parameter[0];
}

const effect_t effect_rate_dependence_play_lag = {
    .name = "rate_dependence",
    .mechanism = "play_lag",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = 1,
    .parameter = &lag_parameter,
    .limits = lag_limits,
    .configure = configure_lag,
};

const effect_t effect_rate_dependence_widening = {
    .name = "rate_dependence",
    .mechanism = "widening",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(widening_parameter),
    .parameter = widening_parameter,
    .limits = widening_limits,
    .configure = configure_widening,
    .no_inverse = "radii that grow with the input's speed let the output fall while the input rises",
};
