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

enum { LENGTH = HYST_F32_SNAPSHOT_LENGTH(3), INPUT = 0, PLAYS, COUNT, LEVEL_0, PLAYS_0, LEVEL_1, PLAYS_1 };

/// After 1 and 0 from negative saturation: all plays left at 1 by the rise, of which the first went back to
/// 0.
static const float sound[LENGTH] = {0.0F, -4.0F, 2.0F, 1.0F, 3.0F, 0.0F, -1.0F};

static void test_saves_the_input_and_the_segments(void)
{
    float snapshot[LENGTH + 1];
    snapshot[LENGTH] = 99.0F;
    (void)hyst_f32_step(&made.model, &state, 1.0F);
    (void)hyst_f32_step(&made.model, &state, 0.0F);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_save(&made.model, &state, snapshot, LENGTH + 1));
    for (int i = 0; i < LENGTH; ++i) {
        TEST_ASSERT_TRUE(snapshot[i] == sound[i]);
    }
    TEST_ASSERT_TRUE(snapshot[LENGTH] == 99.0F);
}

static void test_null_and_short(void)
{
    float snapshot[LENGTH] = {0};
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_save(NULL, &state, snapshot, LENGTH));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_save(&made.model, NULL, snapshot, LENGTH));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_save(&made.model, &state, NULL, LENGTH));
    TEST_ASSERT_EQUAL(HYST_STATUS_MEMORY_LENGTH, hyst_f32_save(&made.model, &state, snapshot, LENGTH - 1));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_restore(NULL, &state, snapshot, LENGTH));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_restore(&made.model, NULL, snapshot, LENGTH));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_restore(&made.model, &state, NULL, LENGTH));
    TEST_ASSERT_EQUAL(HYST_STATUS_MEMORY_LENGTH, hyst_f32_restore(&made.model, &state, snapshot, LENGTH - 1));
}

/// Refused with `bad` at this place of the sound snapshot, and nothing written.
static void assert_refused(int place, float bad)
{
    float snapshot[LENGTH];
    memcpy(snapshot, sound, sizeof snapshot);
    snapshot[place] = bad;
    const hyst_f32_state_t before = state;
    hyst_f32_segment_t memory[3];
    memcpy(memory, made.memory, sizeof memory);
    TEST_ASSERT_EQUAL(HYST_STATUS_SNAPSHOT, hyst_f32_restore(&made.model, &state, snapshot, LENGTH));
    TEST_ASSERT_EQUAL_MEMORY(&before, &state, sizeof state);
    TEST_ASSERT_EQUAL_MEMORY(memory, made.memory, sizeof memory);
}

static void test_refuses_impossible_states(void)
{
    assert_refused(INPUT, NAN);
    assert_refused(INPUT, INFINITY);
    assert_refused(INPUT, 4.5F);
    assert_refused(INPUT, nextafterf(-4.0F, -5.0F));
    assert_refused(PLAYS, NAN);
    assert_refused(PLAYS, -4.1F);
    assert_refused(LEVEL_0, NAN);
    assert_refused(LEVEL_0, INFINITY);
    assert_refused(LEVEL_1, NAN);
    // Outside its strip: radius 0 must follow the input, radius 1 stays within 1 of it.
    assert_refused(LEVEL_1, 0.1F);
    assert_refused(LEVEL_1, -0.1F);
    assert_refused(LEVEL_0, 2.1F);
    assert_refused(LEVEL_0, -0.1F);
    assert_refused(PLAYS_0, -3.0F);
    // Each in its strip, but further apart than their radii: 0, 1, -1.
    assert_refused(PLAYS_1, -2.0F);
}

static void test_refuses_segments_that_do_not_nest(void)
{
    const float bad_counts[] = {NAN, INFINITY, -2.0F, 0.0F, 0.5F, 1.5F, 4.0F, 1e9F};
    for (size_t i = 0; i < sizeof bad_counts / sizeof bad_counts[0]; ++i) {
        assert_refused(COUNT, bad_counts[i]);
        assert_refused(PLAYS_1, bad_counts[i]);
    }
    // The one segment left holds radius 0 away from the input.
    assert_refused(COUNT, 1.0F);
    // A third one has no plays.
    assert_refused(COUNT, 3.0F);
    assert_refused(PLAYS_0, 2.0F);
    assert_refused(PLAYS_0, 4.0F);
    assert_refused(PLAYS_1, 3.0F);
}

static void test_takes_rounding_and_no_more(void)
{
    // Strip: 20 FLT_EPSILON of (4 + radius); sum: 64 FLT_EPSILON of 7 (4 + 4). Half passes, twice does not.
    const float strip = 20.0F * FLT_EPSILON * 4.0F;
    const float sum = 64.0F * FLT_EPSILON * 56.0F;
    float nearly[LENGTH];
    memcpy(nearly, sound, sizeof nearly);
    nearly[LEVEL_1] = 0.5F * strip;
    nearly[PLAYS] = -4.0F + 0.5F * sum;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_restore(&made.model, &state, nearly, LENGTH));
    TEST_ASSERT_TRUE(state.output == nearly[PLAYS]);
    assert_refused(LEVEL_1, 2.0F * strip);
    assert_refused(PLAYS, -4.0F + 2.0F * sum);
}

static void test_restoring_keeps_the_counters(void)
{
    (void)hyst_f32_step(&made.model, &state, 9.0F);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_restore(&made.model, &state, sound, LENGTH));
    TEST_ASSERT_EQUAL_UINT32(1, state.clamped_inputs);
    TEST_ASSERT_TRUE(state.input == 0.0F && state.output == -4.0F && state.front == 1);
    // Rising to 2 takes all: w = 2, 1, 0.
    TEST_ASSERT_TRUE(hyst_f32_step(&made.model, &state, 2.0F) == 1.0F + 2.0F + 2.0F);
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
    TEST_ASSERT_TRUE(state.front == 0 && made.memory[0].level == 4.0F && made.memory[0].rising == 0);
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
    RUN_TEST(test_saves_the_input_and_the_segments);
    RUN_TEST(test_null_and_short);
    RUN_TEST(test_refuses_impossible_states);
    RUN_TEST(test_refuses_segments_that_do_not_nest);
    RUN_TEST(test_takes_rounding_and_no_more);
    RUN_TEST(test_restoring_keeps_the_counters);
    RUN_TEST(test_self_test_sees_every_flipped_bit);
    RUN_TEST(test_self_test_leaves_a_fresh_state);
    RUN_TEST(test_self_test_null);
    return UNITY_END();
}
