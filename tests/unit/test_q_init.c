#include "q_model.h"
#include "random_model.h"
#include "unity.h"
#include <stdlib.h>
#include <string.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static const quantized_bits_t both[] = {QUANTIZED_Q15, QUANTIZED_Q31};

/// Two plays between tanh envelopes: a table with many knots, both envelopes in order by a wide margin.
static model_t film(void)
{
    model_t model = model_new("film");
    model.input_min = 30.0;
    model.input_max = 90.0;
    model.ascending = curve_tanh(0.16, -10.26);
    model.descending = curve_tanh(0.201, -11.58);
    model.nonhysteretic = curve_linear(0.02, 1.0);
    model_set_num_plays(&model, 2);
    model.radius[0] = 0.25;
    model.radius[1] = 0.5;
    model.weight[0] = 1.0;
    model.weight[1] = 2.0;
    return model;
}

static q_model_t film_in(quantized_bits_t bits)
{
    model_t model = film();
    q_model_t q = q_new(&model, bits, 0.01);
    model_free(&model);
    return q;
}

/// What init says once the wide model has been changed and, for q15, narrowed again.
static hyst_status_t init_changed(q_model_t* q)
{
    if (q->quantized.bits == QUANTIZED_Q15) {
        narrowed_free(&q->narrowed);
        q->narrowed = narrowed_new(&q->quantized);
    }
    return q_init(q, q->quantized.model.num_plays);
}

typedef void change_t(quantized_t* quantized);

static void other_format(quantized_t* quantized)
{
    ++quantized->model.format;
}

static void empty_range(quantized_t* quantized)
{
    quantized->model.input_max = quantized->model.input_min;
}

static void falling_radius(quantized_t* quantized)
{
    quantized->radius[1] = quantized->radius[0] - 1;
}

static void wide_radius(quantized_t* quantized)
{
    quantized->radius[1] = quantized->knot[quantized->model.num_knots - 1].ascending + 1;
    const uint64_t weight = quantized->cumulative_weight[2] - quantized->cumulative_weight[1];
    quantized->cumulative_moment[2] = quantized->cumulative_moment[1] + weight * quantized->radius[1];
}

static void falling_weight(quantized_t* quantized)
{
    quantized->cumulative_weight[1] = quantized->cumulative_weight[2] + 1;
}

static void weight_before_the_first(quantized_t* quantized)
{
    quantized->cumulative_moment[1] ^= 1U;
}

static void knot_out_of_order(quantized_t* quantized)
{
    quantized->knot[1].input = quantized->knot[0].input;
}

static void knot_inside_the_range(quantized_t* quantized)
{
    ++quantized->knot[0].input;
}

static void small_shift(quantized_t* quantized)
{
    --quantized->knot[1].shift;
}

static void large_shift(quantized_t* quantized)
{
    ++quantized->knot[1].shift;
}

static void falling_envelope(quantized_t* quantized)
{
    quantized->knot[2].ascending = quantized->knot[1].ascending - 1;
}

static void short_slope(quantized_t* quantized)
{
    quantized->knot[1].descending_slope -= 4;
}

static void long_slope(quantized_t* quantized)
{
    quantized->knot[1].descending_slope += 8;
}

static void nonhysteretic_begins_above_0(quantized_t* quantized)
{
    ++quantized->knot[0].nonhysteretic;
}

static void nonhysteretic_slope(quantized_t* quantized)
{
    quantized->knot[1].nonhysteretic_slope += 8;
}

static void crossing_envelopes(quantized_t* quantized)
{
    quantized->radius[0] = 0;
    quantized->cumulative_moment[1] = 0;
    const uint64_t weight = quantized->cumulative_weight[2] - quantized->cumulative_weight[1];
    quantized->cumulative_moment[2] = weight * quantized->radius[1];
    // Above the descending envelope at the hot end, where it lies below by itself at the cold one.
    for (uint32_t k = 0; k < quantized->model.num_knots; ++k) {
        hyst_q31_knot_t* knot = &quantized->knot[k];
        const uint32_t descending = knot->descending;
        const uint32_t slope = knot->descending_slope;
        knot->descending = knot->ascending;
        knot->descending_slope = knot->ascending_slope;
        knot->ascending = descending;
        knot->ascending_slope = slope;
    }
}

static void output_above(quantized_t* quantized)
{
    quantized->model.constant += (int64_t)1 << ((int)quantized->bits - 1);
}

static void output_below(quantized_t* quantized)
{
    quantized->model.constant -= (int64_t)1 << ((int)quantized->bits - 1);
}

