#include "chord.h"
#include "grid.h"
#include "output_range.h"
#include "prepare.h"
#include "random.h"
#include "reference.h"
#include "tabulate.h"
#include "unity.h"
#include <float.h>
#include <stdlib.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static model_t plays_model(random_t* random, size_t num_plays, double least_radius)
{
    model_t model = model_new("test");
    model_set_num_plays(&model, num_plays);
    double radius = least_radius;
    for (size_t j = 0; j < num_plays; ++j) {
        model.radius[j] = radius;
        model.weight[j] = random_uniform(random, 0.0, 2.0);
        radius += random_uniform(random, 0.0, 0.3);
    }
    return model;
}

static curve_t random_table(random_t* random, double low, double high)
{
    double x[9];
    double y[9];
    double value = random_uniform(random, -1.0, 1.0);
    for (int i = 0; i < 9; ++i) {
        x[i] = low + (high - low) * (double)i / 8.0;
        y[i] = value;
        value += random_uniform(random, 0.01, 1.0);
    }
    return curve_table(x, y, 9);
}

static curve_t random_curve(random_t* random, double low, double high)
{
    const double width = high - low;
    const size_t kind = random_below(random, 3);
    if (kind == 0) {
        return random_table(random, low, high);
    }
    const double slope = exp(random_uniform(random, -2.0, 3.0)) / width;
    const double shift = -slope * random_uniform(random, low, high);
    curve_t curve = kind == 1 ? curve_tanh(slope, shift) : curve_linear(slope, shift);
    curve_scale(&curve, exp(random_uniform(random, -1.0, 2.0)));
    curve_add(&curve, random_uniform(random, -5.0, 5.0));
    return curve;
}

static model_t random_model(random_t* random)
{
    model_t model = plays_model(random, 1 + random_below(random, 12), 0.0);
    model.input_min = random_uniform(random, -3.0, 50.0);
    model.input_max = model.input_min + exp(random_uniform(random, -2.0, 4.0));
    model.ascending = random_curve(random, model.input_min, model.input_max);
    model.descending = random_below(random, 3) == 0 ? curve_copy(&model.ascending)
                                                    : random_curve(random, model.input_min, model.input_max);
    model.nonhysteretic = random_curve(random, model.input_min, model.input_max);
    const double least = model_least_radius(&model);
    for (size_t j = 0; j < model.num_plays; ++j) {
        model.radius[j] += least;
    }
    return model;
}

static float random_input(random_t* random, const hyst_f32_model_t* model, float last)
{
    const double low = (double)model->input_min;
    const double high = (double)model->input_max;
    if (random_below(random, 20) == 0) {
        return random_below(random, 2) == 0 ? model->input_min : model->input_max;
    }
    const double step = random_below(random, 3) == 0 ? high - low : 0.05 * (high - low);
    const double input = (double)last + random_uniform(random, -step, step);
    return (float)fmin(fmax(input, low), high);
}

/// Largest difference between lib/ and the reference over a random run from negative saturation.
static double largest_difference(random_t* random, const model_t* model, const hyst_f32_model_t* stored)
{
    hyst_f32_segment_t* memory = xcalloc(stored->num_plays, sizeof *memory);
    hyst_f32_state_t state;
    const hyst_status_t status = hyst_f32_init(stored, &state, memory, stored->num_plays);
    TEST_ASSERT_EQUAL_STRING(hyst_status_text(HYST_STATUS_OK), hyst_status_text(status));
    reference_t reference = reference_new(model, START_NEGATIVE_SATURATION, model->input_min);
    double largest = fabs((double)state.output - reference_output(&reference));
    float input = stored->input_min;
    for (int i = 0; i < 500; ++i) {
        input = random_input(random, stored, input);
        const double exact = reference_step(&reference, (double)input);
        largest = fmax(largest, fabs((double)hyst_f32_step(stored, &state, input) - exact));
    }
    reference_free(&reference);
    free(memory);
    return largest;
}

