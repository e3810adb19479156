#include "f32_model.h"
#include "hyst/hyst_f32_homing.h"
#include <float.h>
#include <math.h>
#include <string.h>
#include <unity.h>

static f32_model_t made;

void setUp(void)
{
    const float radius[] = {0.0F, 1.0F, 2.0F};
    const float weight[] = {1.0F, 2.0F, 4.0F};
    made = f32_classical(radius, weight, 3, 0.5F, -4.0F, 12.0F);
}

void tearDown(void)
{
    f32_free(&made);
}

/// Half the range is 8 and 2 cycles are 4 steps of 2 each.
static void test_two_cycles_by_hand(void)
{
    const float expected[] = {12.0F, -4.0F, 10.0F, 0.0F, 6.0F, 4.0F};
    hyst_f32_homing_t homing;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_homing_init(&homing, &made.model, 2));
    TEST_ASSERT_EQUAL_UINT32(6, homing.num_samples);
    float input = 0.0F;
    for (int i = 0; i < 6; ++i) {
        TEST_ASSERT_TRUE(hyst_f32_homing_next(&homing, &input));
        TEST_ASSERT_EQUAL_HEX32(f32_bits(expected[i]), f32_bits(input));
    }
    for (int i = 0; i < 3; ++i) {
        input = 99.0F;
        TEST_ASSERT_FALSE(hyst_f32_homing_next(&homing, &input));
        TEST_ASSERT_TRUE(input == 4.0F);
    }
}

static void test_refusals_write_nothing(void)
{
    hyst_f32_homing_t homing;
    memset(&homing, 0x5A, sizeof homing);
    const hyst_f32_homing_t before = homing;
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_homing_init(NULL, &made.model, 2));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_homing_init(&homing, NULL, 2));
    TEST_ASSERT_EQUAL(HYST_STATUS_CYCLES, hyst_f32_homing_init(&homing, &made.model, 0));
    TEST_ASSERT_EQUAL(HYST_STATUS_CYCLES,
                      hyst_f32_homing_init(&homing, &made.model, HYST_MAX_HOMING_CYCLES + 1));
    TEST_ASSERT_EQUAL_MEMORY(&before, &homing, sizeof homing);
}

/// The most cycles there are, on a range whose middle rounds badly: within the range, and each swing no
/// larger than the one before.
static void test_the_longest_sequence_stays_in_range_and_decays(void)
{
    made.model.input_min = -16777215.0F;
    made.model.input_max = 0.3F;
    hyst_f32_homing_t homing;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_homing_init(&homing, &made.model, HYST_MAX_HOMING_CYCLES));
    float before[2] = {made.model.input_max, made.model.input_min};
    uint32_t count = 0;
    float input = 0.0F;
    while (hyst_f32_homing_next(&homing, &input)) {
        const bool inside = count % 2 == 0 ? input <= before[0] && input >= homing.middle
                                           : input >= before[1] && input <= homing.middle;
        if (!inside) {
            break;
        }
        before[count % 2] = input;
        ++count;
    }
    TEST_ASSERT_EQUAL_UINT32(2 * HYST_MAX_HOMING_CYCLES + 2, count);
    TEST_ASSERT_EQUAL_HEX32(f32_bits(homing.middle), f32_bits(input));
}

static double steepest_envelope(const hyst_f32_model_t* model)
{
    double steepest = model->num_knots == 0 ? 1.0 : 0.0;
    for (uint32_t k = 0; k + 1 < model->num_knots; ++k) {
        steepest = fmax(
            steepest, fmax((double)model->knot[k].ascending_slope, (double)model->knot[k].descending_slope));
    }
    return steepest;
}

/// Weights of the plays that the range cannot move are set to 0: the sequence leaves those where they are.
static double weigh_moving_plays(f32_model_t* model)
{
    const hyst_f32_model_t* m = &model->model;
    const double high =
        m->num_knots == 0 ? (double)m->input_max : (double)m->knot[m->num_knots - 1].ascending;
    const double low = m->num_knots == 0 ? (double)m->input_min : (double)m->knot[0].descending;
    double total = 0.0;
    for (uint32_t j = 0; j < m->num_plays; ++j) {
        if (2.0 * (double)model->radius[j] >= high - low) {
            model->weight[j] = 0.0F;
            model->exact.weight[j] = 0.0;
        }
        total += (double)model->weight[j];
    }
    f32_update_plays(model);
    return total;
}

