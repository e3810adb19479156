#include "f32_model.h"
#include <float.h>
#include <math.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static f32_model_t single_play(float radius, float weight, float slope)
{
    return f32_classical(&radius, &weight, 1, slope, -4.0F, 4.0F);
}

static void assert_step(float expected, f32_model_t* made, hyst_f32_state_t* state, float input)
{
    TEST_ASSERT_EQUAL_HEX32(f32_bits(expected), f32_bits(hyst_f32_step(&made->model, state, input)));
}

/// Numbers that are exact in binary: the play of radius 1 with weight 2 and D = v / 2.
static void test_one_play_by_hand(void)
{
    f32_model_t made = single_play(1.0F, 2.0F, 0.5F);
    hyst_f32_state_t state = f32_state(&made);
    TEST_ASSERT_TRUE(state.output == -2.0F + 2.0F * -3.0F);
    assert_step(-1.0F + 2.0F * -3.0F, &made, &state, -2.0F);
    assert_step(0.0F + 2.0F * -1.0F, &made, &state, 0.0F);
    assert_step(-1.0F + 2.0F * -1.0F, &made, &state, -2.0F);
    assert_step(-1.5F + 2.0F * -2.0F, &made, &state, -3.0F);
    assert_step(2.0F + 2.0F * 3.0F, &made, &state, 4.0F);
    f32_free(&made);
}

static void test_radius_0_follows_the_envelope(void)
{
    f32_model_t made = single_play(0.0F, 3.0F, 0.0F);
    hyst_f32_state_t state = f32_state(&made);
    assert_step(4.5F, &made, &state, 1.5F);
    assert_step(-7.5F, &made, &state, -2.5F);
    f32_free(&made);
}

static void test_equal_radii_act_as_one_play(void)
{
    const float radius[] = {1.0F, 1.0F};
    const float weight[] = {0.5F, 1.5F};
    f32_model_t two = f32_classical(radius, weight, 2, 0.0F, -4.0F, 4.0F);
    f32_model_t one = single_play(1.0F, 2.0F, 0.0F);
    hyst_f32_state_t state_of_two = f32_state(&two);
    hyst_f32_state_t state_of_one = f32_state(&one);
    const float inputs[] = {1.0F, -0.5F, 3.25F, -4.0F, 4.0F, 0.125F};
    for (int i = 0; i < 6; ++i) {
        assert_step(hyst_f32_step(&one.model, &state_of_one, inputs[i]), &two, &state_of_two, inputs[i]);
    }
    f32_free(&two);
    f32_free(&one);
}

static void test_weights_of_0_leave_the_nonhysteretic_part(void)
{
    f32_model_t made = single_play(1.0F, 0.0F, 0.25F);
    hyst_f32_state_t state = f32_state(&made);
    assert_step(0.75F, &made, &state, 3.0F);
    assert_step(-0.25F, &made, &state, -1.0F);
    f32_free(&made);
}

static void test_a_play_wider_than_the_range_stays(void)
{
    f32_model_t made = single_play(5.0F, 1.0F, 0.0F);
    hyst_f32_state_t state = f32_state(&made);
    assert_step(1.0F, &made, &state, 4.0F);
    assert_step(1.0F, &made, &state, -4.0F);
    f32_free(&made);
}

static void test_an_unchanged_input_changes_nothing(void)
{
    f32_model_t made = single_play(1.0F, 2.0F, 0.5F);
    hyst_f32_state_t state = f32_state(&made);
    const float output = hyst_f32_step(&made.model, &state, 0.3F);
    const hyst_f32_segment_t memory = made.memory[0];
    assert_step(output, &made, &state, 0.3F);
    TEST_ASSERT_EQUAL_MEMORY(&memory, &made.memory[0], sizeof memory);
    f32_free(&made);
}

static void test_nan_is_held_and_counted(void)
{
    f32_model_t made = single_play(1.0F, 2.0F, 0.5F);
    hyst_f32_state_t state = f32_state(&made);
    const float output = hyst_f32_step(&made.model, &state, 1.0F);
    assert_step(output, &made, &state, NAN);
    assert_step(output, &made, &state, -NAN);
    TEST_ASSERT_EQUAL_UINT32(2, state.invalid_inputs);
    TEST_ASSERT_EQUAL_UINT32(0, state.clamped_inputs);
    TEST_ASSERT_TRUE(state.input == 1.0F);
    f32_free(&made);
}

static void test_inputs_out_of_range_are_clamped_and_counted(void)
{
    f32_model_t made = single_play(1.0F, 2.0F, 0.5F);
    hyst_f32_state_t state = f32_state(&made);
    const float high = hyst_f32_step(&made.model, &state, 4.0F);
    const float low = hyst_f32_step(&made.model, &state, -4.0F);
    TEST_ASSERT_EQUAL_UINT32(0, state.clamped_inputs);
    assert_step(high, &made, &state, nextafterf(4.0F, 5.0F));
    assert_step(low, &made, &state, -5.0F);
    assert_step(high, &made, &state, INFINITY);
    assert_step(low, &made, &state, -INFINITY);
    TEST_ASSERT_EQUAL_UINT32(4, state.clamped_inputs);
    TEST_ASSERT_TRUE(state.input == -4.0F);
    f32_free(&made);
}

