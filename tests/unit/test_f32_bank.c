#include "f32_model.h"
#include "hyst/hyst_f32_bank.h"
#include <string.h>
#include <unity.h>

enum { NUM_CHANNELS = 40, NUM_SAMPLES = 50 };

static f32_model_t made[NUM_CHANNELS];
static hyst_f32_state_t banked[NUM_CHANNELS];
static hyst_f32_state_t single[NUM_CHANNELS];
static f32_model_t twin[NUM_CHANNELS];

void setUp(void)
{
    random_t random = random_new(1);
    for (int i = 0; i < NUM_CHANNELS; ++i) {
        random_t same = random;
        made[i] = f32_random(&random);
        twin[i] = f32_random(&same);
        banked[i] = f32_state(&made[i]);
        single[i] = f32_state(&twin[i]);
    }
}

void tearDown(void)
{
    for (int i = 0; i < NUM_CHANNELS; ++i) {
        f32_free(&made[i]);
        f32_free(&twin[i]);
    }
}

static void assert_same_inverse(const hyst_f32_inverse_t* expected, const hyst_f32_inverse_t* actual)
{
    TEST_ASSERT_EQUAL_HEX32(f32_bits(expected->input), f32_bits(actual->input));
    TEST_ASSERT_EQUAL(expected->clamped, actual->clamped);
}

static void test_each_channel_is_a_single_step_with_its_own_model(void)
{
    const hyst_f32_model_t* models[NUM_CHANNELS];
    for (int i = 0; i < NUM_CHANNELS; ++i) {
        models[i] = &made[i].model;
    }
    random_t random = random_new(2);
    float inputs[NUM_CHANNELS];
    float outputs[NUM_CHANNELS];
    float wanted[NUM_CHANNELS];
    hyst_f32_inverse_t results[NUM_CHANNELS];
    for (int sample = 0; sample < NUM_SAMPLES; ++sample) {
        for (int i = 0; i < NUM_CHANNELS; ++i) {
            inputs[i] = f32_random_input(&random, &made[i], banked[i].input);
        }
        hyst_f32_bank_step(models, banked, inputs, outputs, NUM_CHANNELS);
        for (int i = 0; i < NUM_CHANNELS; ++i) {
            const float expected = hyst_f32_step(&twin[i].model, &single[i], inputs[i]);
            TEST_ASSERT_EQUAL_HEX32(f32_bits(expected), f32_bits(outputs[i]));
            wanted[i] = (float)random_uniform(&random, 0.5, 1.5) * expected;
        }
        hyst_f32_bank_inverse(models, banked, wanted, results, NUM_CHANNELS);
        for (int i = 0; i < NUM_CHANNELS; ++i) {
            const hyst_f32_inverse_t expected = hyst_f32_inverse(&twin[i].model, &single[i], wanted[i]);
            assert_same_inverse(&expected, &results[i]);
        }
    }
}

/// Every channel runs the first model, each with a memory and an input of its own, in place.
static void test_one_model_for_all_channels(void)
{
    const float radius[] = {0.0F, 0.5F, 1.0F};
    const float weight[] = {1.0F, 0.25F, 2.0F};
    random_t random = random_new(3);
    f32_model_t channel[2][NUM_CHANNELS];
    for (int i = 0; i < NUM_CHANNELS; ++i) {
        channel[0][i] = f32_classical(radius, weight, 3, 0.5F, -2.0F, 2.0F);
        channel[1][i] = f32_classical(radius, weight, 3, 0.5F, -2.0F, 2.0F);
        banked[i] = f32_state(&channel[0][i]);
        single[i] = f32_state(&channel[1][i]);
    }
    const hyst_f32_model_t* shared = &channel[0][0].model;
    hyst_f32_inverse_t results[NUM_CHANNELS];
    for (int sample = 0; sample < NUM_SAMPLES; ++sample) {
        float samples[NUM_CHANNELS];
        float outputs[NUM_CHANNELS];
        for (int i = 0; i < NUM_CHANNELS; ++i) {
            samples[i] = (float)random_uniform(&random, -2.5, 2.5);
            outputs[i] = hyst_f32_step(shared, &single[i], samples[i]);
        }
        hyst_f32_bank_step_shared(shared, banked, samples, samples, NUM_CHANNELS);
        hyst_f32_bank_inverse_shared(shared, banked, samples, results, NUM_CHANNELS);
        for (int i = 0; i < NUM_CHANNELS; ++i) {
            TEST_ASSERT_EQUAL_HEX32(f32_bits(outputs[i]), f32_bits(samples[i]));
            TEST_ASSERT_EQUAL_UINT32(single[i].clamped_inputs, banked[i].clamped_inputs);
            const hyst_f32_inverse_t expected = hyst_f32_inverse(shared, &single[i], samples[i]);
            assert_same_inverse(&expected, &results[i]);
        }
    }
    for (int i = 0; i < NUM_CHANNELS; ++i) {
        f32_free(&channel[0][i]);
        f32_free(&channel[1][i]);
    }
}

static void test_no_more_than_the_count_is_touched(void)
{
    const hyst_f32_model_t* model = &made[0].model;
    const float inputs[2] = {model->input_max, model->input_max};
    float outputs[2] = {99.0F, 99.0F};
    const hyst_f32_state_t before = banked[1];
    hyst_f32_bank_step(&model, banked, inputs, outputs, 0);
    TEST_ASSERT_TRUE(outputs[0] == 99.0F);
    hyst_f32_bank_step(&model, banked, inputs, outputs, 1);
    TEST_ASSERT_FALSE(outputs[0] == 99.0F);
    TEST_ASSERT_TRUE(outputs[1] == 99.0F);
    TEST_ASSERT_EQUAL_MEMORY(&before, &banked[1], sizeof before);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_channel_is_a_single_step_with_its_own_model);
    RUN_TEST(test_one_model_for_all_channels);
    RUN_TEST(test_no_more_than_the_count_is_touched);
    return UNITY_END();
}
