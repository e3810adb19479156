#include "f32_model.h"
#include <float.h>
#include <math.h>
#include <string.h>
#include <unity.h>

/// A sound tabulated model, and the arrays that a test spoils one entry of.
static hyst_f32_play_t play[3];
static hyst_f32_knot_t knot[3];
static hyst_f32_model_t model;
static hyst_f32_state_t state;
static hyst_f32_segment_t memory[3];

void setUp(void)
{
    // Radii 0, 0.5, 0.5 and weights 1, 0, 2.
    memcpy(play, (const hyst_f32_play_t[]){{0.0F, 0.0F, 1.0F}, {1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 3.0F}},
           sizeof play);
    memcpy(knot,
           (const hyst_f32_knot_t[]){{0.0F, -1.0F, 1.0F, 0.0F, 1.0F, 2.0F, 0.0F},
                                     {1.0F, 0.0F, 2.0F, 1.0F, 2.0F, 2.0F, 1.0F},
                                     {2.0F, 2.0F, 0.0F, 3.0F, 0.0F, 3.0F, 0.0F}},
           sizeof knot);
    model = (hyst_f32_model_t){.format = HYST_MODEL_FORMAT,
                               .num_plays = 3,
                               .num_knots = 3,
                               .input_min = 0.0F,
                               .input_max = 2.0F,
                               .constant = 0.25F,
                               .moment = 1.0F,
                               .play = play,
                               .knot = knot};
    memset(&state, 0x5A, sizeof state);
    memset(memory, 0x5A, sizeof memory);
}

void tearDown(void)
{
}

/// Refused for this reason, and nothing written.
static void assert_refused(hyst_status_t expected)
{
    hyst_f32_state_t untouched;
    hyst_f32_segment_t untouched_memory[3];
    memset(&untouched, 0x5A, sizeof untouched);
    memset(untouched_memory, 0x5A, sizeof untouched_memory);
    TEST_ASSERT_EQUAL(expected, hyst_f32_init(&model, &state, memory, 3));
    TEST_ASSERT_EQUAL_MEMORY(&untouched, &state, sizeof state);
    TEST_ASSERT_EQUAL_MEMORY(untouched_memory, memory, sizeof memory);
}

/// Refused with `bad` in *place, and sound again afterwards.
static void assert_refuses(float* place, float bad, hyst_status_t expected)
{
    const float good = *place;
    *place = bad;
    assert_refused(expected);
    *place = good;
}

static void test_starts_at_negative_saturation(void)
{
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_init(&model, &state, memory, 3));
    TEST_ASSERT_EQUAL_UINT32(0, state.front);
    TEST_ASSERT_TRUE(memory[0].level == -0.0F && memory[0].last == 2 && memory[0].rising == 0);
    TEST_ASSERT_TRUE(state.input == 0.0F && state.output == 0.25F + 2.0F + 1.0F);
    TEST_ASSERT_EQUAL_UINT32(0, state.cell);
    TEST_ASSERT_EQUAL_UINT32(0, state.invalid_inputs);
    TEST_ASSERT_EQUAL_UINT32(0, state.clamped_inputs);
}

static void test_null_pointers(void)
{
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_init(NULL, &state, memory, 3));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_init(&model, NULL, memory, 3));
    TEST_ASSERT_EQUAL(HYST_STATUS_NULL_POINTER, hyst_f32_init(&model, &state, NULL, 3));
    model.play = NULL;
    assert_refused(HYST_STATUS_NULL_POINTER);
    model.play = play;
    model.knot = NULL;
    assert_refused(HYST_STATUS_NULL_POINTER);
}

static void test_layout(void)
{
    model.format = HYST_MODEL_FORMAT + 1;
    assert_refused(HYST_STATUS_MODEL_FORMAT);
    model.format = HYST_MODEL_FORMAT;
    model.num_plays = 0;
    assert_refused(HYST_STATUS_PLAY_COUNT);
    model.num_plays = HYST_MAX_PLAYS + 1;
    assert_refused(HYST_STATUS_PLAY_COUNT);
    model.num_plays = 3;
    TEST_ASSERT_EQUAL(HYST_STATUS_MEMORY_LENGTH, hyst_f32_init(&model, &state, memory, 2));
}

