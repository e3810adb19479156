#include "f32_model.h"
#include <float.h>
#include <math.h>
#include <string.h>
#include <unity.h>

static f32_model_t made;
static hyst_f32_state_t state;

void setUp(void)
{
    const float radius[] = {0.0F, 1.0F, 2.0F};
    const float weight[] = {1.0F, 2.0F, 4.0F};
    made = f32_classical(radius, weight, 3, 0.5F, -4.0F, 4.0F);
    state = f32_state(&made);
}

void tearDown(void)
{
    f32_free(&made);
}

static void test_saves_the_input_and_the_plays(void)
{
    float snapshot[5] = {0.0F, 0.0F, 0.0F, 0.0F, 99.0F};
    (void)hyst_f32_step(&made.model, &state, 1.0F);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_save(&made.model, &state, snapshot, 5));
    TEST_ASSERT_TRUE(snapshot[0] == 1.0F && snapshot[1] == 1.0F && snapshot[2] == 0.0F &&
                     snapshot[3] == -1.0F);
    TEST_ASSERT_TRUE(snapshot[4] == 99.0F);
}

static void test_null_and_short(void)
{
    float snapshot[4] = {0};
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_save(NULL, &state, snapshot, 4));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_save(&made.model, NULL, snapshot, 4));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_save(&made.model, &state, NULL, 4));
    TEST_ASSERT_EQUAL(HYST_STATUS_MEMORY_LENGTH, hyst_f32_save(&made.model, &state, snapshot, 3));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_restore(NULL, &state, snapshot, 4));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_restore(&made.model, NULL, snapshot, 4));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_restore(&made.model, &state, NULL, 4));
    TEST_ASSERT_EQUAL(HYST_STATUS_MEMORY_LENGTH, hyst_f32_restore(&made.model, &state, snapshot, 3));
}

static void assert_refused(float input, float w0, float w1, float w2)
{
    const float snapshot[] = {input, w0, w1, w2};
    const hyst_f32_state_t before = state;
    float memory[3];
    memcpy(memory, made.memory, sizeof memory);
    TEST_ASSERT_EQUAL(HYST_STATUS_SNAPSHOT, hyst_f32_restore(&made.model, &state, snapshot, 4));
    TEST_ASSERT_EQUAL_MEMORY(&before, &state, sizeof state);
    TEST_ASSERT_EQUAL_MEMORY(memory, made.memory, sizeof memory);
}

static void test_refuses_impossible_states(void)
{
    assert_refused(NAN, 0.0F, 0.0F, 0.0F);
    assert_refused(INFINITY, 0.0F, 0.0F, 0.0F);
    assert_refused(4.5F, 4.5F, 4.5F, 4.5F);
    assert_refused(nextafterf(-4.0F, -5.0F), -4.0F, -4.0F, -4.0F);
    assert_refused(0.0F, NAN, 0.0F, 0.0F);
    assert_refused(0.0F, 0.0F, 0.0F, -INFINITY);
    // Outside its strip: radius 0 must follow the input, radius 1 stays within 1 of it.
    assert_refused(0.0F, 0.1F, 0.0F, 0.0F);
    assert_refused(0.0F, 0.0F, -1.01F, -1.0F);
    assert_refused(0.0F, 0.0F, 0.5F, 2.01F);
    // Each in its strip, but further apart than their radii.
    assert_refused(0.0F, 0.0F, 0.9F, -0.2F);
}

static void test_takes_rounding_and_no_more(void)
{
    // The allowance is 20 FLT_EPSILON of (4 + radius); half of it passes, twice does not.
    const float slack = 20.0F * FLT_EPSILON * 5.0F;
    const float nearly[] = {0.0F, 0.0F, 1.0F + 0.5F * slack, 1.0F};
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_restore(&made.model, &state, nearly, 4));
    TEST_ASSERT_TRUE(state.output == 2.0F * nearly[2] + 4.0F);
    assert_refused(0.0F, 0.0F, 1.0F + 2.0F * slack, 1.0F);
}

