/// drift: a line, or a spline through 6, 10, 20 or 40 nodes. slope [output/s], node_k [output]. Holds for
/// this record alone. Zero at the record's start: a constant is an offset. Spline: C. de Boor, A Practical
/// Guide to Splines, ch. IV.
#include "effect_catalogue.h"
#include "effect_limits.h"

enum { NODES = 6, FINE_NODES = 10, FINEST_NODES = 20, DENSE_NODES = 40 };

static const effect_parameter_t slope_parameter[] = {{"slope", "output/s", ANY_NUMBER}};

#define NODE(number)                                                                                         \
    {                                                                                                        \
        "node_" #number, "output", ANY_NUMBER                                                                \
    }

static const effect_parameter_t node_parameters[DENSE_NODES] = {
    NODE(1),  NODE(2),  NODE(3),  NODE(4),  NODE(5),  NODE(6),  NODE(7),  NODE(8),  NODE(9),  NODE(10),
    NODE(11), NODE(12), NODE(13), NODE(14), NODE(15), NODE(16), NODE(17), NODE(18), NODE(19), NODE(20),
    NODE(21), NODE(22), NODE(23), NODE(24), NODE(25), NODE(26), NODE(27), NODE(28), NODE(29), NODE(30),
    NODE(31), NODE(32), NODE(33), NODE(34), NODE(35), NODE(36), NODE(37), NODE(38), NODE(39), NODE(40),
};

static void slope_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)parameter;
    const double slope = limits_output_span(run) / run->duration;
    *result = limits_linear(-2.0 * slope, 2.0 * slope, 0.0, 0.0, 0.1 * slope, -0.1 * slope);
}

static void node_limits(const effect_run_t* run, size_t parameter, effect_limits_t* result)
{
    (void)parameter;
    const double span = limits_output_span(run);
    *result = limits_linear(-2.0 * span, 2.0 * span, 0.0, 0.0, 0.1 * span, -0.1 * span);
}

static void add_slope(const effect_run_t* run, double slope, double* series)
{
    for (size_t i = 0; i < run->num_samples; ++i) {
        series[i] += slope * (run->time[i] - run->time[0]);
    }
}

static void apply_slope(const effect_run_t* run, const double* parameter, const double* column,
                        double* series)
{
    (void)column;
    add_slope(run, parameter[0], series);
}

static void invert_slope(const effect_run_t* run, const double* parameter, const double* column,
                         double* series)
{
    (void)column;
    add_slope(run, -parameter[0], series);
}

/// The second derivatives at knots 0 ... nodes one apart, 0 at both ends: m[k-1] + 4 m[k] + m[k+1] = 6
/// (second difference), by elimination.
static void curvatures(const double* value, size_t nodes, double* m)
{
    double pivot[DENSE_NODES + 1] = {0};
    for (size_t k = 0; k <= nodes; ++k) {
        m[k] = 0.0;
    }
    for (size_t k = 1; k < nodes; ++k) {
        const double before = k > 1 ? 1.0 / pivot[k - 1] : 0.0;
        pivot[k] = 4.0 - before;
        m[k] = 6.0 * (value[k - 1] - 2.0 * value[k] + value[k + 1]) - before * m[k - 1];
    }
    for (size_t k = nodes - 1; k >= 1; --k) {
        m[k] = (m[k] - m[k + 1]) / pivot[k];
    }
}

static void add_spline(const effect_run_t* run, const double* node, size_t nodes, double sign, double* series)
{
    double value[DENSE_NODES + 1] = {0};
    for (size_t k = 0; k < nodes; ++k) {
        value[k + 1] = sign * node[k];
    }
    double m[DENSE_NODES + 1];
    curvatures(value, nodes, m);
    const double spacing = (run->time[run->num_samples - 1] - run->time[0]) / (double)nodes;
    size_t cell = 0;
    for (size_t i = 1; i < run->num_samples; ++i) {
        const double place = (run->time[i] - run->time[0]) / spacing;
        while (cell + 1 < nodes && place > (double)(cell + 1)) {
            cell += 1;
        }
        const double right = place - (double)cell;
        const double left = 1.0 - right;
        series[i] +=
            left * value[cell] + right * value[cell + 1] +
            ((left * left * left - left) * m[cell] + (right * right * right - right) * m[cell + 1]) / 6.0;
    }
}

