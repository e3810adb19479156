/// initial_state: the memory at the record's start is not the model's; gone once wiped out.
///     w_j(0) moves from the run's own start towards its strip's top (f > 0) or bottom (f < 0) by the part
///     |f|
/// f1 ... f6 in [-1, 1]: f over the radii, linear between six even nodes from the smallest to the largest.
/// The states stay 1-Lipschitz in the radius (Zhang et al. 2015, section 2), as every memory is. Holds for
/// this record alone.
#include "effect_catalogue.h"
#include "effect_limits.h"

enum { NODES = 6 };

#define NODE(name)                                                                                           \
    {                                                                                                        \
        name, "1", .least = -1.0, .most = 1.0                                                                \
    }
static const effect_parameter_t parameters[NODES] = {NODE("f1"), NODE("f2"), NODE("f3"),
                                                     NODE("f4"), NODE("f5"), NODE("f6")};

static void limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)run;
    (void)parameter;
    *result = limits_linear(-1.0, 1.0, 0.0, 0.5, -0.5, 0.1);
}

static void configure(const effect_run_t* run, const double* parameter, const double* column,
                      hysteresis_t* hysteresis)
{
    (void)run;
    (void)column;
    hysteresis->start_fraction = parameter;
    hysteresis->num_nodes = NODES;
}

const effect_t effect_initial_state = {
    .name = "initial_state",
    .stage = EFFECT_HYSTERESIS,
    .num_parameters = NODES,
    .parameter = parameters,
    .limits = limits,
    .configure = configure,
};