static void test_restoring_keeps_the_counters(void)
{
    const float snapshot[] = {0.0F, 0.0F, 0.5F, 0.5F};
    (void)hyst_f32_step(&made.model, &state, 9.0F);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_restore(&made.model, &state, snapshot, 4));
    TEST_ASSERT_EQUAL_UINT32(1, state.clamped_inputs);
    TEST_ASSERT_TRUE(state.input == 0.0F && state.output == 3.0F);
}

enum { NUM_GOLDEN = 16 };

static uint32_t golden_bits[4][NUM_GOLDEN];

static hyst_f32_golden_t make_golden(void)
{
    random_t random = random_new(1);
    for (int i = 0; i < NUM_GOLDEN; ++i) {
        const float input = f32_random_input(&random, &made, state.input);
        const float output = hyst_f32_step(&made.model, &state, input);
        const float wanted = (float)random_uniform(&random, -20.0, 20.0);
        golden_bits[0][i] = f32_bits(input);
        golden_bits[1][i] = f32_bits(output);
        golden_bits[2][i] = f32_bits(wanted);
        golden_bits[3][i] = f32_bits(hyst_f32_inverse(&made.model, &state, wanted).input);
    }
    return (hyst_f32_golden_t){NUM_GOLDEN, golden_bits[0], golden_bits[1], golden_bits[2], golden_bits[3]};
}

static void test_self_test_sees_every_flipped_bit(void)
{
    const hyst_f32_golden_t golden = make_golden();
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_self_test(&made.model, &state, &golden));
    for (int array = 1; array < 4; array += 2) {
        for (int i = 0; i < NUM_GOLDEN; ++i) {
            const uint32_t bit = UINT32_C(1) << (2 * i);
            golden_bits[array][i] ^= bit;
            TEST_ASSERT_EQUAL(HYST_STATUS_SELF_TEST, hyst_f32_self_test(&made.model, &state, &golden));
            golden_bits[array][i] ^= bit;
        }
    }
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_self_test(&made.model, &state, &golden));
}

static void test_self_test_leaves_a_fresh_state(void)
{
    hyst_f32_golden_t golden = make_golden();
    const uint32_t beyond = f32_bits(99.0F);
    golden.input_bits = &beyond;
    golden.output_bits = &beyond;
    golden.num_steps = 1;
    TEST_ASSERT_EQUAL(HYST_STATUS_SELF_TEST, hyst_f32_self_test(&made.model, &state, &golden));
    TEST_ASSERT_TRUE(state.input == -4.0F);
    TEST_ASSERT_EQUAL_UINT32(0, state.clamped_inputs);
    TEST_ASSERT_TRUE(made.memory[0] == -4.0F && made.memory[1] == -3.0F && made.memory[2] == -2.0F);
}

static void test_self_test_null(void)
{
    const hyst_f32_golden_t golden = make_golden();
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_self_test(NULL, &state, &golden));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_self_test(&made.model, NULL, &golden));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_self_test(&made.model, &state, NULL));
    for (int missing = 0; missing < 4; ++missing) {
        hyst_f32_golden_t incomplete = golden;
        const uint32_t** arrays[] = {&incomplete.input_bits, &incomplete.output_bits, &incomplete.wanted_bits,
                                     &incomplete.inverse_bits};
        *arrays[missing] = NULL;
        TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_self_test(&made.model, &state, &incomplete));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_saves_the_input_and_the_plays);
    RUN_TEST(test_null_and_short);
    RUN_TEST(test_refuses_impossible_states);
    RUN_TEST(test_takes_rounding_and_no_more);
    RUN_TEST(test_restoring_keeps_the_counters);
    RUN_TEST(test_self_test_sees_every_flipped_bit);
    RUN_TEST(test_self_test_leaves_a_fresh_state);
    RUN_TEST(test_self_test_null);
    return UNITY_END();
}
