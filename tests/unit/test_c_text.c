#include "c_text.h"
#include "model_crc.h"
#include "random.h"
#include "unity.h"
#include <float.h>
#include <stdlib.h>
#include <string.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_float(const char* expected, float value)
{
    char text[C_NUMBER_SIZE];
    c_float(value, text);
    TEST_ASSERT_EQUAL_STRING(expected, text);
}

static void floats_are_literals(void)
{
    assert_float("0.0f", 0.0f);
    assert_float("-0.0f", -0.0f);
    assert_float("90.0f", 90.0f);
    assert_float("0.100000001f", 0.1f);
    assert_float("1.0e+10f", 1e10f);
    assert_float("-1.25e-07f", -1.25e-7f);
    assert_float("1.40129846e-45f", FLT_TRUE_MIN);
    assert_float("3.40282347e+38f", FLT_MAX);
}

static void floats_read_back_to_the_same_bits(void)
{
    random_t random = random_new(21);
    for (int i = 0; i < 100000; ++i) {
        const uint32_t bits = (uint32_t)random_bits(&random);
        float value;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value)) {
            continue;
        }
        char text[C_NUMBER_SIZE];
        c_float(value, text);
        char* end;
        const float read = strtof(text, &end);
        TEST_ASSERT_EQUAL_STRING("f", end);
        TEST_ASSERT_EQUAL_MEMORY(&value, &read, sizeof value);
    }
}

static void assert_written(void (*write)(FILE*, const char*), const char* text, const char* expected)
{
    char* written = NULL;
    size_t length = 0;
    FILE* stream = open_memstream(&written, &length);
    write(stream, text);
    fclose(stream);
    TEST_ASSERT_EQUAL_STRING(expected, written);
    free(written);
}

static void strings_cannot_break_out(void)
{
    assert_written(c_string, "plain", "\"plain\"");
    assert_written(c_string, "a\"b\\c", "\"a\\\"b\\\\c\"");
    assert_written(c_string, "\n\t\x7f", "\"\\012\\011\\177\"");
    assert_written(c_string, "\xC2\xB5m1", "\"\\302\\265m1\"");
    assert_written(c_string,
                   "?"
                   "?/",
                   "\"\\?\\?/\"");
}

static void comments_cannot_end_early(void)
{
    assert_written(c_comment, "a */ b", "a * / b");
    assert_written(c_comment, "/* */", "/ * * /");
    assert_written(c_comment, "*/*", "* / *");
    assert_written(c_comment,
                   "?"
                   "?/ \\",
                   "? ?/ .");
    assert_written(c_comment, "\xC2\xB5m \xCE\xA9\n", "\xC2\xB5m \xCE\xA9.");
    // Right-to-left override, and a sequence cut short.
    assert_written(c_comment, "\xE2\x80\xAE \xC2", "... .");
}

static void assert_symbol(const char* text, const char* expected)
{
    char* symbol = c_symbol_from(text);
    TEST_ASSERT_EQUAL_STRING(expected, symbol);
    TEST_ASSERT_TRUE(c_symbol_is_valid(symbol));
    free(symbol);
}

static void any_name_gives_a_symbol(void)
{
    assert_symbol("vo2_film", "vo2_film");
    assert_symbol("2nd stage", "model_2nd_stage");
    assert_symbol("", "model_");
    assert_symbol("_Reserved", "model__Reserved");
    assert_symbol("hyst_f32", "model_hyst_f32");
    assert_symbol("a-\xC2\xB5", "a_");
}

static void only_identifiers_are_symbols(void)
{
    TEST_ASSERT_TRUE(c_symbol_is_valid("A9_z"));
    TEST_ASSERT_FALSE(c_symbol_is_valid(""));
    TEST_ASSERT_FALSE(c_symbol_is_valid("9a"));
    TEST_ASSERT_FALSE(c_symbol_is_valid("a b"));
    TEST_ASSERT_FALSE(c_symbol_is_valid("a;b"));
    TEST_ASSERT_FALSE(c_symbol_is_valid("HYST_x"));
}

/// The check value of CRC-32/ISO-HDLC.
static void crc_of_the_check_string(void)
{
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926, crc32_update(0, "123456789", 9));
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926, crc32_update(crc32_update(0, "1234", 4), "56789", 5));
}

static void crc_sees_every_part(void)
{
    model_t model = model_new("m");
    model_set_num_plays(&model, 1);
    const uint32_t before = model_crc(&model);
    model.radius[0] = 1.0;
    const uint32_t radius = model_crc(&model);
    TEST_ASSERT_TRUE(before != radius);
    model.nonhysteretic.offset = 1.0;
    TEST_ASSERT_TRUE(radius != model_crc(&model));
    model_free(&model);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(floats_are_literals);
    RUN_TEST(floats_read_back_to_the_same_bits);
    RUN_TEST(strings_cannot_break_out);
    RUN_TEST(comments_cannot_end_early);
    RUN_TEST(any_name_gives_a_symbol);
    RUN_TEST(only_identifiers_are_symbols);
    RUN_TEST(crc_of_the_check_string);
    RUN_TEST(crc_sees_every_part);
    return UNITY_END();
}