static void test_input_range(void)
{
    assert_refuses(&model.input_min, NAN, HYST_STATUS_INPUT_RANGE);
    assert_refuses(&model.input_min, 2.0F, HYST_STATUS_INPUT_RANGE);
    assert_refuses(&model.input_max, INFINITY, HYST_STATUS_INPUT_RANGE);
    model.input_min = -FLT_MAX;
    assert_refuses(&model.input_max, FLT_MAX, HYST_STATUS_INPUT_RANGE);
}

static void test_plays(void)
{
    assert_refuses(&play[0].opening, -FLT_MIN, HYST_STATUS_RADIUS);
    assert_refuses(&play[1].opening, NAN, HYST_STATUS_RADIUS);
    assert_refuses(&play[2].opening, INFINITY, HYST_STATUS_RADIUS);
    assert_refuses(&play[2].opening, 0.5F, HYST_STATUS_RADIUS);
    assert_refuses(&play[0].slope, -1.0F, HYST_STATUS_WEIGHT);
    assert_refuses(&play[1].slope, NAN, HYST_STATUS_WEIGHT);
    assert_refuses(&play[1].slope, 0.75F, HYST_STATUS_WEIGHT);
    assert_refuses(&play[2].slope, INFINITY, HYST_STATUS_WEIGHT);
}

/// The loading curve and the moment follow from radii and weights, to within a few roundings.
static void test_sums_of_plays(void)
{
    assert_refuses(&play[0].loading, FLT_MIN, HYST_STATUS_LOADING);
    assert_refuses(&play[0].loading, NAN, HYST_STATUS_LOADING);
    assert_refuses(&play[1].loading, nextafterf(1.0F, 0.0F), HYST_STATUS_LOADING);
    assert_refuses(&play[1].loading, 1.0F + 8.0F * FLT_EPSILON, HYST_STATUS_LOADING);
    assert_refuses(&play[2].loading, INFINITY, HYST_STATUS_LOADING);
    assert_refuses(&model.moment, 1.0F + 40.0F * FLT_EPSILON, HYST_STATUS_LOADING);
    assert_refuses(&model.moment, 0.0F, HYST_STATUS_LOADING);
    assert_refuses(&model.moment, NAN, HYST_STATUS_LOADING);
    play[1].loading = 1.0F + 2.0F * FLT_EPSILON;
    play[2].loading = play[1].loading;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_init(&model, &state, memory, 3));
}

static void test_knots(void)
{
    assert_refuses(&knot[1].input, 0.0F, HYST_STATUS_KNOTS);
    assert_refuses(&knot[1].input, NAN, HYST_STATUS_KNOTS);
    assert_refuses(&knot[0].input, -1.0F, HYST_STATUS_KNOTS);
    assert_refuses(&knot[2].input, 2.5F, HYST_STATUS_KNOTS);
    model.num_knots = 1;
    assert_refused(HYST_STATUS_KNOTS);
    model.num_knots = HYST_MAX_KNOTS + 1;
    assert_refused(HYST_STATUS_KNOTS);
}

static void test_curves(void)
{
    assert_refuses(&knot[1].nonhysteretic, 1.5F, HYST_STATUS_NONHYSTERETIC);
    assert_refuses(&knot[0].nonhysteretic_slope, NAN, HYST_STATUS_NONHYSTERETIC);
    assert_refuses(&knot[1].nonhysteretic_slope, 1.001F, HYST_STATUS_NONHYSTERETIC);
    assert_refuses(&knot[1].ascending, -1.5F, HYST_STATUS_ENVELOPE);
    assert_refuses(&knot[2].ascending, INFINITY, HYST_STATUS_ENVELOPE);
    assert_refuses(&knot[0].ascending_slope, 0.999F, HYST_STATUS_ENVELOPE);
    assert_refuses(&knot[0].descending, 1.5F, HYST_STATUS_ENVELOPE);
    assert_refuses(&knot[1].descending_slope, -2.0F, HYST_STATUS_ENVELOPE);
    assert_refuses(&knot[2].descending, NAN, HYST_STATUS_ENVELOPE);
}

static void test_an_envelope_may_be_flat_somewhere_but_not_everywhere(void)
{
    knot[1].ascending = -1.0F;
    knot[0].ascending_slope = 0.0F;
    knot[1].ascending_slope = 3.0F;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_init(&model, &state, memory, 3));
    setUp();
    knot[2].ascending = -1.0F;
    knot[1].ascending = -1.0F;
    knot[0].ascending_slope = 0.0F;
    knot[1].ascending_slope = 0.0F;
    assert_refused(HYST_STATUS_ENVELOPE);
}