static void stated_errors_are_never_exceeded(void)
{
    random_t random = random_new(11);
    double tightest = 0.0;
    for (int trial = 0; trial < 300; ++trial) {
        model_t model = random_model(&random);
        TEST_ASSERT_EQUAL_STRING("", model_check(&model).text);
        const double range = model_output_max(&model) - model_output_min(&model);
        const double wanted = range * pow(10.0, random_uniform(&random, -5.0, -1.5));
        tabulated_t tabulated;
        TEST_ASSERT_EQUAL_STRING(NULL, tabulate(&model, wanted, &tabulated));
        TEST_ASSERT_TRUE(tabulated.table_error <= wanted);
        const double bound = tabulated.table_error + tabulated.float_error;
        const double largest = largest_difference(&random, &model, &tabulated.model);
        TEST_ASSERT_TRUE(largest <= bound);
        tightest = fmax(tightest, largest / bound);
        tabulated_free(&tabulated);
        model_free(&model);
    }
    // A bound that no run comes near would hide a mistake: one play alone attains it at its chord's worst
    // place.
    TEST_ASSERT_TRUE(tightest > 0.5);
}

/// A dense grid cannot exceed the chord's stated error, and comes as near to it as the grid is fine: the
/// distance is stationary at its maximum or has a kink at a table's knot, and changes by at most twice the
/// largest slope times the step.
static void chord_errors_hold_on_a_dense_grid(void)
{
    enum { NUM_STEPS = 20000 };
    random_t random = random_new(12);
    for (int trial = 0; trial < 200; ++trial) {
        curve_t curve = random_curve(&random, 0.0, 1.0);
        const double low = random_uniform(&random, 0.0, 0.5);
        const double high = low + random_uniform(&random, 0.01, 0.5);
        const double stated = chord_error(&curve, low, high);
        const double low_value = curve_value(&curve, low);
        const double slope = (curve_value(&curve, high) - low_value) / (high - low);
        double largest = 0.0;
        double steepest = 0.0;
        for (int i = 0; i <= NUM_STEPS; ++i) {
            const double v = low + (high - low) * i / NUM_STEPS;
            largest = fmax(largest, fabs(curve_value(&curve, v) - (low_value + slope * (v - low))));
            steepest = fmax(steepest, curve_slope(&curve, v));
        }
        // Below what curves of this size can be evaluated to, a linear curve's distance is rounding alone.
        const double rounding =
            64.0 * DBL_EPSILON * (fabs(low_value) + fabs(curve.offset) + fabs(curve.gain) + 10.0);
        TEST_ASSERT_TRUE(largest <= stated + rounding);
        TEST_ASSERT_TRUE(largest >= stated - 2.0 * steepest * (high - low) / NUM_STEPS - rounding);
        curve_free(&curve);
    }
}

/// The envelope |v| clipped to two straight pieces needs 3 knots at any error below the kink's; with one knot
/// less the chord misses the kink by its whole height.
static void one_kink_takes_three_knots(void)
{
    random_t random = random_new(13);
    model_t model = plays_model(&random, 1, 0.0);
    const double x[] = {0.0, 0.5, 1.0};
    const double y[] = {0.0, 0.1, 1.0};
    model.ascending = curve_table(x, y, 3);
    model.descending = curve_table(x, y, 3);
    model.weight[0] = 1.0;
    grid_t grid = grid_find(&model, GRID_OF_FLOATS, 0.0, 1.0, 1e-3);
    TEST_ASSERT_EQUAL_UINT64(3, grid.num_knots);
    // Two knots would be off by the kink's height: 0.5 - 0.1.
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.4, chord_error(&model.ascending, 0.0, 1.0));
    grid_free(&grid);
    model_free(&model);
}

/// A chord of width h over f errs by h^2 max|f''| / 8 at most, so n cells of equal width 1/n suffice with
/// n = ceil(sqrt(max|f''| / (8 E))); greedy cells are at least as long.
static void tanh_takes_no_more_knots_than_equal_cells(void)
{
    random_t random = random_new(14);
    model_t model = plays_model(&random, 1, 0.0);
    model.ascending = curve_tanh(4.0, -2.0);
    model.descending = curve_tanh(4.0, -2.0);
    model.weight[0] = 1.0;
    // max |tanh''| = 4 / (3 sqrt(3)) = 0.7699, times slope^2.
    const double curvature = 16.0 * 4.0 / (3.0 * sqrt(3.0));
    for (int power = 2; power <= 5; ++power) {
        const double error = pow(10.0, -power);
        grid_t grid = grid_find(&model, GRID_OF_FLOATS, 0.0, 1.0, error);
        TEST_ASSERT_TRUE(grid.error <= error);
        TEST_ASSERT_TRUE((double)grid.num_knots <= 1.0 + ceil(sqrt(curvature / (8.0 * error))));
        grid_free(&grid);
    }
    model_free(&model);
}