static void every_fault_has_its_status(void)
{
    static const struct {
        change_t* change;
        hyst_status_t status;
    } faults[] = {
        {other_format, HYST_STATUS_MODEL_FORMAT},
        {empty_range, HYST_STATUS_INPUT_RANGE},
        {falling_radius, HYST_STATUS_RADIUS},
        {wide_radius, HYST_STATUS_RADIUS},
        {falling_weight, HYST_STATUS_WEIGHT},
        {weight_before_the_first, HYST_STATUS_WEIGHT},
        {knot_out_of_order, HYST_STATUS_KNOTS},
        {knot_inside_the_range, HYST_STATUS_KNOTS},
        {small_shift, HYST_STATUS_KNOTS},
        {large_shift, HYST_STATUS_KNOTS},
        {falling_envelope, HYST_STATUS_ENVELOPE},
        {short_slope, HYST_STATUS_ENVELOPE},
        {long_slope, HYST_STATUS_ENVELOPE},
        {nonhysteretic_begins_above_0, HYST_STATUS_NONHYSTERETIC},
        {nonhysteretic_slope, HYST_STATUS_NONHYSTERETIC},
        {crossing_envelopes, HYST_STATUS_ENVELOPE_ORDER},
        {output_above, HYST_STATUS_OUTPUT_RANGE},
        {output_below, HYST_STATUS_OUTPUT_RANGE},
    };
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; ++i) {
        for (size_t type = 0; type < 2; ++type) {
            char message[40];
            snprintf(message, sizeof message, "fault %zu, q%d", i, (int)both[type] - 1);
            q_model_t q = film_in(both[type]);
            faults[i].change(&q.quantized);
            TEST_ASSERT_EQUAL_INT_MESSAGE(faults[i].status, init_changed(&q), message);
            q_free(&q);
        }
    }
}

static void arguments_are_checked(void)
{
    for (size_t type = 0; type < 2; ++type) {
        q_model_t q = film_in(both[type]);
        uint32_t snapshot[3];
        TEST_ASSERT_EQUAL_INT(HYST_STATUS_MEMORY_LENGTH, q_init(&q, 1));
        TEST_ASSERT_EQUAL_INT(HYST_STATUS_MEMORY_LENGTH, q_save(&q, snapshot, 2));
        TEST_ASSERT_EQUAL_INT(HYST_STATUS_OK, q_save(&q, snapshot, 3));
        TEST_ASSERT_EQUAL_INT(HYST_STATUS_MEMORY_LENGTH, q_restore(&q, snapshot, 2));
        q_free(&q);
    }
    q_model_t q = film_in(QUANTIZED_Q31);
    hyst_q31_segment_t memory[2];
    hyst_q31_state_t state;
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_NULL_POINTER, hyst_q31_init(NULL, &state, memory, 2));
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_NULL_POINTER, hyst_q31_init(&q.quantized.model, NULL, memory, 2));
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_NULL_POINTER, hyst_q31_init(&q.quantized.model, &state, NULL, 2));
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_NULL_POINTER, hyst_q31_save(&q.quantized.model, &q.state31, NULL, 3));
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_NULL_POINTER,
                          hyst_q31_restore(&q.quantized.model, &q.state31, NULL, 3));
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_NULL_POINTER, hyst_q31_self_test(&q.quantized.model, &q.state31, NULL));
    q.quantized.model.radius = NULL;
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_NULL_POINTER, hyst_q31_init(&q.quantized.model, &state, memory, 2));
    q.quantized.model.num_plays = 0;
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_PLAY_COUNT, hyst_q31_init(&q.quantized.model, &state, memory, 2));
    q_free(&q);
}

/// The integers' own ends, and every input beside the range's: clamped, counted, as the range's end.
static void beyond_the_range_is_clamped_and_counted(void)
{
    for (size_t type = 0; type < 2; ++type) {
        q_model_t q = film_in(both[type]);
        const int32_t low = q.quantized.model.input_min;
        const int32_t high = q.quantized.model.input_max;
        const int32_t top = q_step(&q, high);
        TEST_ASSERT_EQUAL_UINT32(0, q_clamped_inputs(&q));
        q_reset(&q, HYST_START_NEGATIVE_SATURATION, low);
        TEST_ASSERT_EQUAL_INT32(top, q_step(&q, q_value_max(&q)));
        TEST_ASSERT_EQUAL_INT32(high, q_present_input(&q));
        TEST_ASSERT_EQUAL_INT32(top, q_step(&q, high + 1));
        const int32_t bottom = q_step(&q, low);
        TEST_ASSERT_EQUAL_INT32(bottom, q_step(&q, q_value_min(&q)));
        TEST_ASSERT_EQUAL_INT32(bottom, q_step(&q, low - 1));
        TEST_ASSERT_EQUAL_UINT32(4, q_clamped_inputs(&q));
        TEST_ASSERT_TRUE(q_inverse(&q, q_value_min(&q)).clamped);
        TEST_ASSERT_EQUAL_INT32(low, q_inverse(&q, q_value_min(&q)).input);
        TEST_ASSERT_TRUE(q_inverse(&q, q_value_max(&q)).clamped);
        // The film is flat at the hot end: the first input that gives the largest output.
        TEST_ASSERT_EQUAL_INT32(top, q_step(&q, q_inverse(&q, q_value_max(&q)).input));
        q_free(&q);
    }
}