static void test_counters_saturate(void)
{
    f32_model_t made = single_play(1.0F, 2.0F, 0.5F);
    hyst_f32_state_t state = f32_state(&made);
    state.invalid_inputs = UINT32_MAX - 1;
    state.clamped_inputs = UINT32_MAX - 1;
    for (int i = 0; i < 3; ++i) {
        (void)hyst_f32_step(&made.model, &state, NAN);
        (void)hyst_f32_step(&made.model, &state, 9.0F);
    }
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, state.invalid_inputs);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, state.clamped_inputs);
    f32_free(&made);
}

/// The three starts of one play of radius 1 on [-4, 4], by hand, moved to 0.
static void test_resets_by_hand(void)
{
    f32_model_t made = single_play(1.0F, 1.0F, 0.0F);
    hyst_f32_state_t state = f32_state(&made);
    state.clamped_inputs = 7;
    TEST_ASSERT_TRUE(hyst_f32_reset(&made.model, &state, HYST_START_NEGATIVE_SATURATION, 0.0F) == -1.0F);
    TEST_ASSERT_TRUE(hyst_f32_reset(&made.model, &state, HYST_START_POSITIVE_SATURATION, 0.0F) == 1.0F);
    TEST_ASSERT_TRUE(hyst_f32_reset(&made.model, &state, HYST_START_DEMAGNETISED, 0.0F) == 0.0F);
    TEST_ASSERT_TRUE(hyst_f32_reset(&made.model, &state, HYST_START_DEMAGNETISED, 2.0F) == 1.0F);
    TEST_ASSERT_EQUAL_UINT32(7, state.clamped_inputs);
    TEST_ASSERT_TRUE(hyst_f32_reset(&made.model, &state, HYST_START_NEGATIVE_SATURATION, INFINITY) == 3.0F);
    TEST_ASSERT_EQUAL_UINT32(8, state.clamped_inputs);
    TEST_ASSERT_TRUE(hyst_f32_reset(&made.model, &state, HYST_START_POSITIVE_SATURATION, NAN) == 1.0F);
    TEST_ASSERT_TRUE(state.input == 0.0F);
    TEST_ASSERT_EQUAL_UINT32(0, state.invalid_inputs);
    f32_free(&made);
}

/// From any cell to any other, at, just below and just above each knot: exact at knots, whatever came before.
static void test_every_move_between_cells(void)
{
    const float radius = 0.0F;
    const float weight = 1.0F;
    hyst_f32_knot_t knot[6] = {{0}};
    for (int k = 0; k < 6; ++k) {
        knot[k].input = (float)(k * k);
        knot[k].ascending = (float)(k * k * k);
        knot[k].descending = (float)(k * k * k);
    }
    f32_model_t made = f32_tabulated(&radius, &weight, 1, knot, 6, 0.0F);
    hyst_f32_state_t state = f32_state(&made);
    for (int from = 0; from < 6; ++from) {
        for (int to = 0; to < 6; ++to) {
            (void)hyst_f32_step(&made.model, &state, knot[from].input);
            assert_step(knot[to].ascending, &made, &state, knot[to].input);
            TEST_ASSERT_EQUAL_UINT32(to < 5 ? to : 4, state.cell);
            (void)hyst_f32_step(&made.model, &state, knot[from].input);
            (void)hyst_f32_step(&made.model, &state, nextafterf(knot[to].input, 0.0F));
            TEST_ASSERT_EQUAL_UINT32(to > 0 ? to - 1 : 0, state.cell);
        }
    }
    f32_free(&made);
}

/// The last knot, which no cell begins at, is where the last cell's line ends: at it, or a few units below.
static void test_both_ends(void)
{
    const float radius = 0.0F;
    const float weight = 1.0F;
    random_t random = random_new(1);
    for (int i = 0; i < 100; ++i) {
        hyst_f32_knot_t knot[2] = {{.input = (float)random_uniform(&random, -2.0, -1.0)},
                                   {.input = (float)random_uniform(&random, 1.0, 2.0)}};
        knot[0].ascending = knot[0].descending = (float)random_uniform(&random, -2.0, -1.0);
        knot[1].ascending = knot[1].descending = (float)random_uniform(&random, 1.0, 2.0);
        f32_model_t made = f32_tabulated(&radius, &weight, 1, knot, 2, 0.0F);
        hyst_f32_state_t state = f32_state(&made);
        const float rise = made.knot[0].ascending_slope * (knot[1].input - knot[0].input);
        const float end = knot[0].ascending + rise;
        TEST_ASSERT_TRUE(end <= knot[1].ascending && end >= knot[1].ascending - 4.0F * FLT_EPSILON * 2.0F);
        assert_step(end, &made, &state, knot[1].input);
        assert_step(knot[0].descending, &made, &state, knot[0].input);
        f32_free(&made);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_play_by_hand);
    RUN_TEST(test_radius_0_follows_the_envelope);
    RUN_TEST(test_equal_radii_act_as_one_play);
    RUN_TEST(test_weights_of_0_leave_the_nonhysteretic_part);
    RUN_TEST(test_a_play_wider_than_the_range_stays);
    RUN_TEST(test_an_unchanged_input_changes_nothing);
    RUN_TEST(test_nan_is_held_and_counted);
    RUN_TEST(test_inputs_out_of_range_are_clamped_and_counted);
    RUN_TEST(test_counters_saturate);
    RUN_TEST(test_resets_by_hand);
    RUN_TEST(test_every_move_between_cells);
    RUN_TEST(test_both_ends);
    return UNITY_END();
}
