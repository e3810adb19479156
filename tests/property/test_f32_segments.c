#include "f32_model.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

enum { NUM_MODELS = 200, NUM_STEPS = 60, NUM_CANDIDATES = 24, NUM_NOISE = 200000 };

void setUp(void)
{
}

void tearDown(void)
{
}

static int compare(const void* a, const void* b)
{
    const float x = *(const float*)a;
    const float y = *(const float*)b;
    return (x > y) - (x < y);
}

static float output_after(const f32_model_t* made, const hyst_f32_state_t* state, hyst_f32_segment_t* scratch,
                          float input)
{
    hyst_f32_state_t copy = *state;
    memcpy(scratch, state->memory, made->model.num_plays * sizeof *scratch);
    copy.memory = scratch;
    return hyst_f32_step(&made->model, &copy, input);
}

/// Random inputs, half of them next to each other in float, where only rounding tells them apart.
static void draw_candidates(random_t* random, const f32_model_t* made, float last, float* candidate)
{
    for (int i = 0; i < NUM_CANDIDATES; i += 2) {
        candidate[i] = f32_random_input(random, made, last);
        candidate[i + 1] = fminf(nextafterf(candidate[i], INFINITY), made->model.input_max);
    }
    qsort(candidate, NUM_CANDIDATES, sizeof *candidate, compare);
}

/// From one state a larger next input never gives a smaller output, bit for bit.
static void test_output_is_monotone_in_the_next_input(void)
{
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(20000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t state = f32_state(&made);
        hyst_f32_segment_t* scratch = xcalloc(made.model.num_plays, sizeof *scratch);
        (void)hyst_f32_reset(&made.model, &state, (hyst_start_t)random_below(&random, 3), NAN);
        for (int i = 0; i < NUM_STEPS; ++i) {
            float candidate[NUM_CANDIDATES];
            draw_candidates(&random, &made, state.input, candidate);
            float former = -INFINITY;
            for (int k = 0; k < NUM_CANDIDATES; ++k) {
                const float output = output_after(&made, &state, scratch, candidate[k]);
                TEST_ASSERT_TRUE(output >= former);
                TEST_ASSERT_TRUE(candidate[k] > state.input || output <= state.output);
                TEST_ASSERT_TRUE(candidate[k] < state.input || output >= state.output);
                former = output;
            }
            (void)hyst_f32_step(&made.model, &state, candidate[random_below(&random, NUM_CANDIDATES)]);
        }
        free(scratch);
        f32_free(&made);
    }
}

/// Every play in just one segment, so that num_plays of them are enough; inner extremes within outer ones.
static void assert_nested(const f32_model_t* made, const hyst_f32_state_t* state)
{
    const hyst_f32_segment_t* segment = state->memory;
    TEST_ASSERT_TRUE(state->front < made->model.num_plays);
    TEST_ASSERT_EQUAL_UINT32(made->model.num_plays - 1, segment[0].last);
    for (uint32_t i = 1; i <= state->front; ++i) {
        TEST_ASSERT_TRUE(segment[i].last < segment[i - 1].last);
        if (segment[i].rising == segment[i - 1].rising) {
            TEST_ASSERT_TRUE(segment[i].level <= segment[i - 1].level);
        } else {
            const float apart = segment[i].level + segment[i - 1].level;
            TEST_ASSERT_TRUE(apart > made->play[segment[i].last].opening);
            TEST_ASSERT_TRUE(apart <= made->play[segment[i].last + 1].opening);
        }
    }
}

static void test_segments_nest(void)
{
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(30000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t state = f32_state(&made);
        for (int i = 0; i < 10 * NUM_STEPS; ++i) {
            (void)hyst_f32_step(&made.model, &state, f32_random_input(&random, &made, state.input));
            assert_nested(&made, &state);
        }
        f32_free(&made);
    }
}

/// However long the past was: once it is wiped out, what follows has the bits that it has without that past.
static void test_nothing_drifts(void)
{
    for (uint64_t seed = 0; seed < 8; ++seed) {
        random_t random = random_new(40000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t old = f32_state(&made);
        hyst_f32_state_t young = old;
        young.memory = xcalloc(made.model.num_plays, sizeof *young.memory);
        memcpy(young.memory, old.memory, made.model.num_plays * sizeof *young.memory);
        for (int i = 0; i < NUM_NOISE; ++i) {
            (void)hyst_f32_step(&made.model, &old, f32_random_input(&random, &made, old.input));
        }
        for (int i = 0; i < 3; ++i) {
            const float end = i == 1 ? made.model.input_min : made.model.input_max;
            (void)hyst_f32_step(&made.model, &old, end);
            (void)hyst_f32_step(&made.model, &young, end);
        }
        for (int i = 0; i < NUM_STEPS; ++i) {
            const float input = f32_random_input(&random, &made, old.input);
            TEST_ASSERT_EQUAL_HEX32(f32_bits(hyst_f32_step(&made.model, &young, input)),
                                    f32_bits(hyst_f32_step(&made.model, &old, input)));
        }
        free(young.memory);
        f32_free(&made);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_output_is_monotone_in_the_next_input);
    RUN_TEST(test_segments_nest);
    RUN_TEST(test_nothing_drifts);
    return UNITY_END();
}
