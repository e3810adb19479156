#include "captured.h"
#include "random.h"
#include "record.h"
#include "unity.h"
#include <string.h>

static record_t record;
static const record_options_t needs_input = {.needs_input = true};

void setUp(void)
{
    folder_new();
}

void tearDown(void)
{
    record_free(&record);
    record_free(&record);
    folder_remove();
}

static outcome_t read_text(const char* text, const record_options_t* options)
{
    folder_write("r.csv", text, strlen(text));
    record_free(&record);
    return record_read(folder_path("r.csv"), options, &record);
}

static void assert_refused(outcome_t expected, const char* text, const record_options_t* options,
                           const char* message)
{
    stderr_capture();
    const outcome_t outcome = read_text(text, options);
    const char* printed = stderr_captured();
    TEST_ASSERT_EQUAL_INT_MESSAGE(expected, outcome, text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(printed, message), printed);
    TEST_ASSERT_NULL(record.input);
    TEST_ASSERT_EQUAL_UINT(0, record.num_samples);
}

/// More samples than the arrays begin with, and values that 15 digits hold.
static void test_what_is_written_is_read_back(void)
{
    enum { NUM_SAMPLES = 5000 };
    static double time[NUM_SAMPLES];
    static double input[NUM_SAMPLES];
    static double load[NUM_SAMPLES];
    random_t random = random_new(3);
    for (size_t i = 0; i < NUM_SAMPLES; ++i) {
        time[i] = (double)i / 8.0;
        input[i] = floor(random_uniform(&random, -1e9, 1e9)) / 1e6;
        load[i] = (double)(i % 2);
    }
    const record_column_t columns[] = {
        {"time", time, false}, {"input", input, false}, {"load, [N] \"x\"", load, true}};
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, record_write(folder_path("w.csv"), columns, 3, NUM_SAMPLES));
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, record_read(folder_path("w.csv"), &needs_input, &record));
    TEST_ASSERT_EQUAL_UINT(NUM_SAMPLES, record.num_samples);
    TEST_ASSERT_EQUAL_MEMORY(time, record.time, sizeof time);
    TEST_ASSERT_EQUAL_MEMORY(input, record.input, sizeof input);
    TEST_ASSERT_NULL(record.output);
    TEST_ASSERT_EQUAL_UINT(1, record.num_auxiliary);
    TEST_ASSERT_EQUAL_STRING("load, [N] \"x\"", record.auxiliary[0].name);
    TEST_ASSERT_EQUAL_MEMORY(load, record.auxiliary[0].value, sizeof load);
}

static void test_record_without_time(void)
{
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, read_text("output,input\n1,2\n3,4\n", &needs_input));
    TEST_ASSERT_NULL(record.time);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, record.input[1]);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, record.output[1]);
}

static void test_sample_rate_makes_time(void)
{
    const record_options_t options = {.sample_rate = 4.0};
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, read_text("input\n1\n2\n3", &options));
    TEST_ASSERT_EQUAL_UINT(3, record.num_samples);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, record.time[2]);
    const record_options_t negative = {.sample_rate = -4.0};
    assert_refused(OUTCOME_USAGE, "input\n1\n2\n", &negative, "--sample-rate");
}

static void test_text_columns_are_left_out(void)
{
    stderr_capture();
    const outcome_t outcome = read_text("input,a,b,\n1,1,1,x\n2,2,,y\n3,z,3,\n", &needs_input);
    const char* printed = stderr_captured();
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, outcome);
    TEST_ASSERT_EQUAL_UINT(0, record.num_auxiliary);
    TEST_ASSERT_NOT_NULL(strstr(printed, ":3:5: note: column \"b\""));
    TEST_ASSERT_NOT_NULL(strstr(printed, ":4:3: note: column \"a\""));
}

static void test_places_of_faults(void)
{
    // Quoted cells before the bad one, which may hold commas.
    assert_refused(OUTCOME_BAD_INPUT, "note,input\n\"a,b\",1\n\"c,d\", x\n", &needs_input,
                   "r.csv:3:8: error: \"x\"");
    assert_refused(OUTCOME_BAD_INPUT, "\xEF\xBB\xBFtime\n0\n1\n", &needs_input,
                   "r.csv:1:4: error: no column \"input\"");
    assert_refused(OUTCOME_BAD_INPUT, "a\"b,input\n1,2\n", &needs_input, "quotation");
}

static void test_long_lines(void)
{
    static char text[200020];
    memset(text, '7', sizeof text);
    memcpy(text, "input\n", 6);
    text[sizeof text - 1] = '\0';
    assert_refused(OUTCOME_BAD_INPUT, text, &needs_input, "is too large for a number");
    for (size_t i = 7; i < sizeof text - 1; i += 2) {
        text[i] = ',';
    }
    assert_refused(OUTCOME_BAD_INPUT, text, &needs_input, "100007 cells, expected 1");
}

/// Random bytes are refused or read, never anything else.
static void test_noise(void)
{
    random_t random = random_new(4);
    static const char alphabet[] = "0123456789.,,,\n\n\n\"# \r\t-e\xEF\xBB\xBFinput";
    char text[400];
    for (int i = 0; i < 3000; ++i) {
        const size_t length = random_below(&random, sizeof text - 1);
        strcpy(text, "input,time\n");
        for (size_t k = i % 2 == 0 ? 11 : 0; k < length; ++k) {
            text[k] = alphabet[random_below(&random, sizeof alphabet)];
        }
        stderr_capture();
        folder_write("r.csv", text, length);
        record_free(&record);
        const outcome_t outcome = record_read(folder_path("r.csv"), &needs_input, &record);
        const bool spoke = strstr(stderr_captured(), "error: ") != NULL;
        TEST_ASSERT_TRUE(outcome == OUTCOME_OK ? record.num_samples >= 2 && !spoke
                                               : record.num_samples == 0 && spoke);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_written_is_read_back);
    RUN_TEST(test_record_without_time);
    RUN_TEST(test_sample_rate_makes_time);
    RUN_TEST(test_text_columns_are_left_out);
    RUN_TEST(test_places_of_faults);
    RUN_TEST(test_long_lines);
    RUN_TEST(test_noise);
    return UNITY_END();
}