static void classical_takes_no_table(void)
{
    random_t random = random_new(15);
    model_t model = plays_model(&random, 6, 0.5);
    model.input_min = -20.0;
    model.input_max = 120.0;
    model.ascending = curve_linear(0.5, 0.25);
    model.descending = curve_linear(0.5, -0.75);
    model.nonhysteretic = curve_linear(0.1, 3.0);
    tabulated_t tabulated;
    TEST_ASSERT_NULL(tabulate(&model, 0.0, &tabulated));
    TEST_ASSERT_EQUAL_UINT32(0, tabulated.model.num_knots);
    TEST_ASSERT_NULL(tabulated.model.knot);
    // (0.5 - (0.25 + 0.75) / 2) / 0.5
    TEST_ASSERT_EQUAL_FLOAT(0.0f, tabulated.radius[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, tabulated.table_error);
    TEST_ASSERT_TRUE(largest_difference(&random, &model, &tabulated.model) <= tabulated.float_error);
    tabulated_free(&tabulated);
    model_free(&model);
}

static void unequal_slopes_take_two_knots(void)
{
    random_t random = random_new(16);
    model_t model = plays_model(&random, 4, 0.3);
    model.ascending = curve_linear(1.0, 0.0);
    model.descending = curve_linear(1.5, 0.0);
    tabulated_t tabulated;
    TEST_ASSERT_NULL(tabulate(&model, 0.0, &tabulated));
    TEST_ASSERT_EQUAL_UINT32(2, tabulated.model.num_knots);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, tabulated.table_error);
    tabulated_free(&tabulated);
    model_free(&model);
}

/// tanh(-20 ... 20) is flat to the last bit of a float over most of the range.
static void saturated_tails_still_increase(void)
{
    random_t random = random_new(17);
    model_t model = plays_model(&random, 3, 0.1);
    model.ascending = curve_tanh(40.0, -20.0);
    model.descending = curve_tanh(40.0, -20.0);
    for (int power = 2; power <= 6; ++power) {
        tabulated_t tabulated;
        TEST_ASSERT_NULL(tabulate(&model, pow(10.0, -power), &tabulated));
        for (uint32_t k = 1; k < tabulated.model.num_knots; ++k) {
            TEST_ASSERT_TRUE(tabulated.knot[k].input > tabulated.knot[k - 1].input);
            TEST_ASSERT_TRUE(tabulated.knot[k].ascending > tabulated.knot[k - 1].ascending);
            TEST_ASSERT_TRUE(tabulated.knot[k].descending > tabulated.knot[k - 1].descending);
        }
        const double bound = tabulated.table_error + tabulated.float_error;
        TEST_ASSERT_TRUE(largest_difference(&random, &model, &tabulated.model) <= bound);
        tabulated_free(&tabulated);
    }
    model_free(&model);
}

static void impossible_wishes_are_told(void)
{
    random_t random = random_new(18);
    tabulated_t tabulated;
    model_t model = plays_model(&random, 3, 0.1);
    model.input_min = 1e9;
    model.input_max = 1e9 + 1.0;
    TEST_ASSERT_NOT_NULL(tabulate(&model, 1e-3, &tabulated));
    TEST_ASSERT_NULL(tabulated.radius);
    model.input_min = 0.0;
    model.input_max = 1.0;
    model.ascending = curve_tanh(3.0, 0.0);
    TEST_ASSERT_NOT_NULL(tabulate(&model, 0.0, &tabulated));
    model_free(&model);
    model = plays_model(&random, HYST_MAX_PLAYS + 1, 0.1);
    TEST_ASSERT_NOT_NULL(tabulate(&model, 1e-3, &tabulated));
    model_free(&model);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(stated_errors_are_never_exceeded);
    RUN_TEST(chord_errors_hold_on_a_dense_grid);
    RUN_TEST(one_kink_takes_three_knots);
    RUN_TEST(tanh_takes_no_more_knots_than_equal_cells);
    RUN_TEST(classical_takes_no_table);
    RUN_TEST(unequal_slopes_take_two_knots);
    RUN_TEST(saturated_tails_still_increase);
    RUN_TEST(impossible_wishes_are_told);
    return UNITY_END();
}
