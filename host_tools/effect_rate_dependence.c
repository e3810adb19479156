/// rate_dependence: of a play_lag every play trails on a ramp by tau_j dw/dt, at rest inside its strip it
/// stays; tau_j grows with the radius: walls that take more to move may be slower; hold as for an input_lag;
/// the plays trail already as the record begins, where the input has come through the range to its first
/// sample at `approach`, from the other end, where the plays were between where a way within the range had
/// put them (`beyond` 0) and where one from far beyond it had (1); of what the plays give to the major loop's
/// middle the part `direct` comes at once: how much of the middle is plays and how much memoryless no slow
/// record tells. The fields of diffusion and excess: field.h.
/// tau >= 0 [s]; spread > -1, hold, beyond and direct 0 ... 1 [1], approach >= 0 [input/s, 0: at leisure], 0
/// when left out; coefficient >= 0 [envelope units per input/s], fitted up to where the mean rate doubles the
/// largest radius; excess >= 0 [input units per root of input/s], fitted up to half the range behind at the
/// mean rate. share 0 ... 1: how much of the nonhysteretic part sees that field too; what does not lag tells
/// these from an input_lag. hold 0 ... 1 as for that; a diffusion's counts for an excess field behind it,
/// too. They count a quarter of an effect more, as with a share of 1 a small one is a lag of the input.
/// Inverse: by halving, sample by sample; widening has none.
/// Sources: viscous plays as in G. Bertotti's dynamic Preisach model, IEEE Trans. Magn. 28 (1992) 2599;
/// widening radii: M. Al Janaideh, S. Rakheja, C.-Y. Su, Mechatronics 19 (2009) 656; classical and excess
/// field: G. Bertotti, IEEE Trans. Magn. 24 (1988) 621.
#include "effect_catalogue.h"
#include "effect_lag.h"
#include "effect_limits.h"
#include <math.h>

static const effect_parameter_t widening_parameter[] = {{"coefficient", "envelope/(input/s)", AT_LEAST_0}};

#define SHARE_PARAMETER                                                                                      \
    {                                                                                                        \
        "share", "1", .least = 0.0, .most = 1.0, .optional = true, .of_model = true                          \
    }

#define HOLD_PARAMETER                                                                                       \
    {                                                                                                        \
        "hold", "1", .least = 0.0, .most = 1.0, .optional = true                                             \
    }

enum { STRENGTH, SHARE, HOLD };                                // of a field
enum { TAU, SPREAD, APPROACH, DIRECT, PLAY_LAG_HOLD, BEYOND }; // of a play_lag

static const effect_parameter_t diffusion_parameters[] = {
    {"tau", "s", AT_LEAST_0}, SHARE_PARAMETER, HOLD_PARAMETER};
static const effect_parameter_t excess_parameters[] = {
    {"excess", "input/sqrt(input/s)", AT_LEAST_0}, SHARE_PARAMETER, HOLD_PARAMETER};

static effect_limits_t share_limits(double most)
{
    return limits_linear(0.0, most, 0.0, 0.1, 0.8, 0.1);
}

/// Nearer to 1 the slowest mode, four fifths of a diffusion, is a first-order lag of the whole input, and the
/// other modes fit what any real lag differs by from that.
static void diffusion_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    *result = parameter == STRENGTH ? limits_time_constant(run)
              : parameter == SHARE  ? share_limits(0.85)
                                    : hold_limits();
}

static void excess_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double rate = run->travel > 0.0 ? run->travel / run->duration : 1.0;
    const double high = 0.5 * run->input_span / sqrt(rate);
    *result = parameter == STRENGTH ? limits_linear(0.0, high, 0.0, 0.03 * high, 0.15 * high, 0.005 * high)
              : parameter == SHARE  ? share_limits(1.0)
                                    : hold_limits();
}

/// Two fields behind each other: the nonhysteretic part is free of the share that either binds.
static void configure_share(double share, field_t* field)
{
    field->share = 1.0 - (1.0 - field->share) * (1.0 - share);
}

static void configure_diffusion(const effect_run_t* run, const double* parameter, const double* column,
                                hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    if (parameter[STRENGTH] > 0.0) {
        hysteresis->field.diffusion += parameter[STRENGTH];
        hysteresis->field.hold = parameter[HOLD];
        configure_share(parameter[SHARE], &hysteresis->field);
    }
}

static void configure_excess(const effect_run_t* run, const double* parameter, const double* column,
                             hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    if (parameter[STRENGTH] > 0.0) {
        hysteresis->field.excess += parameter[STRENGTH];
        hysteresis->field.hold = hysteresis->field.diffusion > 0.0 ? hysteresis->field.hold : parameter[HOLD];
        configure_share(parameter[SHARE], &hysteresis->field);
    }
}