/// A slope that underflows is off by half the least subnormal, times the width far more than FLT_EPSILON of
/// the rise.
static void test_slopes_that_underflow(void)
{
    const hyst_f32_knot_t tiny[] = {
        {.input = 0.0F},
        {.input = 60.0F, .ascending = 1.0F, .descending = 1.0F, .nonhysteretic = 1e-43F},
    };
    const float radius[] = {0.0F, 0.5F, 0.5F};
    const float weight[] = {1.0F, 0.0F, 2.0F};
    f32_model_t made = f32_tabulated(radius, weight, 3, tiny, 2, 0.0F);
    TEST_ASSERT_TRUE(fabsf(made.knot[0].nonhysteretic_slope * 60.0F - 1e-43F) > 1e-44F);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_init(&made.model, &state, memory, 3));
    f32_free(&made);
}

static void test_envelope_order(void)
{
    for (int k = 0; k < 3; ++k) {
        knot[k].ascending += 1.5F;
    }
    assert_refused(HYST_STATUS_ENVELOPE_ORDER);
    // A least radius of a quarter closes the gap of 0.5, exactly.
    play[0].opening = 0.5F;
    play[1].loading = 0.5F;
    play[2].loading = 0.5F;
    model.moment = 1.25F;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_init(&model, &state, memory, 3));
}

static void test_output_range(void)
{
    assert_refuses(&model.constant, NAN, HYST_STATUS_OUTPUT_RANGE);
    assert_refuses(&model.constant, FLT_MAX, HYST_STATUS_OUTPUT_RANGE);
    assert_refuses(&play[2].slope, FLT_MAX, HYST_STATUS_LOADING);
    // One weight of the largest float at radius 0: its loading curve is sound, its output is not.
    for (int j = 0; j < 3; ++j) {
        play[j] = (hyst_f32_play_t){0.0F, 0.0F, FLT_MAX};
    }
    model.moment = 0.0F;
    assert_refused(HYST_STATUS_OUTPUT_RANGE);
    // Radii beyond what float can push, though without weight.
    for (int j = 0; j < 3; ++j) {
        play[j] = (hyst_f32_play_t){FLT_MAX, 0.0F, 0.0F};
    }
    assert_refused(HYST_STATUS_OUTPUT_RANGE);
}

static void test_classical(void)
{
    model.num_knots = 0;
    model.knot = NULL;
    assert_refuses(&model.nonhysteretic_slope, -1.0F, HYST_STATUS_NONHYSTERETIC);
    assert_refuses(&model.nonhysteretic_slope, NAN, HYST_STATUS_NONHYSTERETIC);
    assert_refuses(&model.nonhysteretic_slope, FLT_MAX, HYST_STATUS_OUTPUT_RANGE);
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_init(&model, &state, memory, 3));
}

static void test_every_status_has_its_own_text(void)
{
    for (int a = HYST_STATUS_OK; a <= HYST_STATUS_LOADING; ++a) {
        TEST_ASSERT_NOT_EQUAL(0, strcmp("unknown status", hyst_status_text((hyst_status_t)a)));
        for (int b = HYST_STATUS_OK; b < a; ++b) {
            TEST_ASSERT_NOT_EQUAL(
                0, strcmp(hyst_status_text((hyst_status_t)a), hyst_status_text((hyst_status_t)b)));
        }
    }
    TEST_ASSERT_EQUAL_STRING("unknown status", hyst_status_text((hyst_status_t)(HYST_STATUS_LOADING + 1)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_starts_at_negative_saturation);
    RUN_TEST(test_null_pointers);
    RUN_TEST(test_layout);
    RUN_TEST(test_input_range);
    RUN_TEST(test_plays);
    RUN_TEST(test_sums_of_plays);
    RUN_TEST(test_knots);
    RUN_TEST(test_curves);
    RUN_TEST(test_an_envelope_may_be_flat_somewhere_but_not_everywhere);
    RUN_TEST(test_slopes_that_underflow);
    RUN_TEST(test_envelope_order);
    RUN_TEST(test_output_range);
    RUN_TEST(test_classical);
    RUN_TEST(test_every_status_has_its_own_text);
    return UNITY_END();
}
