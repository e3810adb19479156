/// initial_state: unnamed, the plays start off the run's own start; f1 ... f6 in [-1, 1] stand at six even
/// nodes from the smallest radius to the largest; for model files only. turn_1 ... turn_4 [input]:
/// turning_points go on from the run's own start. Either way the states stay 1-Lipschitz in the radius (Zhang
/// et al. 2015, section 2), as every memory is. A past leaves nothing but its dominant turning points
/// (wiping-out), of which searches look for the first four; a smaller loop left out moves only the plays
/// below its half width. Holds for this record alone.
#include "effect_catalogue.h"
#include "effect_limits.h"

enum { NODES = 6, TURNS = 4 };

#define NODE(name)                                                                                           \
    {                                                                                                        \
        name, "1", .least = -1.0, .most = 1.0                                                                \
    }
static const effect_parameter_t node_parameters[NODES] = {NODE("f1"), NODE("f2"), NODE("f3"),
                                                          NODE("f4"), NODE("f5"), NODE("f6")};

static const effect_parameter_t turn_parameters[TURNS] = {{"turn_1", "input", ANY_NUMBER},
                                                          {"turn_2", "input", ANY_NUMBER},
                                                          {"turn_3", "input", ANY_NUMBER},
                                                          {"turn_4", "input", ANY_NUMBER}};

static void node_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)run;
    (void)parameter;
    *result = limits_linear(-1.0, 1.0, 0.0, 0.5, -0.5, 0.1);
}

/// A turn up, then one down, each smaller: in parts of the way from the first sample to the range's end.
static void turn_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    static const double part[TURNS][3] = {
        {0.8, 0.9, 0.4}, {0.6, 0.05, 0.2}, {0.4, 0.3, 0.2}, {0.2, 0.02, 0.05}};
    const double low = run->input_min;
    const double high = run->input_min + run->input_span;
    const double first = run->input[0];
    const double way = (parameter % 2 == 0 ? high : low) - first;
    *result = limits_linear(low, high, first, first + part[parameter][0] * way,
                            first + part[parameter][1] * way, first + part[parameter][2] * way);
}

static void configure_nodes(const effect_run_t* run, const double* parameter, const double* column,
                            hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->start_fraction = parameter;
    hysteresis->num_nodes = NODES;
}

static void configure_turns(const effect_run_t* run, const double* parameter, const double* column,
                            hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->turn = parameter;
    hysteresis->num_turns = TURNS;
}

static const char what[] = "the memory at the record's start is not the model's; gone once wiped out";

const effect_t effect_initial_state = {
    .name = "initial_state",
    .what = what,
    .law = "w_j(0) moves towards its strip's top (f > 0) or bottom (f < 0) by the part |f|, f linear between "
           "f1 ... f6 over the radii",
    .stage = EFFECT_HYSTERESIS,
    .num_parameters = COUNT_OF(node_parameters),
    .parameter = node_parameters,
    .limits = node_limits,
    .configure = configure_nodes,
    .superseded = true,
};

const effect_t effect_initial_state_turning_points = {
    .name = "initial_state",
    .mechanism = "turning_points",
    .what = what,
    .law = "before the first sample the input went to turn_1 ... turn_4, one after the other",
    .stage = EFFECT_HYSTERESIS,
    .num_parameters = COUNT_OF(turn_parameters),
    .parameter = turn_parameters,
    .limits = turn_limits,
    .configure = configure_turns,
};
