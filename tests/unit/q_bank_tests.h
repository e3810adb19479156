#include "q_scalar.h"
#if HYST_Q_BITS == 32
#include "hyst/hyst_q31_bank.h"
#else
#include "hyst/hyst_q15_bank.h"
#endif
#include "random_model.h"
#include <unity.h>

enum { NUM_CHANNELS = 3, NUM_SHARING = 40, MOST_PLAYS = 64, NUM_SAMPLES = 50 };

static q_model_t single[NUM_CHANNELS];
static q_model_t banked[NUM_CHANNELS];

void setUp(void)
{
    random_t random = random_new(1);
    for (int i = 0; i < NUM_CHANNELS; ++i) {
        model_t model = random_model(&random);
        const double table_error = q_random_table_error(&random, &model);
        single[i] = q_new(&model, BITS, table_error);
        banked[i] = q_new(&model, BITS, table_error);
        model_free(&model);
    }
}

void tearDown(void)
{
    for (int i = 0; i < NUM_CHANNELS; ++i) {
        q_free(&single[i]);
        q_free(&banked[i]);
    }
}

static value_t some_value(random_t* random)
{
    return (value_t)random_uniform(random, (double)VALUE_MIN, (double)VALUE_MAX);
}

static void assert_same_inverse(SCALAR(inverse_t) expected, SCALAR(inverse_t) actual)
{
    TEST_ASSERT_EQUAL_INT32(expected.input, actual.input);
    TEST_ASSERT_EQUAL(expected.clamped, actual.clamped);
}

static void test_each_channel_is_a_single_step_with_its_own_model(void)
{
    const SCALAR(model_t) * models[NUM_CHANNELS];
    SCALAR(state_t) states[NUM_CHANNELS];
    for (int i = 0; i < NUM_CHANNELS; ++i) {
        models[i] = &OWNED(&banked[i]).model;
        states[i] = STATE(&banked[i]);
    }
    random_t random = random_new(2);
    for (int sample = 0; sample < NUM_SAMPLES; ++sample) {
        value_t inputs[NUM_CHANNELS];
        value_t outputs[NUM_CHANNELS];
        value_t wanted[NUM_CHANNELS];
        SCALAR(inverse_t) results[NUM_CHANNELS];
        for (int i = 0; i < NUM_CHANNELS; ++i) {
            inputs[i] = (value_t)q_random_input(&random, &single[i], states[i].input);
            wanted[i] = some_value(&random);
        }
        SCALAR(bank_step)(models, states, inputs, outputs, NUM_CHANNELS);
        SCALAR(bank_inverse)(models, states, wanted, results, NUM_CHANNELS);
        for (int i = 0; i < NUM_CHANNELS; ++i) {
            const SCALAR(model_t)* model = &OWNED(&single[i]).model;
            TEST_ASSERT_EQUAL_INT32(SCALAR(step)(model, &STATE(&single[i]), inputs[i]), outputs[i]);
            assert_same_inverse(SCALAR(inverse)(model, &STATE(&single[i]), wanted[i]), results[i]);
        }
    }
}

/// Every channel runs the first model, each with a memory and an input of its own, in place.
static void test_one_model_for_all_channels(void)
{
    static SCALAR(segment_t) memory[2][NUM_SHARING][MOST_PLAYS];
    SCALAR(state_t) states[2][NUM_SHARING];
    const SCALAR(model_t)* shared = &OWNED(&single[0]).model;
    for (int i = 0; i < NUM_SHARING; ++i) {
        for (int k = 0; k < 2; ++k) {
            TEST_ASSERT_EQUAL(HYST_STATUS_OK, SCALAR(init)(shared, &states[k][i], memory[k][i], MOST_PLAYS));
        }
    }
    random_t random = random_new(3);
    for (int sample = 0; sample < NUM_SAMPLES; ++sample) {
        value_t samples[NUM_SHARING];
        value_t outputs[NUM_SHARING];
        SCALAR(inverse_t) results[NUM_SHARING];
        for (int i = 0; i < NUM_SHARING; ++i) {
            samples[i] = some_value(&random);
            outputs[i] = SCALAR(step)(shared, &states[0][i], samples[i]);
        }
        SCALAR(bank_step_shared)(shared, states[1], samples, samples, NUM_SHARING);
        SCALAR(bank_inverse_shared)(shared, states[1], samples, results, NUM_SHARING);
        for (int i = 0; i < NUM_SHARING; ++i) {
            TEST_ASSERT_EQUAL_INT32(outputs[i], samples[i]);
            TEST_ASSERT_EQUAL_UINT32(states[0][i].clamped_inputs, states[1][i].clamped_inputs);
            assert_same_inverse(SCALAR(inverse)(shared, &states[0][i], samples[i]), results[i]);
        }
    }
}

static void test_no_more_than_the_count_is_touched(void)
{
    const SCALAR(model_t)* model = &OWNED(&banked[0]).model;
    SCALAR(state_t) states[2] = {STATE(&banked[0]), STATE(&banked[1])};
    const SCALAR(state_t) before = states[1];
    const value_t inputs[2] = {model->input_max, model->input_max};
    const value_t untouched = states[0].output;
    value_t outputs[2] = {untouched, untouched};
    SCALAR(bank_step)(&model, states, inputs, outputs, 0);
    TEST_ASSERT_EQUAL_INT32(untouched, outputs[0]);
    SCALAR(bank_step)(&model, states, inputs, outputs, 1);
    TEST_ASSERT_TRUE(untouched != outputs[0]);
    TEST_ASSERT_EQUAL_INT32(untouched, outputs[1]);
    TEST_ASSERT_EQUAL_MEMORY(&before, &states[1], sizeof before);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_channel_is_a_single_step_with_its_own_model);
    RUN_TEST(test_one_model_for_all_channels);
    RUN_TEST(test_no_more_than_the_count_is_touched);
    return UNITY_END();
}