/// A play stays where the swing no longer moves it. With O(a, b) = ascending(middle + a) - descending(middle
/// - b), swings A_0 > A_1 > ... and the ideal A with O(A, A) = 2 r: the last push at swing k means O(A_k,
/// A_k+1)
/// <= 2 r < O(A_k, A_k-1), hence A_k+1 <= A < A_k-1: the state is off by no more than the envelope's rise
/// over one step, (input_max - input_min) / (4 cycles). Inputs are rounded: the step grows by 4 u of range
/// and magnitude at each end. Rounding of the states: that of the demagnetised start, and of a step's output
/// twice.
static void assert_erases(random_t* random, f32_model_t* model, uint32_t cycles)
{
    const double total = weigh_moving_plays(model);
    const double u = 0.5 * (double)FLT_EPSILON;
    hyst_f32_state_t state = f32_state(model);
    for (int i = 0; i < 30; ++i) {
        (void)hyst_f32_step(&model->model, &state, f32_random_input(random, model, state.input));
    }
    hyst_f32_homing_t homing;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_homing_init(&homing, &model->model, cycles));
    float input = 0.0F;
    while (hyst_f32_homing_next(&homing, &input)) {
        (void)hyst_f32_step(&model->model, &state, input);
    }
    TEST_ASSERT_EQUAL_UINT32(0, state.clamped_inputs);
    const float homed = state.output;
    const float expected = hyst_f32_reset(&model->model, &state, HYST_START_DEMAGNETISED, NAN);
    const double width = model->exact.input_max - model->exact.input_min;
    const double magnitude = fmax(fabs(model->exact.input_min), fabs(model->exact.input_max));
    const double step = width / (4.0 * cycles) + 8.0 * u * (width + magnitude);
    const f32_bound_t rounding = f32_bound(model);
    const double bound =
        total * steepest_envelope(&model->model) * step + rounding.demagnetise + 2.0 * rounding.output;
    TEST_ASSERT_TRUE(isfinite(homed) && isfinite(expected));
    TEST_ASSERT_DOUBLE_WITHIN(bound, (double)expected, (double)homed);
}

static void test_erases_any_past_within_the_bound(void)
{
    random_t random = random_new(1);
    for (int i = 0; i < 60; ++i) {
        f32_model_t any = f32_random(&random);
        assert_erases(&random, &any, 1 + (uint32_t)random_below(&random, 200));
        f32_free(&any);
    }
}

/// One cycle on [-4, 12] swings 12, -4, 8, 4: the play of radius 1 goes 11, -3, 7, 5, that of radius 2 goes
/// 10, -2, 6, 6, each within the bound of 16 / 4 of the middle, where demagnetising puts them all.
static void test_few_cycles_leave_a_rest(void)
{
    hyst_f32_state_t state = f32_state(&made);
    hyst_f32_homing_t homing;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_homing_init(&homing, &made.model, 1));
    float input = 0.0F;
    while (hyst_f32_homing_next(&homing, &input)) {
        (void)hyst_f32_step(&made.model, &state, input);
    }
    const float homed = state.output;
    TEST_ASSERT_TRUE(homed == 0.5F * 4.0F + 1.0F * 4.0F + 2.0F * 5.0F + 4.0F * 6.0F);
    TEST_ASSERT_TRUE(hyst_f32_reset(&made.model, &state, HYST_START_DEMAGNETISED, NAN) == 2.0F + 7.0F * 4.0F);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_two_cycles_by_hand);
    RUN_TEST(test_refusals_write_nothing);
    RUN_TEST(test_the_longest_sequence_stays_in_range_and_decays);
    RUN_TEST(test_erases_any_past_within_the_bound);
    RUN_TEST(test_few_cycles_leave_a_rest);
    return UNITY_END();
}
