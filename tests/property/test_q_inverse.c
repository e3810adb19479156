#include "q_model.h"
#include "random_model.h"
#include "unity.h"
#include <stdlib.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static model_t some_model(random_t* random)
{
    return random_below(random, 4) == 0 ? random_classical_model(random) : random_model(random);
}

/// Moves the model a few random steps on.
static void wander(random_t* random, q_model_t* q)
{
    int32_t input = q_present_input(q);
    for (size_t i = 0; i < 12; ++i) {
        input = q_random_input(random, q, input);
        TEST_ASSERT_EQUAL_INT32(q_reference_step(q, input), q_step(q, input));
    }
}

static int64_t distance(int64_t a, int64_t b)
{
    return a < b ? b - a : a - b;
}

/// Whether answering with input `a` (output y_a) is better than with `b`, as hyst_q31.h ranks them.
static bool is_better(int64_t wanted, int64_t present, int64_t present_output, int64_t a, int64_t y_a,
                      int64_t b, int64_t y_b)
{
    if (distance(y_a, wanted) != distance(y_b, wanted)) {
        return distance(y_a, wanted) < distance(y_b, wanted);
    }
    if (y_a != y_b) {
        return distance(y_a, present_output) < distance(y_b, present_output);
    }
    return distance(a, present) < distance(b, present);
}

/// The best of all inputs, by trying every one of them.
static int32_t best_of(const hyst_q31_model_t* model, const int32_t* outputs, int64_t wanted, int64_t present)
{
    const int64_t present_output = outputs[present - model->input_min];
    int64_t best = present;
    for (int64_t v = model->input_min; v <= model->input_max; ++v) {
        if (is_better(wanted, present, present_output, v, outputs[v - model->input_min], best,
                      outputs[best - model->input_min])) {
            best = v;
        }
    }
    return (int32_t)best;
}

static int32_t some_wanted(random_t* random, const q_model_t* q, q_reach_t reachable)
{
    const int64_t width = (int64_t)reachable.reachable_max - reachable.reachable_min;
    int64_t wanted =
        reachable.reachable_min - width / 10 + (int64_t)random_below(random, (size_t)(width + width / 5 + 4));
    wanted = wanted > q_value_max(q) ? q_value_max(q) : wanted;
    return (int32_t)(wanted < q_value_min(q) ? q_value_min(q) : wanted);
}

static bool is_out_of_reach(q_reach_t reach, int32_t wanted)
{
    return wanted < reach.reachable_min || wanted > reach.reachable_max;
}

static void equals_exhaustive_search(void)
{
    random_t random = random_new(1);
    for (int i = 0; i < 16; ++i) {
        model_t model = some_model(&random);
        q_model_t q = q_new(&model, QUANTIZED_Q15, q_random_table_error(&random, &model));
        const hyst_q31_model_t* range = &q.quantized.model;
        const size_t num_inputs = (size_t)(range->input_max - range->input_min + 1);
        int32_t* outputs = xcalloc(num_inputs, sizeof *outputs);
        wander(&random, &q);
        for (size_t k = 0; k < num_inputs; ++k) {
            outputs[k] = q_reference_look(&q, range->input_min + (int32_t)k);
            TEST_ASSERT_TRUE_MESSAGE(k == 0 || outputs[k] >= outputs[k - 1], "monotone");
        }
        const q_reach_t reach = q_reachable(&q);
        TEST_ASSERT_EQUAL_INT32(outputs[0], reach.reachable_min);
        TEST_ASSERT_EQUAL_INT32(outputs[num_inputs - 1], reach.reachable_max);
        for (size_t k = 0; k < 60; ++k) {
            const int32_t wanted = some_wanted(&random, &q, reach);
            const q_inverse_t found = q_inverse(&q, wanted);
            TEST_ASSERT_EQUAL_INT32(best_of(range, outputs, wanted, q_present_input(&q)), found.input);
            TEST_ASSERT_EQUAL(is_out_of_reach(reach, wanted), found.clamped);
        }
        free(outputs);
        q_free(&q);
        model_free(&model);
    }
}

