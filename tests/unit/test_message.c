#include "captured.h"
#include "message.h"
#include "unity.h"
#include <string.h>

void setUp(void)
{
    stderr_capture();
}

void tearDown(void)
{
    message_set_quiet(false);
}

static void test_error_with_place(void)
{
    const location_t place = {.file = "a.csv", .line = 3, .column = 14};
    const outcome_t outcome = message_error(OUTCOME_BAD_INPUT, place, "\"%s\", expected %d", "x", 7);
    TEST_ASSERT_EQUAL_STRING("a.csv:3:14: error: \"x\", expected 7\n", stderr_captured());
    TEST_ASSERT_EQUAL_INT(OUTCOME_BAD_INPUT, outcome);
}

static void test_unknown_places_are_left_out(void)
{
    message_error(OUTCOME_IO, (location_t){.file = "a", .line = 3}, "b");
    message_error(OUTCOME_IO, (location_t){.file = "a", .column = 3}, "b");
    message_error(OUTCOME_IO, NOWHERE, "b");
    TEST_ASSERT_EQUAL_STRING("a:3: error: b\na: error: b\nhyst: error: b\n", stderr_captured());
}

static void test_quiet_keeps_errors(void)
{
    message_warning(NOWHERE, "one");
    message_note(NOWHERE, "two");
    message_set_quiet(true);
    message_warning(NOWHERE, "three");
    message_note(NOWHERE, "four");
    message_error(OUTCOME_IO, NOWHERE, "five");
    TEST_ASSERT_EQUAL_STRING("hyst: warning: one\nhyst: note: two\nhyst: error: five\n", stderr_captured());
}

static void test_quoted_bytes_cannot_command_the_terminal(void)
{
    // Escape, delete, a C1 control in UTF-8, a cut-off sequence, a stray continuation; then text that is
    // fine.
    message_error(OUTCOME_IO, (location_t){.file = "\r"}, "%s",
                  "\x1b[2J\x7f\xc2\x9b\xe2\x82 \x80 \xc3\xa4 \xe2\x82\xac");
    TEST_ASSERT_EQUAL_STRING("\\x0D: error: \\x1B[2J\\x7F\\xC2\\x9B\\xE2\\x82 \\x80 \xc3\xa4 \xe2\x82\xac\n",
                             stderr_captured());
}

static void test_long_messages_are_whole(void)
{
    char text[5001];
    for (size_t i = 0; i < 5000; ++i) {
        text[i] = 'x';
    }
    text[5000] = '\0';
    message_error(OUTCOME_IO, NOWHERE, "%s", text);
    TEST_ASSERT_EQUAL_UINT(5000 + 14, strlen(stderr_captured()));
}

static void test_no_progress_where_there_is_no_terminal(void)
{
    message_progress("fitting", 0.5);
    message_progress_done();
    TEST_ASSERT_EQUAL_STRING("", stderr_captured());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_error_with_place);
    RUN_TEST(test_unknown_places_are_left_out);
    RUN_TEST(test_quiet_keeps_errors);
    RUN_TEST(test_quoted_bytes_cannot_command_the_terminal);
    RUN_TEST(test_long_messages_are_whole);
    RUN_TEST(test_no_progress_where_there_is_no_terminal);
    return UNITY_END();
}