static void configure_lag(const effect_run_t* run, const double* parameter, const double* column,
                          hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->play_lag += parameter[TAU];
    if (parameter[TAU] > 0.0) {
        hysteresis->lag_spread = parameter[SPREAD];
        hysteresis->approach = parameter[APPROACH];
        hysteresis->beyond = parameter[BEYOND];
        hysteresis->lag_direct = parameter[DIRECT];
        hysteresis->lag_hold = parameter[PLAY_LAG_HOLD];
    }
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

static const effect_parameter_t play_lag_parameters[] = {
    [TAU] = {"tau", "s", AT_LEAST_0},
    [SPREAD] = {"spread", "1", .least = -0.99, .most = 10.0, .optional = true},
    [APPROACH] = {"approach", "input/s", AT_LEAST_0, .optional = true},
    [DIRECT] = {"direct", "1", .least = 0.0, .most = 1.0, .optional = true, .of_model = true},
    [PLAY_LAG_HOLD] = HOLD_PARAMETER,
    [BEYOND] = {"beyond", "1", .least = 0.0, .most = 1.0, .optional = true},
};

static void play_lag_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    const double fastest = run->input_rate > 0.0 ? 10.0 * run->input_rate : 1.0;
    *result = parameter == TAU        ? limits_time_constant(run)
              : parameter == SPREAD   ? limits_linear(-0.9, 3.0, 0.0, 0.3, 1.0, 0.1)
              : parameter == APPROACH ? limits_linear(0.0, fastest, 0.0, 0.0, 0.3 * fastest, 0.03 * fastest)
              : parameter == BEYOND   ? limits_linear(0.0, 1.0, 0.0, 0.5, 0.2, 0.8)
              : parameter == DIRECT   ? limits_linear(0.0, 1.0, 0.0, 0.1, 0.3, 0.03)
                                      : hold_limits();
}

/// Another record's past is taken to be at leisure.
static void play_lag_for_another_record(double* parameter)
{
    parameter[APPROACH] = 0.0;
    parameter[BEYOND] = 0.0;
}

static const char what[] =
    "the loop itself widens with the input's speed (viscous wall motion, eddy currents, internal friction)";

const effect_t effect_rate_dependence_play_lag = {
    .name = "rate_dependence",
    .mechanism = "play_lag",
    .what = what,
    .law =
        "tau_j dw_j/dt = (where the model puts the play, given w_j) - w_j, tau_j = tau (1 + spread r_j / "
        "r_N)\n"
        "approach: how fast the input came to its first sample from the range's other end (0: at leisure), "
        "where the plays\n"
        "stood as a way within the range had put them (beyond 0) or one from far outside (1); direct: the "
        "part of the\n"
        "plays' share in the loop's middle that comes at once; hold as for an input_lag",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(play_lag_parameters),
    .parameter = play_lag_parameters,
    .limits = play_lag_limits,
    .has_threshold = true,
    .for_another_record = play_lag_for_another_record,
    .configure = configure_lag,
    .covers = 0.25, // as an input_lag's: spread and hold make it like another lag
};

const effect_t effect_rate_dependence_widening = {
    .name = "rate_dependence",
    .mechanism = "widening",
    .what = what,
    .law = "r_j' = r_j + coefficient |dv/dt|",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(widening_parameter),
    .parameter = widening_parameter,
    .limits = widening_limits,
    .configure = configure_widening,
    .no_inverse = "radii that grow with the input's speed let the output fall while the input rises",
};

const effect_t effect_rate_dependence_diffusion = {
    .name = "rate_dependence",
    .mechanism = "diffusion",
    .what = what,
    .law = "the plays see the mean field in a lamination, sum_k 8 / (pi (2k+1))^2 LP(v; tau / (2k+1)^2)\n"
           "share: how much of the nonhysteretic part sees it too; hold as for an input_lag",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(diffusion_parameters),
    .parameter = diffusion_parameters,
    .limits = diffusion_limits,
    .configure = configure_diffusion,
    .covers = 0.25,
};

const effect_t effect_rate_dependence_excess = {
    .name = "rate_dependence",
    .mechanism = "excess",
    .what = what,
    .law =
        "the plays see u, du/dt = ((v - u) / excess)^2 with the sign of v - u: on a ramp excess sqrt(rate) "
        "behind\n"
        "share: how much of the nonhysteretic part sees it too; hold as for an input_lag",
    .stage = EFFECT_HYSTERESIS,
    .transferable = true,
    .num_parameters = COUNT_OF(excess_parameters),
    .parameter = excess_parameters,
    .limits = excess_limits,
    .configure = configure_excess,
    .covers = 0.25,
};