/// The least distance from the present input, towards an end of the range, whose output reaches `wanted`; the
/// output at the end does.
static int64_t first_reaching(const q_model_t* q, int32_t wanted, int direction)
{
    const int64_t present = q_present_input(q);
    const int64_t end = direction > 0 ? q->quantized.model.input_max : q->quantized.model.input_min;
    int64_t low = 0;
    int64_t high = distance(end, present);
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        const int32_t output = q_reference_look(q, (int32_t)(present + direction * middle));
        if (direction > 0 ? output >= wanted : output <= wanted) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

/// The best answer by plain halving of the integer reference, which increases with the input.
static int32_t best_by_halving(const q_model_t* q, int32_t wanted)
{
    const int32_t present_output = q_reference_look(q, q_present_input(q));
    const int32_t low = q_reference_look(q, q->quantized.model.input_min);
    const int32_t high = q_reference_look(q, q->quantized.model.input_max);
    const int32_t goal = wanted < low ? low : wanted > high ? high : wanted;
    const int direction = goal > present_output ? 1 : -1;
    const int64_t reached = first_reaching(q, goal, direction);
    if (reached == 0) {
        return q_present_input(q);
    }
    const int32_t beyond = q_reference_look(q, (int32_t)(q_present_input(q) + direction * reached));
    const int32_t before = q_reference_look(q, (int32_t)(q_present_input(q) + direction * (reached - 1)));
    const bool is_before = distance(goal, before) <= distance(beyond, goal);
    return (int32_t)(q_present_input(q) +
                     direction * (is_before ? first_reaching(q, before, direction) : reached));
}

static void equals_halving(void)
{
    random_t random = random_new(2);
    for (int i = 0; i < 300; ++i) {
        model_t model = some_model(&random);
        q_model_t q =
            q_new(&model, i % 2 == 0 ? QUANTIZED_Q31 : QUANTIZED_Q15, q_random_table_error(&random, &model));
        for (size_t k = 0; k < 40; ++k) {
            if (k % 4 == 0) {
                wander(&random, &q);
            }
            const q_inverse_t here = q_inverse(&q, q_reference_look(&q, q_present_input(&q)));
            TEST_ASSERT_EQUAL_INT32(q_present_input(&q), here.input);
            const int32_t wanted = some_wanted(&random, &q, q_reachable(&q));
            const q_inverse_t found = q_inverse(&q, wanted);
            TEST_ASSERT_EQUAL_INT32(best_by_halving(&q, wanted), found.input);
            TEST_ASSERT_EQUAL(is_out_of_reach(q_reachable(&q), wanted), found.clamped);
        }
        q_free(&q);
        model_free(&model);
    }
}

/// Where an output of the model is asked for, the answer gives exactly that.
static void returns_to_an_output_it_can_give(void)
{
    random_t random = random_new(3);
    for (int i = 0; i < 100; ++i) {
        model_t model = some_model(&random);
        q_model_t q =
            q_new(&model, i % 2 == 0 ? QUANTIZED_Q31 : QUANTIZED_Q15, q_random_table_error(&random, &model));
        for (size_t k = 0; k < 40; ++k) {
            wander(&random, &q);
            const int32_t wanted = q_reference_look(&q, q_random_input(&random, &q, q_present_input(&q)));
            const int32_t input = q_inverse(&q, wanted).input;
            TEST_ASSERT_EQUAL_INT32(wanted, q_step(&q, input));
            TEST_ASSERT_EQUAL_INT32(wanted, q_reference_step(&q, input));
        }
        q_free(&q);
        model_free(&model);
    }
}

static uint32_t word_max(const q_model_t* q)
{
    return UINT32_MAX >> (32U - (unsigned)q->quantized.bits);
}

/// The slope of a straight curve over a cell of this (shifted) width, as quantize rounds it.
static uint32_t slope_of(const q_model_t* q, uint32_t low, uint32_t high, uint32_t width)
{
    return (uint32_t)((((uint64_t)(high - low) << (unsigned)q->quantized.bits) + width - 1) / width);
}

/// Makes one cell from knot `low` to knot `high`.
static void join(const q_model_t* q, hyst_q31_knot_t* low, const hyst_q31_knot_t* high)
{
    uint32_t width = (uint32_t)high->input - (uint32_t)low->input;
    low->shift = 0;
    while (width <= word_max(q) / 2) {
        width *= 2;
        ++low->shift;
    }
    low->ascending_slope = slope_of(q, low->ascending, high->ascending, width);
    low->descending_slope = slope_of(q, low->descending, high->descending, width);
    low->nonhysteretic_slope = slope_of(q, low->nonhysteretic, high->nonhysteretic, width);
}

static bool may_join(const q_model_t* q, const hyst_q31_knot_t* low, const hyst_q31_knot_t* high)
{
    const uint32_t most = word_max(q) / 2 - 4;
    return high->ascending - low->ascending <= most && high->descending - low->descending <= most &&
           high->nonhysteretic - low->nonhysteretic <= most;
}

/// Joins the cells of a classical model, whose curves are straight, to the fewest whose slopes fit in a word.
static void join_cells(q_model_t* q)
{
    hyst_q31_model_t* model = &q->quantized.model;
    hyst_q31_knot_t* knot = q->quantized.knot;
    const hyst_q31_knot_t last = knot[model->num_knots - 1];
    uint32_t kept = 0;
    for (uint32_t k = 1; k < model->num_knots; ++k) {
        const hyst_q31_knot_t next = k + 1 < model->num_knots ? knot[k + 1] : last;
        if (k + 1 == model->num_knots || !may_join(q, &knot[kept], &next)) {
            join(q, &knot[kept], &knot[k]);
            knot[++kept] = knot[k];
        }
    }
    model->num_knots = kept + 1;
    if (q->quantized.bits == QUANTIZED_Q15) {
        narrowed_free(&q->narrowed);
        q->narrowed = narrowed_new(&q->quantized);
    }
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, q_init(q, model->num_plays));
    q_reference_start(q, HYST_START_NEGATIVE_SATURATION);
}

/// In a large cell a line rises by more than the inverse's arithmetic on lines holds.
static void holds_in_large_cells(void)
{
    random_t random = random_new(4);
    size_t num_joined = 0;
    for (int i = 0; i < 100; ++i) {
        model_t model = random_classical_model(&random);
        q_model_t q = q_new(&model, i % 2 == 0 ? QUANTIZED_Q31 : QUANTIZED_Q15, 1e-3);
        const uint32_t num_knots = q.quantized.model.num_knots;
        join_cells(&q);
        num_joined += num_knots - q.quantized.model.num_knots;
        for (size_t k = 0; k < 40; ++k) {
            if (k % 4 == 0) {
                wander(&random, &q);
            }
            const int32_t wanted = some_wanted(&random, &q, q_reachable(&q));
            TEST_ASSERT_EQUAL_INT32(best_by_halving(&q, wanted), q_inverse(&q, wanted).input);
        }
        q_free(&q);
        model_free(&model);
    }
    TEST_ASSERT_TRUE(num_joined > 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(equals_exhaustive_search);
    RUN_TEST(equals_halving);
    RUN_TEST(returns_to_an_output_it_can_give);
    RUN_TEST(holds_in_large_cells);
    return UNITY_END();
}