/// One unit beyond what the model can be in, in every way there is, is refused and changes nothing.
static void an_impossible_snapshot_is_refused(void)
{
    for (size_t type = 0; type < 2; ++type) {
        q_model_t q = film_in(both[type]);
        uint32_t good[3];
        q_step(&q, 0);
        TEST_ASSERT_EQUAL_INT(HYST_STATUS_OK, q_save(&q, good, 3));
        const hyst_q31_model_t* model = &q.quantized.model;
        const uint32_t bottom = q.quantized.knot[0].descending;
        const uint32_t positive = q.quantized.knot[model->num_knots - 1].ascending - q.quantized.radius[1];
        const uint32_t bad[][3] = {
            {(uint32_t)model->input_max - (uint32_t)model->input_min + 1, good[1], good[2]},
            {0, bottom + q.quantized.radius[0] + 1, bottom + q.quantized.radius[1]},
            {0, bottom + q.quantized.radius[0], bottom + q.quantized.radius[1] + 1},
            {good[0], good[1], good[1] + q.quantized.radius[1] - q.quantized.radius[0] + 1},
            {(uint32_t)model->input_max - (uint32_t)model->input_min, positive, positive + 1},
        };
        for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
            uint32_t after[3];
            TEST_ASSERT_EQUAL_INT(HYST_STATUS_SNAPSHOT, q_restore(&q, bad[i], 3));
            TEST_ASSERT_EQUAL_INT(HYST_STATUS_OK, q_save(&q, after, 3));
            TEST_ASSERT_EQUAL_UINT32_ARRAY(good, after, 3);
        }
        TEST_ASSERT_EQUAL_INT(HYST_STATUS_OK, q_restore(&q, good, 3));
        q_free(&q);
    }
}

static void self_test_finds_one_wrong_unit(void)
{
    q_model_t q = film_in(QUANTIZED_Q15);
    const int16_t input[3] = {0, 20000, -5000};
    const int16_t wanted[3] = {0, -3000, 30000};
    int16_t output[3];
    int16_t inverse[3];
    for (size_t i = 0; i < 3; ++i) {
        output[i] = hyst_q15_step(&q.narrowed.model, &q.state15, input[i]);
        inverse[i] = hyst_q15_inverse(&q.narrowed.model, &q.state15, wanted[i]).input;
    }
    const hyst_q15_golden_t golden = {3, input, output, wanted, inverse};
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_OK, hyst_q15_self_test(&q.narrowed.model, &q.state15, &golden));
    TEST_ASSERT_EQUAL_INT32(q.quantized.model.input_min, q_present_input(&q));
    ++output[1];
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_SELF_TEST, hyst_q15_self_test(&q.narrowed.model, &q.state15, &golden));
    --output[1];
    --inverse[2];
    TEST_ASSERT_EQUAL_INT(HYST_STATUS_SELF_TEST, hyst_q15_self_test(&q.narrowed.model, &q.state15, &golden));
    q_free(&q);
}

/// Radius 0, equal radii, weights of 0, plays that cannot move, an output that only D moves.
static void odd_models_are_taken(void)
{
    for (size_t type = 0; type < 2; ++type) {
        model_t model = model_new("odd");
        model.nonhysteretic = curve_linear(1.0, 0.0);
        model_set_num_plays(&model, 4);
        model.radius[2] = 0.25;
        model.radius[3] = 7.0;
        model.weight[1] = model.weight[3] = 1.0;
        q_model_t q = q_new(&model, both[type], 0.01);
        for (int32_t i = 0; i < 100; ++i) {
            const int32_t v = (i % 7 - 3) * (q.quantized.model.input_max / 3);
            TEST_ASSERT_EQUAL_INT32(q_reference_step(&q, v), q_step(&q, v));
        }
        q_free(&q);
        model.weight[1] = model.weight[3] = 0.0;
        q = q_new(&model, both[type], 0.01);
        TEST_ASSERT_EQUAL_INT32(q_reference_step(&q, 1000), q_step(&q, 1000));
        q_free(&q);
        model_free(&model);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_fault_has_its_status);
    RUN_TEST(arguments_are_checked);
    RUN_TEST(beyond_the_range_is_clamped_and_counted);
    RUN_TEST(an_impossible_snapshot_is_refused);
    RUN_TEST(self_test_finds_one_wrong_unit);
    RUN_TEST(odd_models_are_taken);
    return UNITY_END();
}