/// apply and invert of a spline with so many nodes.
#define SPLINE(kind, nodes)                                                                                  \
    static void apply_##kind(const effect_run_t* run, const double* parameter, const double* column,         \
                             double* series)                                                                 \
    {                                                                                                        \
        (void)column;                                                                                        \
        add_spline(run, parameter, nodes, 1.0, series);                                                      \
    }                                                                                                        \
    static void invert_##kind(const effect_run_t* run, const double* parameter, const double* column,        \
                              double* series)                                                                \
    {                                                                                                        \
        (void)column;                                                                                        \
        add_spline(run, parameter, nodes, -1.0, series);                                                     \
    }

SPLINE(spline, NODES)
SPLINE(fine_spline, FINE_NODES)
SPLINE(finest_spline, FINEST_NODES)
SPLINE(dense_spline, DENSE_NODES)

static const char what[] =
    "slow additive change over time, unrelated to the input (a sensor warming up, a creeping mount)";

const effect_t effect_drift_linear = {
    .name = "drift",
    .mechanism = "linear",
    .what = what,
    .law = "y' = y + slope (t - t0)",
    .stage = EFFECT_SENSOR,
    .is_linear = true,
    .num_parameters = COUNT_OF(slope_parameter),
    .parameter = slope_parameter,
    .limits = slope_limits,
    .apply = apply_slope,
    .invert = invert_slope,
};

const effect_t effect_drift_spline = {
    .name = "drift",
    .mechanism = "spline",
    .what = what,
    .law = "y' = y + g(t), g the natural cubic spline through 0 at the start and node_k at k/6 of the record",
    .stage = EFFECT_SENSOR,
    .is_linear = true,
    .num_parameters = NODES,
    .parameter = node_parameters,
    .limits = node_limits,
    .apply = apply_spline,
    .invert = invert_spline,
};

const effect_t effect_drift_fine_spline = {
    .name = "drift",
    .mechanism = "fine_spline",
    .what = what,
    .law =
        "y' = y + g(t), g the natural cubic spline through 0 at the start and node_k at k/10 of the record",
    .stage = EFFECT_SENSOR,
    .is_linear = true,
    .num_parameters = FINE_NODES,
    .parameter = node_parameters,
    .limits = node_limits,
    .apply = apply_fine_spline,
    .invert = invert_fine_spline,
    .covers = 0.4, // ten nodes follow slow parts of other effects
};

const effect_t effect_drift_finest_spline = {
    .name = "drift",
    .mechanism = "finest_spline",
    .what = what,
    .law =
        "y' = y + g(t), g the natural cubic spline through 0 at the start and node_k at k/20 of the record",
    .stage = EFFECT_SENSOR,
    .is_linear = true,
    .num_parameters = FINEST_NODES,
    .parameter = node_parameters,
    .limits = node_limits,
    .apply = apply_finest_spline,
    .invert = invert_finest_spline,
    .covers = 0.8,
};

const effect_t effect_drift_dense_spline = {
    .name = "drift",
    .mechanism = "dense_spline",
    .what = what,
    .law =
        "y' = y + g(t), g the natural cubic spline through 0 at the start and node_k at k/40 of the record",
    .stage = EFFECT_SENSOR,
    .is_linear = true,
    .num_parameters = DENSE_NODES,
    .parameter = node_parameters,
    .limits = node_limits,
    .apply = apply_dense_spline,
    .invert = invert_dense_spline,
    .covers = 2.5, // only a drift far above the noise shows so much of its course
};
