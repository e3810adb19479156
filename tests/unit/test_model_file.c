#include "captured.h"
#include "model_file.h"
#include "random_model.h"
#include "unity.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static model_t model;

void setUp(void)
{
    folder_new();
}

void tearDown(void)
{
    model_free(&model);
    folder_remove();
}

static void assert_curve_close(const curve_t* expected, const curve_t* actual)
{
    TEST_ASSERT_EQUAL_INT(expected->type, actual->type);
    TEST_ASSERT_EQUAL_UINT(expected->num_knots, actual->num_knots);
    const double wanted[] = {expected->slope, expected->shift, expected->gain, expected->offset};
    const double got[] = {actual->slope, actual->shift, actual->gain, actual->offset};
    for (size_t i = 0; i < 4 && expected->type != CURVE_TABLE; ++i) {
        // Half a unit of the 15th digit.
        TEST_ASSERT_TRUE(fabs(wanted[i] - got[i]) <= 5.2e-15 * fabs(wanted[i]));
    }
    for (size_t i = 0; i < expected->num_knots; ++i) {
        TEST_ASSERT_TRUE(fabs(expected->x[i] - actual->x[i]) <= 5.2e-15 * fabs(expected->x[i]));
        TEST_ASSERT_TRUE(fabs(expected->y[i] - actual->y[i]) <= 5.2e-15 * fabs(expected->y[i]));
    }
}

/// What is read back is the model to 15 digits, and written again it gives the same bytes.
static void test_round_trip(void)
{
    random_t random = random_new(5);
    for (int i = 0; i < 100; ++i) {
        model_t original = random_model(&random);
        TEST_ASSERT_EQUAL_INT(OUTCOME_OK, model_write(folder_path("a.json"), &original));
        TEST_ASSERT_EQUAL_INT(OUTCOME_OK, model_read(folder_path("a.json"), &model));
        assert_curve_close(&original.ascending, &model.ascending);
        assert_curve_close(&original.descending, &model.descending);
        assert_curve_close(&original.nonhysteretic, &model.nonhysteretic);
        TEST_ASSERT_EQUAL_UINT(original.num_plays, model.num_plays);
        for (size_t j = 0; j < model.num_plays; ++j) {
            TEST_ASSERT_TRUE(fabs(original.radius[j] - model.radius[j]) <= 5.2e-15 * original.radius[j]);
            TEST_ASSERT_TRUE(fabs(original.weight[j] - model.weight[j]) <= 5.2e-15 * original.weight[j]);
        }
        TEST_ASSERT_EQUAL_INT(OUTCOME_OK, model_write(folder_path("b.json"), &model));
        char* first = xstrdup(folder_read("a.json"));
        TEST_ASSERT_EQUAL_STRING(first, folder_read("b.json"));
        free(first);
        model_free(&original);
        model_free(&model);
    }
}

static const char whole[] =
    "{\"format\": \"hyst-model\",\n \"version\": 1,\n \"name\": \"n \\\"\xc3\xa4\",\n"
    " \"input\": {\"unit\": \"V\", \"min\": 0.0, \"max\": 1.0},\n \"output\": {\"unit\": \"um\"},\n"
    " \"ascending\": {\"type\": \"linear\", \"slope\": 1.0, \"shift\": 0.0, \"gain\": 1.0, \"offset\": "
    "0.0},\n"
    " \"descending\": {\"type\": \"linear\", \"slope\": 1.0, \"shift\": 0.0, \"gain\": 1.0, \"offset\": "
    "0.0},\n"
    " \"nonhysteretic\": {\"type\": \"table\", \"x\": [0.0, 1.0], \"y\": [0.0, 0.5]},\n"
    " \"radii\": [0.1, 0.2],\n \"weights\": [2.0, 0.0],\n \"initial\": [0.1, 0.2],\n"
    " \"effects\": [{\"type\": \"exogenous\", \"column\": \"load\", \"gain\": 0.1}],\n"
    " \"identification\": {\"rmse\": 0.1}}\n";

static void test_everything_is_carried_along(void)
{
    folder_write("a.json", whole, sizeof whole - 1);
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, model_read(folder_path("a.json"), &model));
    TEST_ASSERT_EQUAL_STRING("um", model.output_unit);
    TEST_ASSERT_EQUAL_DOUBLE(0.2, model.initial[1]);
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, model_write(folder_path("b.json"), &model));
    TEST_ASSERT_EQUAL_STRING(whole, folder_read("b.json"));
}

static void test_defaults(void)
{
    static const char text[] =
        "{\"format\":\"hyst-model\",\"version\":1,\"input\":{\"min\":0,\"max\":1},\"extra\":7,"
        "\"ascending\":{\"type\":\"linear\",\"slope\":1,\"shift\":0},"
        "\"descending\":{\"type\":\"linear\",\"slope\":1,\"shift\":0},"
        "\"nonhysteretic\":{\"type\":\"tanh\",\"slope\":0,\"shift\":0},"
        "\"radii\":[0],\"weights\":[1]}";
    folder_write("a.json", text, sizeof text - 1);
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, model_read(folder_path("a.json"), &model));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, model.ascending.gain);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, model.ascending.offset);
    TEST_ASSERT_EQUAL_STRING("", model.input_unit);
    TEST_ASSERT_NULL(model.initial);
    TEST_ASSERT_NULL(model.effects);
}

/// Cut short anywhere, or with any byte changed, the text is refused with a message or read: never anything
/// else.
static void test_damaged_text(void)
{
    random_t random = random_new(6);
    for (size_t i = 0; i < 3000; ++i) {
        char text[sizeof whole];
        memcpy(text, whole, sizeof whole);
        size_t length = sizeof whole - 1;
        if (i < sizeof whole - 1) {
            length = i;
        } else {
            text[random_below(&random, length)] = (char)random_below(&random, 256);
        }
        folder_write("a.json", text, length);
        stderr_capture();
        const outcome_t outcome = model_read(folder_path("a.json"), &model);
        const bool spoke = strstr(stderr_captured(), "error: ") != NULL;
        TEST_ASSERT_TRUE(outcome == OUTCOME_OK ? !spoke && model.num_plays == 2
                                               : spoke && model.radius == NULL);
        model_free(&model);
    }
}

static void test_invalid_model_is_not_written(void)
{
    folder_write("a.json", "old", 3);
    model = model_new("no plays");
    stderr_capture();
    const outcome_t outcome = model_write(folder_path("a.json"), &model);
    TEST_ASSERT_NOT_NULL(strstr(stderr_captured(), "error: the resulting model is not valid: radii"));
    TEST_ASSERT_EQUAL_INT(OUTCOME_NUMERICAL, outcome);
    TEST_ASSERT_EQUAL_STRING("old", folder_read("a.json"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_round_trip);
    RUN_TEST(test_everything_is_carried_along);
    RUN_TEST(test_defaults);
    RUN_TEST(test_damaged_text);
    RUN_TEST(test_invalid_model_is_not_written);
    return UNITY_END();
}
