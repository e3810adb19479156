#include "f32_model.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

/// Models at the edges of float: whatever init takes stays finite, in range and in order.

enum { NUM_MODELS = 4000, MOST = 6, MOST_FLOATS = HYST_F32_SNAPSHOT_LENGTH(MOST) };

void setUp(void)
{
}

void tearDown(void)
{
}

/// From subnormal to near the largest float.
static float wild(random_t* random)
{
    switch (random_below(random, 6)) {
    case 0:
        return 0.0F;
    case 1:
        return f32_from_bits((uint32_t)(random_bits(random) & 0x7FFFFFFFU));
    default:
        return (float)pow(10.0, random_uniform(random, -44.0, 38.5));
    }
}

static float wild_signed(random_t* random)
{
    return random_below(random, 2) == 0 ? wild(random) : -wild(random);
}

static int compare(const void* a, const void* b)
{
    const float x = *(const float*)a;
    const float y = *(const float*)b;
    return (x > y) - (x < y);
}

static void sorted(random_t* random, float* values, size_t count, float (*draw)(random_t* random))
{
    for (size_t i = 0; i < count; ++i) {
        do {
            values[i] = draw(random);
        } while (!isfinite(values[i]));
    }
    qsort(values, count, sizeof *values, compare);
}

static f32_model_t wild_model(random_t* random)
{
    float radius[MOST];
    float weight[MOST];
    float column[4][MOST];
    const size_t num_plays = 1 + random_below(random, MOST);
    const size_t num_knots = 2 + random_below(random, MOST - 1);
    sorted(random, radius, num_plays, wild);
    for (size_t j = 0; j < num_plays; ++j) {
        weight[j] = wild(random);
    }
    for (int c = 0; c < 4; ++c) {
        sorted(random, column[c], num_knots, wild_signed);
    }
    if (random_below(random, 4) == 0) {
        return f32_classical(radius, weight, num_plays, wild(random), column[0][0], column[0][num_knots - 1]);
    }
    hyst_f32_knot_t knot[MOST];
    for (size_t k = 0; k < num_knots; ++k) {
        // Equal envelopes are in order for every radius.
        knot[k] = (hyst_f32_knot_t){.input = column[0][k],
                                    .ascending = column[1][k],
                                    .descending = random_below(random, 2) == 0 ? column[1][k] : column[2][k],
                                    .nonhysteretic = column[3][k]};
    }
    return f32_tabulated(radius, weight, num_plays, knot, num_knots, wild_signed(random));
}

/// Steps and answers of a model that init took; a larger input never gives a smaller output on the way up.
static void exercise(random_t* random, const f32_model_t* made, hyst_f32_state_t* state)
{
    for (int i = 0; i < 40; ++i) {
        const float former_input = state->input;
        const float former_output = state->output;
        const float input = random_below(random, 4) == 0 ? f32_from_bits((uint32_t)random_bits(random))
                                                         : f32_random_input(random, made, state->input);
        const float output = hyst_f32_step(&made->model, state, input);
        TEST_ASSERT_TRUE(isfinite(output));
        TEST_ASSERT_TRUE(state->input <= former_input || output >= former_output);
        TEST_ASSERT_TRUE(state->input >= former_input || output <= former_output);
        const hyst_f32_inverse_t found =
            hyst_f32_inverse(&made->model, state, f32_from_bits((uint32_t)random_bits(random)));
        const hyst_f32_reach_t reach = hyst_f32_reachable(&made->model, state);
        TEST_ASSERT_TRUE(reach.reachable_min <= output && output <= reach.reachable_max);
        TEST_ASSERT_TRUE(found.input >= made->model.input_min && found.input <= made->model.input_max);
        const float wanted = 0.5F * reach.reachable_min + 0.5F * reach.reachable_max;
        const float answer = hyst_f32_inverse(&made->model, state, wanted).input;
        TEST_ASSERT_TRUE(answer >= made->model.input_min && answer <= made->model.input_max);
        TEST_ASSERT_TRUE(wanted <= output || answer >= state->input);
        TEST_ASSERT_TRUE(wanted >= output || answer <= state->input);
        float snapshot[MOST_FLOATS];
        TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_save(&made->model, state, snapshot, MOST_FLOATS));
        TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_restore(&made->model, state, snapshot, MOST_FLOATS));
        TEST_ASSERT_EQUAL_HEX32(f32_bits(output), f32_bits(state->output));
    }
}

static void test_what_init_takes_stays_finite(void)
{
    int num_taken = 0;
    for (uint64_t seed = 0; seed < NUM_MODELS; ++seed) {
        random_t random = random_new(9000 + seed);
        f32_model_t made = wild_model(&random);
        hyst_f32_state_t state;
        if (hyst_f32_init(&made.model, &state, made.memory, made.model.num_plays) == HYST_STATUS_OK) {
            ++num_taken;
            exercise(&random, &made, &state);
            for (int start = 0; start < 3; ++start) {
                TEST_ASSERT_TRUE(isfinite(hyst_f32_reset(&made.model, &state, (hyst_start_t)start, NAN)));
                exercise(&random, &made, &state);
            }
        }
        f32_free(&made);
    }
    // Enough of them must get past init for this to mean something.
    TEST_ASSERT_TRUE(num_taken > NUM_MODELS / 20);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_init_takes_stays_finite);
    return UNITY_END();
}
