#include "q_scalar.h"
#if HYST_Q_BITS == 32
#include "hyst/hyst_q31_homing.h"
#else
#include "hyst/hyst_q15_homing.h"
#endif
#include "random_model.h"
#include <math.h>
#include <string.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

/// Of the model a sequence takes the range alone.
static SCALAR(model_t) model_on(value_t input_min, value_t input_max)
{
    SCALAR(model_t) model;
    memset(&model, 0, sizeof model);
    model.input_min = input_min;
    model.input_max = input_max;
    return model;
}

static void assert_sequence(value_t input_min, value_t input_max, const value_t expected[6])
{
    const SCALAR(model_t) model = model_on(input_min, input_max);
    SCALAR(homing_t) homing;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(homing_init)(&homing, &model, 2));
    TEST_ASSERT_EQUAL_UINT32(6, homing.num_samples);
    value_t input = 0;
    for (int i = 0; i < 6; ++i) {
        TEST_ASSERT_TRUE(SCALAR(homing_next)(&homing, &input));
        TEST_ASSERT_EQUAL_INT32(expected[i], input);
    }
    for (int i = 0; i < 3; ++i) {
        input = 99;
        TEST_ASSERT_FALSE(SCALAR(homing_next)(&homing, &input));
        TEST_ASSERT_EQUAL_INT32(expected[5], input);
    }
}

/// Half the range is 8, or 8 and a half, and 2 cycles are 4 steps of 2 each; or 7, and the steps are rounded.
static void test_two_cycles_by_hand(void)
{
    assert_sequence(-4, 12, (const value_t[]){12, -4, 10, 0, 6, 4});
    assert_sequence(-4, 13, (const value_t[]){13, -4, 10, 0, 6, 4});
    assert_sequence(-4, 10, (const value_t[]){10, -4, 8, 0, 4, 3});
}

static void test_refusals_write_nothing(void)
{
    const SCALAR(model_t) model = model_on(-4, 12);
    SCALAR(homing_t) homing;
    memset(&homing, 0x5A, sizeof homing);
    const SCALAR(homing_t) before = homing;
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, SCALAR(homing_init)(NULL, &model, 2));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, SCALAR(homing_init)(&homing, NULL, 2));
    TEST_ASSERT_EQUAL(HYST_STATUS_CYCLES, SCALAR(homing_init)(&homing, &model, 0));
    TEST_ASSERT_EQUAL(HYST_STATUS_CYCLES, SCALAR(homing_init)(&homing, &model, HYST_MAX_HOMING_CYCLES + 1));
    TEST_ASSERT_EQUAL_MEMORY(&before, &homing, sizeof homing);
}

/// The most cycles there are on the widest range: within it, and each swing no larger than the one before.
static void test_the_longest_sequence_stays_in_range_and_decays(void)
{
    const SCALAR(model_t) model = model_on(VALUE_MIN, VALUE_MAX);
    SCALAR(homing_t) homing;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(homing_init)(&homing, &model, HYST_MAX_HOMING_CYCLES));
    value_t before[2] = {VALUE_MAX, VALUE_MIN};
    uint32_t count = 0;
    value_t input = 0;
    while (SCALAR(homing_next)(&homing, &input)) {
        const bool inside = count % 2 == 0 ? input <= before[0] && input >= homing.middle
                                           : input >= before[1] && input <= homing.middle;
        if (!inside) {
            break;
        }
        before[count % 2] = input;
        ++count;
    }
    TEST_ASSERT_EQUAL_UINT32(2 * HYST_MAX_HOMING_CYCLES + 2, count);
    TEST_ASSERT_EQUAL_INT32(homing.middle, input);
}

/// Plays that the range moves not at all, or only just, are left where they are: their weights are set to 0.
static void weigh_moving_plays(model_t* model)
{
    const double reach =
        curve_value(&model->ascending, model->input_max) - curve_value(&model->descending, model->input_min);
    for (size_t j = 0; j < model->num_plays; ++j) {
        if (2.0 * model->radius[j] >= 0.999 * reach) {
            model->weight[j] = 0.0;
        }
    }
}

/// State units per input unit.
static double steepest_envelope(const SCALAR(model_t) * model)
{
    double steepest = 0.0;
    for (uint32_t k = 0; k + 1 < model->num_knots; ++k) {
        const double slope =
            fmax((double)model->knot[k].ascending_slope, (double)model->knot[k].descending_slope);
        steepest = fmax(steepest, ldexp(slope, (int)model->knot[k].shift - HYST_Q_BITS));
    }
    return steepest;
}

/// With O(a, b) = ascending(middle + a) - descending(middle - b) and the swings A_0 >= A_1 >= ..., a play's
/// last push at swing k means O(A_k, A_k+1) <= 2 r < O(A_k, A_k-1); the least a with O(a, a) >= 2 r, which
/// the demagnetised start ends at, then lies in A_k+1 ... A_k-1: no further from A_k than one step of the
/// amplitude, width / (4 cycles) rounded up to the next unit or, after an odd range's first sample, one more.
/// The start's own last push is between a - 1 and a. Two levels are rounded, by half a unit each, and the
/// output.
static void assert_erases(random_t* random, const model_t* model, uint32_t cycles)
{
    q_model_t q = q_new(model, BITS, q_random_table_error(random, model));
    const SCALAR(model_t)* fixed = &OWNED(&q).model;
    SCALAR(state_t)* state = &STATE(&q);
    for (int i = 0; i < 30; ++i) {
        (void)SCALAR(step)(fixed, state, (value_t)q_random_input(random, &q, state->input));
    }
    const uint32_t clamped_inputs = state->clamped_inputs;
    SCALAR(homing_t) homing;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(homing_init)(&homing, fixed, cycles));
    value_t input = 0;
    while (SCALAR(homing_next)(&homing, &input)) {
        (void)SCALAR(step)(fixed, state, input);
    }
    TEST_ASSERT_EQUAL_UINT32(clamped_inputs, state->clamped_inputs);
    const double homed = (double)state->output;
    const double expected = (double)SCALAR(reset)(fixed, state, HYST_START_DEMAGNETISED, homing.middle);
    const double width = (double)fixed->input_max - (double)fixed->input_min;
    const double step = width / (4.0 * cycles) + 3.0;
    const double weight = ldexp((double)fixed->cumulative_weight[fixed->num_plays], -HYST_Q_BITS);
    TEST_ASSERT_DOUBLE_WITHIN(weight * (steepest_envelope(fixed) * step + 1.0) + 1.0, expected, homed);
    q_free(&q);
}

static void test_erases_any_past_within_the_bound(void)
{
    random_t random = random_new(1);
    for (int i = 0; i < 24; ++i) {
        model_t model = random_model(&random);
        weigh_moving_plays(&model);
        assert_erases(&random, &model, 1 + (uint32_t)random_below(&random, 200));
        model_free(&model);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_two_cycles_by_hand);
    RUN_TEST(test_refusals_write_nothing);
    RUN_TEST(test_the_longest_sequence_stays_in_range_and_decays);
    RUN_TEST(test_erases_any_past_within_the_bound);
    return UNITY_END();
}
