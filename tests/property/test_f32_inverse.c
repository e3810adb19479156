#include "f32_model.h"
#include "reference.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

enum { NUM_MODELS = 300, NUM_STEPS = 150 };

void setUp(void)
{
}

void tearDown(void)
{
}

static float random_wanted(random_t* random, const hyst_f32_reach_t* reach)
{
    const double low = (double)reach->reachable_min;
    const double high = (double)reach->reachable_max;
    if (random_below(random, 8) == 0) {
        return random_below(random, 2) == 0 ? reach->reachable_min : reach->reachable_max;
    }
    return fminf(fmaxf((float)random_uniform(random, low, high), reach->reachable_min), reach->reachable_max);
}

/// The bound is derived at f32_bound: 4 output roundings and those of the input times the output's slope.
static void test_round_trip(void)
{
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(5000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t state = f32_state(&made);
        const double bound = f32_bound(&made).round_trip;
        for (int i = 0; i < NUM_STEPS; ++i) {
            if (i % 3 == 0) {
                (void)hyst_f32_step(&made.model, &state, f32_random_input(&random, &made, state.input));
            }
            const hyst_f32_reach_t reach = hyst_f32_reachable(&made.model, &state);
            const float near = state.output + (reach.reachable_max - reach.reachable_min) * 1e-3F;
            const float wanted =
                i % 5 == 0 ? fminf(near, reach.reachable_max) : random_wanted(&random, &reach);
            const hyst_f32_inverse_t found = hyst_f32_inverse(&made.model, &state, wanted);
            TEST_ASSERT_FALSE(found.clamped);
            TEST_ASSERT_TRUE(found.input >= made.model.input_min && found.input <= made.model.input_max);
            const double output = (double)hyst_f32_step(&made.model, &state, found.input);
            TEST_ASSERT_TRUE_MESSAGE(fabs(output - (double)wanted) <= bound, "off by more than rounding");
        }
        f32_free(&made);
    }
}

static void test_looking_changes_nothing_and_reach_is_what_steps_reach(void)
{
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(6000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t state = f32_state(&made);
        const size_t size = made.model.num_plays * sizeof *state.memory;
        hyst_f32_segment_t* kept = xmalloc(size);
        for (int i = 0; i < 20; ++i) {
            (void)hyst_f32_step(&made.model, &state, f32_random_input(&random, &made, state.input));
            memcpy(kept, state.memory, size);
            const hyst_f32_state_t before = state;
            const float beyond = (float)random_uniform(&random, -1e6, 1e6);
            const hyst_f32_inverse_t found = hyst_f32_inverse(&made.model, &state, beyond);
            const hyst_f32_reach_t reach = hyst_f32_reachable(&made.model, &state);
            TEST_ASSERT_EQUAL_MEMORY(kept, state.memory, size);
            TEST_ASSERT_EQUAL_MEMORY(&before, &state, sizeof state);
            TEST_ASSERT_EQUAL(beyond < reach.reachable_min || beyond > reach.reachable_max, found.clamped);
            const float high = hyst_f32_step(&made.model, &state, made.model.input_max);
            TEST_ASSERT_EQUAL_HEX32(f32_bits(reach.reachable_max), f32_bits(high));
            state = before;
            memcpy(state.memory, kept, size);
            const float low = hyst_f32_step(&made.model, &state, made.model.input_min);
            TEST_ASSERT_EQUAL_HEX32(f32_bits(reach.reachable_min), f32_bits(low));
        }
        free(kept);
        f32_free(&made);
    }
}

/// Beyond reach, the answer is as near to the present input as the end of the reach allows, and gets there.
static void test_clamped_answers_reach_the_end(void)
{
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(7000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t state = f32_state(&made);
        const double bound = f32_bound(&made).round_trip;
        for (int i = 0; i < 20; ++i) {
            (void)hyst_f32_step(&made.model, &state, f32_random_input(&random, &made, state.input));
            const bool above = random_below(&random, 2) == 0;
            const hyst_f32_inverse_t found =
                hyst_f32_inverse(&made.model, &state, above ? INFINITY : -INFINITY);
            const hyst_f32_reach_t reach = hyst_f32_reachable(&made.model, &state);
            TEST_ASSERT_TRUE(found.clamped);
            TEST_ASSERT_TRUE(above ? found.input >= state.input : found.input <= state.input);
            const float output = hyst_f32_step(&made.model, &state, found.input);
            const float end = above ? reach.reachable_max : reach.reachable_min;
            TEST_ASSERT_TRUE(fabs((double)output - (double)end) <= bound);
        }
        f32_free(&made);
    }
}

/// Where the output is flat the nearest input is the answer: it is never farther from the present input than
/// the exact model's nearest one for an output that is further by twice the round trip's rounding, nor on the
/// other side.
static void test_answer_is_the_nearest(void)
{
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(8000 + seed);
        f32_model_t made = f32_random(&random);
        hyst_f32_state_t state = f32_state(&made);
        const double bound = 2.0 * f32_bound(&made).round_trip;
        for (int i = 0; i < 30; ++i) {
            (void)hyst_f32_step(&made.model, &state, f32_random_input(&random, &made, state.input));
            const hyst_f32_reach_t reach = hyst_f32_reachable(&made.model, &state);
            const float wanted = random_wanted(&random, &reach);
            const hyst_f32_inverse_t found = hyst_f32_inverse(&made.model, &state, wanted);
            reference_t exact = {.model = &made.exact,
                                 .memory = xcalloc(made.model.num_plays, sizeof(double)),
                                 .input = (double)state.input};
            f32_plays(&made, &state, exact.memory);
            const bool rising = wanted > state.output;
            const double further = (double)wanted + (rising ? bound : -bound);
            // The oracle's halving may end a last bit of double before a knot.
            const float limit = (float)reference_inverse(&exact, further).input;
            if (rising) {
                TEST_ASSERT_TRUE(found.input >= state.input && found.input <= limit);
            } else {
                TEST_ASSERT_TRUE(found.input <= state.input && found.input >= limit);
            }
            reference_free(&exact);
        }
        f32_free(&made);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_round_trip);
    RUN_TEST(test_looking_changes_nothing_and_reach_is_what_steps_reach);
    RUN_TEST(test_clamped_answers_reach_the_end);
    RUN_TEST(test_answer_is_the_nearest);
    return UNITY_END();
}
