#include "captured.h"
#include "output_file.h"
#include "unity.h"
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static output_file_t file;

void setUp(void)
{
    folder_new();
    folder_write("old", "old", 3);
}

void tearDown(void)
{
    folder_remove();
}

static void test_appears_on_commit(void)
{
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, output_open(&file, folder_path("new")));
    fputs("text", file.stream);
    TEST_ASSERT_NULL(folder_read("new"));
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, output_commit(&file));
    TEST_ASSERT_EQUAL_STRING("text", folder_read("new"));
    TEST_ASSERT_EQUAL_UINT(2, folder_count());
}

static void test_replaces_on_commit_only(void)
{
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, output_open(&file, folder_path("old")));
    fputs("text", file.stream);
    fflush(file.stream);
    TEST_ASSERT_EQUAL_STRING("old", folder_read("old"));
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, output_commit(&file));
    TEST_ASSERT_EQUAL_STRING("text", folder_read("old"));
    TEST_ASSERT_EQUAL_UINT(1, folder_count());
}

static void test_abandoned_leaves_nothing(void)
{
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, output_open(&file, folder_path("old")));
    fputs("text", file.stream);
    output_abandon(&file);
    output_abandon(&file);
    TEST_ASSERT_EQUAL_STRING("old", folder_read("old"));
    TEST_ASSERT_EQUAL_UINT(1, folder_count());
}

static void test_failing_stream_is_not_committed(void)
{
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, output_open(&file, folder_path("old")));
    fputs("text", file.stream);
    fflush(file.stream);
    stderr_capture();
    // The descriptor turns unwritable under the stream, as when a disk goes away.
    TEST_ASSERT_EQUAL_INT(0, close(fileno(file.stream)));
    fputs("more", file.stream);
    const outcome_t outcome = output_commit(&file);
    TEST_ASSERT_NOT_NULL(strstr(stderr_captured(), "error: cannot be written"));
    TEST_ASSERT_EQUAL_INT(OUTCOME_IO, outcome);
    TEST_ASSERT_EQUAL_STRING("old", folder_read("old"));
    TEST_ASSERT_EQUAL_UINT(1, folder_count());
}

static void test_stdout_by_its_names(void)
{
    TEST_ASSERT_TRUE(output_is_stdout(NULL));
    TEST_ASSERT_TRUE(output_is_stdout("-"));
    TEST_ASSERT_FALSE(output_is_stdout(folder_path("old")));
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, output_open(&file, "-"));
    TEST_ASSERT_TRUE(file.stream == stdout);
    output_abandon(&file);
    TEST_ASSERT_EQUAL_INT(0, ferror(stdout));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_appears_on_commit);
    RUN_TEST(test_replaces_on_commit_only);
    RUN_TEST(test_abandoned_leaves_nothing);
    RUN_TEST(test_failing_stream_is_not_committed);
    RUN_TEST(test_stdout_by_its_names);
    return UNITY_END();
}
