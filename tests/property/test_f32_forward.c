#include "f32_model.h"
#include "reference.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

enum { NUM_MODELS = 300, NUM_STEPS = 400, MOST_FLOATS = HYST_F32_SNAPSHOT_LENGTH(128) };

void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_same_state(const hyst_f32_model_t* model, const hyst_f32_state_t* a,
                              const hyst_f32_state_t* b)
{
    TEST_ASSERT_EQUAL_HEX32(f32_bits(a->input), f32_bits(b->input));
    TEST_ASSERT_EQUAL_HEX32(f32_bits(a->output), f32_bits(b->output));
    TEST_ASSERT_EQUAL_UINT32(a->cell, b->cell);
    float past_of_a[MOST_FLOATS] = {0};
    float past_of_b[MOST_FLOATS] = {0};
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_save(model, a, past_of_a, MOST_FLOATS));
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_save(model, b, past_of_b, MOST_FLOATS));
    TEST_ASSERT_EQUAL_MEMORY(past_of_a, past_of_b, sizeof past_of_a);
}

/// Within the bound that f32_model.c derives, after every step of a long random history.
static void test_step_follows_the_exact_model(void)
{
    double worst = 0.0;
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t state = f32_state(&made);
        const double bound = f32_bound(&made).output;
        float input = made.model.input_min;
        reference_t reference = reference_new(&made.exact, START_NEGATIVE_SATURATION, (double)input);
        for (int i = 0; i < NUM_STEPS; ++i) {
            input = f32_random_input(&random, &made, input);
            const double output = (double)hyst_f32_step(&made.model, &state, input);
            const double error = fabs(output - reference_step(&reference, (double)input));
            TEST_ASSERT_TRUE(isfinite(output));
            TEST_ASSERT_TRUE_MESSAGE(error <= bound, "off by more than rounding");
            worst = fmax(worst, error / bound);
        }
        reference_free(&reference);
        f32_free(&made);
    }
    // An error of nothing at all would mean that the two were not computed apart.
    TEST_ASSERT_TRUE(worst > 0.0);
}

static void test_resets_follow_the_exact_model(void)
{
    static const start_t starts[] = {START_NEGATIVE_SATURATION, START_POSITIVE_SATURATION,
                                     START_DEMAGNETISED};
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(1000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t state = f32_state(&made);
        const f32_bound_t bound = f32_bound(&made);
        for (int start = 0; start < 3; ++start) {
            const float input = f32_random_input(&random, &made, made.model.input_min);
            const float output = hyst_f32_reset(&made.model, &state, (hyst_start_t)start, input);
            reference_t reference = reference_new(&made.exact, starts[start], (double)input);
            const double error = fabs((double)output - reference_output(&reference));
            TEST_ASSERT_TRUE(error <= bound.output + (start == 2 ? bound.demagnetise : 0.0));
            float snapshot[MOST_FLOATS];
            TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_save(&made.model, &state, snapshot, MOST_FLOATS));
            TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_restore(&made.model, &state, snapshot, MOST_FLOATS));
            TEST_ASSERT_EQUAL_HEX32(f32_bits(output), f32_bits(state.output));
            reference_free(&reference);
        }
        f32_free(&made);
    }
}

/// Extra samples on a monotone stretch change no bit: rounding is monotone, so the last push is the largest.
static void test_rate_independence_in_bits(void)
{
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(2000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t slow = f32_state(&made);
        hyst_f32_state_t fast = slow;
        fast.memory = xcalloc(made.model.num_plays, sizeof *fast.memory);
        memcpy(fast.memory, slow.memory, made.model.num_plays * sizeof *fast.memory);
        for (int i = 0; i < 50; ++i) {
            const float from = slow.input;
            const float to = f32_random_input(&random, &made, from);
            for (int k = 1; k < 8; ++k) {
                (void)hyst_f32_step(&made.model, &slow, from + (to - from) * 0.125F * (float)k);
            }
            (void)hyst_f32_step(&made.model, &slow, to);
            (void)hyst_f32_step(&made.model, &slow, to);
            (void)hyst_f32_step(&made.model, &fast, to);
            assert_same_state(&made.model, &slow, &fast);
        }
        free(fast.memory);
        f32_free(&made);
    }
}

/// A minor loop that is left beyond its first reversal leaves no trace in the memory.
static void test_wiping_out_in_bits(void)
{
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(3000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t looped = f32_state(&made);
        hyst_f32_state_t plain = looped;
        plain.memory = xcalloc(made.model.num_plays, sizeof *plain.memory);
        float ends[4];
        for (int k = 0; k < 4; ++k) {
            ends[k] = f32_random_input(&random, &made, made.model.input_min);
        }
        const float low = fminf(fminf(ends[0], ends[1]), fminf(ends[2], ends[3]));
        const float high = fmaxf(fmaxf(ends[0], ends[1]), fmaxf(ends[2], ends[3]));
        (void)hyst_f32_reset(&made.model, &looped, HYST_START_POSITIVE_SATURATION, low);
        for (int k = 0; k < 4; ++k) {
            (void)hyst_f32_step(&made.model, &looped, ends[k]);
        }
        (void)hyst_f32_step(&made.model, &looped, high);
        (void)hyst_f32_reset(&made.model, &plain, HYST_START_POSITIVE_SATURATION, low);
        (void)hyst_f32_step(&made.model, &plain, high);
        assert_same_state(&made.model, &looped, &plain);
        free(plain.memory);
        f32_free(&made);
    }
}

/// A run broken off, saved, restored into another state and carried on gives the bits of the run in one
/// piece.
static void test_split_run_in_bits(void)
{
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(4000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t whole = f32_state(&made);
        hyst_f32_state_t resumed = whole;
        resumed.memory = xcalloc(made.model.num_plays, sizeof *resumed.memory);
        float snapshot[MOST_FLOATS];
        for (int i = 0; i < 100; ++i) {
            const float input = f32_random_input(&random, &made, whole.input);
            (void)hyst_f32_step(&made.model, &whole, input);
            if (i == 0 || random_below(&random, 4) == 0) {
                TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_save(&made.model, &whole, snapshot, MOST_FLOATS));
                TEST_ASSERT_EQUAL(HYST_STATUS_OK,
                                  hyst_f32_restore(&made.model, &resumed, snapshot, MOST_FLOATS));
            } else {
                (void)hyst_f32_step(&made.model, &resumed, input);
            }
            assert_same_state(&made.model, &whole, &resumed);
        }
        free(resumed.memory);
        f32_free(&made);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_step_follows_the_exact_model);
    RUN_TEST(test_resets_follow_the_exact_model);
    RUN_TEST(test_rate_independence_in_bits);
    RUN_TEST(test_wiping_out_in_bits);
    RUN_TEST(test_split_run_in_bits);
    return UNITY_END();
}
