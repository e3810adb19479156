#include "f32_model.h"
#include <math.h>
#include <unity.h>

static f32_model_t made;
static hyst_f32_state_t state;

/// One play of radius 1 with weight 2 on [-4, 4] without D: the output is flat after each reversal, for a
/// width of 2.
void setUp(void)
{
    const float radius = 1.0F;
    const float weight = 2.0F;
    made = f32_classical(&radius, &weight, 1, 0.0F, -4.0F, 4.0F);
    state = f32_state(&made);
}

void tearDown(void)
{
    f32_free(&made);
}

static hyst_f32_inverse_t inverse(float wanted)
{
    return hyst_f32_inverse(&made.model, &state, wanted);
}

static void test_the_present_output_wants_the_present_input(void)
{
    (void)hyst_f32_step(&made.model, &state, 1.25F);
    const hyst_f32_inverse_t found = inverse(state.output);
    TEST_ASSERT_TRUE(found.input == 1.25F);
    TEST_ASSERT_FALSE(found.clamped);
}

static void test_by_hand_across_the_flat_stretch(void)
{
    (void)hyst_f32_step(&made.model, &state, 1.0F);
    TEST_ASSERT_TRUE(state.output == 0.0F);
    TEST_ASSERT_TRUE(inverse(1.0F).input == 1.5F);
    TEST_ASSERT_TRUE(inverse(-1.0F).input == -1.5F);
    TEST_ASSERT_TRUE(inverse(-6.0F).input == -4.0F);
    TEST_ASSERT_TRUE(inverse(6.0F).input == 4.0F);
    const hyst_f32_reach_t reach = hyst_f32_reachable(&made.model, &state);
    TEST_ASSERT_TRUE(reach.reachable_min == -6.0F && reach.reachable_max == 6.0F);
}

static void test_out_of_reach_is_clamped(void)
{
    TEST_ASSERT_TRUE(inverse(7.0F).clamped);
    TEST_ASSERT_TRUE(inverse(7.0F).input == 4.0F);
    TEST_ASSERT_TRUE(inverse(-INFINITY).clamped);
    TEST_ASSERT_TRUE(inverse(-INFINITY).input == -4.0F);
    TEST_ASSERT_TRUE(inverse(INFINITY).input == 4.0F);
}

static void test_nan_keeps_the_input(void)
{
    (void)hyst_f32_step(&made.model, &state, -0.75F);
    const hyst_f32_inverse_t found = inverse(NAN);
    TEST_ASSERT_TRUE(found.clamped);
    TEST_ASSERT_TRUE(found.input == -0.75F);
}

/// A model whose output cannot change: everything but that output is out of reach, and the input stays.
static void test_a_constant_output(void)
{
    const float radius = 9.0F;
    const float weight = 1.0F;
    f32_model_t stuck = f32_classical(&radius, &weight, 1, 0.0F, -4.0F, 4.0F);
    hyst_f32_state_t stuck_state = f32_state(&stuck);
    (void)hyst_f32_step(&stuck.model, &stuck_state, 1.0F);
    for (float wanted = 4.0F; wanted <= 6.0F; wanted += 0.5F) {
        const hyst_f32_inverse_t found = hyst_f32_inverse(&stuck.model, &stuck_state, wanted);
        const hyst_f32_reach_t reach = hyst_f32_reachable(&stuck.model, &stuck_state);
        TEST_ASSERT_TRUE(found.input == 1.0F && reach.reachable_min == 5.0F && reach.reachable_max == 5.0F);
        TEST_ASSERT_EQUAL(wanted < 5.0F || wanted > 5.0F, found.clamped);
    }
    f32_free(&stuck);
}

/// Output flat at its top from 2 on: the nearest input that gives the top is 2, both asked for and out of
/// reach.
static void test_a_saturated_top_gives_its_near_end(void)
{
    const float radius = 0.0F;
    const float weight = 1.0F;
    const hyst_f32_knot_t knot[] = {{.input = 0.0F},
                                    {.input = 2.0F, .ascending = 1.0F, .descending = 1.0F},
                                    {.input = 3.0F, .ascending = 1.0F, .descending = 1.0F},
                                    {.input = 9.0F, .ascending = 1.0F, .descending = 1.0F}};
    f32_model_t flat = f32_tabulated(&radius, &weight, 1, knot, 4, 0.0F);
    hyst_f32_state_t flat_state = f32_state(&flat);
    TEST_ASSERT_TRUE(hyst_f32_inverse(&flat.model, &flat_state, 1.0F).input == 2.0F);
    TEST_ASSERT_TRUE(hyst_f32_inverse(&flat.model, &flat_state, 5.0F).input == 2.0F);
    (void)hyst_f32_step(&flat.model, &flat_state, 9.0F);
    TEST_ASSERT_TRUE(hyst_f32_inverse(&flat.model, &flat_state, 0.5F).input == 1.0F);
    f32_free(&flat);
}

/// The plays' kinks one by one: after a descent from 4 to -4, play j starts to move at -4 + 2 r_j.
static void test_between_kinks(void)
{
    const float radius[] = {0.5F, 1.0F, 2.0F};
    const float weight[] = {1.0F, 2.0F, 4.0F};
    f32_model_t three = f32_classical(radius, weight, 3, 0.0F, -4.0F, 4.0F);
    hyst_f32_state_t start = f32_state(&three);
    const float outputs[] = {0.5F, 1.0F, 2.5F, 4.0F, 7.0F, 14.0F, 28.0F};
    const float inputs[] = {-2.5F, -2.0F, -1.5F, -1.0F, 0.0F, 1.0F, 3.0F};
    for (int i = 0; i < 7; ++i) {
        TEST_ASSERT_TRUE(hyst_f32_inverse(&three.model, &start, start.output + outputs[i]).input ==
                         inputs[i]);
    }
    f32_free(&three);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_present_output_wants_the_present_input);
    RUN_TEST(test_by_hand_across_the_flat_stretch);
    RUN_TEST(test_out_of_reach_is_clamped);
    RUN_TEST(test_nan_keeps_the_input);
    RUN_TEST(test_a_constant_output);
    RUN_TEST(test_a_saturated_top_gives_its_near_end);
    RUN_TEST(test_between_kinks);
    return UNITY_END();
}
