#include "number.h"
#include "random.h"
#include "unity.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static number_status_t parse(const char* text, double* value)
{
    return number_parse(text, strlen(text), value);
}

static void assert_formatted(const char* expected, double value)
{
    char text[NUMBER_SIZE];
    TEST_ASSERT_EQUAL_UINT(strlen(expected), number_format(value, text));
    TEST_ASSERT_EQUAL_STRING(expected, text);
}

static void test_parse_agrees_with_strtod(void)
{
    static const char* const texts[] = {"0",
                                        "-0",
                                        "+1",
                                        "1.",
                                        ".5",
                                        "-.5e3",
                                        "0.1",
                                        "123456789012345",
                                        "1e22",
                                        "1e-5",
                                        "1E+05",
                                        "4.9e-324",
                                        "1e-400",
                                        "0.000000000000001",
                                        "-12345.678901234567890123",
                                        "00012.500",
                                        "9007199254740993"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        double value;
        TEST_ASSERT_EQUAL_INT_MESSAGE(NUMBER_OK, parse(texts[i], &value), texts[i]);
        const double expected = strtod(texts[i], NULL);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&expected, &value, sizeof value, texts[i]);
    }
}

static void test_parse_refuses(void)
{
    static const char* const texts[] = {"",   "-",  ".",   "e5",    "1e",  "1e+", "0x10",
                                        "1 ", " 1", "1,5", "1.2.3", "--1", "abc", "1f"};
    double value;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        TEST_ASSERT_EQUAL_INT_MESSAGE(NUMBER_NOT_A_NUMBER, parse(texts[i], &value), texts[i]);
    }
    TEST_ASSERT_EQUAL_INT(NUMBER_NOT_FINITE, parse("NaN", &value));
    TEST_ASSERT_EQUAL_INT(NUMBER_NOT_FINITE, parse("-inf", &value));
    TEST_ASSERT_EQUAL_INT(NUMBER_NOT_FINITE, parse("+Infinity", &value));
    TEST_ASSERT_EQUAL_INT(NUMBER_OVERFLOW, parse("-1e309", &value));
    TEST_ASSERT_EQUAL_INT(NUMBER_NOT_A_NUMBER, number_parse("1\0002", 3, &value));
}

static void test_format(void)
{
    assert_formatted("0", 0.0);
    assert_formatted("0", -0.0);
    assert_formatted("1", 1.0);
    assert_formatted("-0.1", -0.1);
    assert_formatted("0.0001", 1e-4);
    assert_formatted("1e-05", 1e-5);
    assert_formatted("0.333333333333333", 1.0 / 3.0);
    assert_formatted("10", 9.99999999999999999);
    assert_formatted("1e+15", 1e15);
    assert_formatted("999999999999999", 999999999999999.0);
    assert_formatted("1.79769313486232e+308", 1.7976931348623157e308);
}

/// 15 decimal digits always survive the way through a double.
static void test_decimals_come_out_as_they_went_in(void)
{
    random_t random = random_new(1);
    for (int i = 0; i < 200000; ++i) {
        const int num_digits = 1 + (int)random_below(&random, 15);
        const double digits = floor(random_uniform(&random, 1.0, pow(10.0, num_digits)));
        char written[64];
        (void)snprintf(written, sizeof written, "%s%.0fe%d", i % 2 == 0 ? "-" : "", digits,
                       (int)random_below(&random, 24) - 18);
        double value;
        double again;
        char text[NUMBER_SIZE];
        TEST_ASSERT_EQUAL_INT_MESSAGE(NUMBER_OK, parse(written, &value), written);
        number_format(value, text);
        TEST_ASSERT_EQUAL_INT_MESSAGE(NUMBER_OK, parse(text, &again), written);
        TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&value, &again, sizeof value, written);
    }
}

/// Any double comes back within half a unit of the 15th digit, 5e-15 relative at most, plus half an ulp.
static void test_doubles_come_back_to_15_digits(void)
{
    random_t random = random_new(2);
    for (int i = 0; i < 200000; ++i) {
        const double value = random_normal(&random) * pow(10.0, random_uniform(&random, -8.0, 18.0));
        char text[NUMBER_SIZE];
        double again;
        const size_t length = number_format(value, text);
        TEST_ASSERT_EQUAL_INT_MESSAGE(NUMBER_OK, number_parse(text, length, &again), text);
        TEST_ASSERT_TRUE_MESSAGE(fabs(again - value) <= 5.2e-15 * fabs(value), text);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_parse_agrees_with_strtod);
    RUN_TEST(test_parse_refuses);
    RUN_TEST(test_format);
    RUN_TEST(test_decimals_come_out_as_they_went_in);
    RUN_TEST(test_doubles_come_back_to_15_digits);
    return UNITY_END();
}
