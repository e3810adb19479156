#include "json_locate.h"
#include "unity.h"
#include <string.h>

static const char text[] = "{\"name\": \"a \\\" ]}, \\\\\",\n"
                           " \"deep\": {\"x\": [[1], {\"y\": [2]}], \"y\": [3, \"]\", 5]},\n"
                           " \"list\" : [ {\"type\": 1}, {\"no\": [], \"type\" :\t2} ],\n"
                           " \"number\":-1e5}";

void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_place(size_t line, size_t column, const char* key, const char* subkey, long index)
{
    const location_t place = json_locate("f", text, strlen(text), key, subkey, index);
    TEST_ASSERT_EQUAL_STRING("f", place.file);
    TEST_ASSERT_EQUAL_UINT(line, place.line);
    TEST_ASSERT_EQUAL_UINT(column, place.column);
}

static void test_members_and_elements(void)
{
    assert_place(1, 1, NULL, NULL, -1);
    assert_place(1, 10, "name", NULL, -1);
    assert_place(2, 10, "deep", NULL, -1);
    assert_place(2, 40, "deep", "y", -1);
    assert_place(2, 41, "deep", "y", 0);
    assert_place(2, 49, "deep", "y", 2);
    assert_place(4, 11, "number", NULL, -1);
}

static void test_index_before_subkey_in_an_array(void)
{
    assert_place(3, 26, "list", NULL, 1);
    assert_place(3, 46, "list", "type", 1);
}

static void test_what_is_missing_is_placed_at_what_encloses_it(void)
{
    assert_place(1, 1, "absent", "y", 1);
    assert_place(2, 10, "deep", "absent", 1);
    assert_place(2, 40, "deep", "y", 3);
    assert_place(3, 13, "list", "absent", 0);
    assert_place(4, 11, "number", "y", 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_members_and_elements);
    RUN_TEST(test_index_before_subkey_in_an_array);
    RUN_TEST(test_what_is_missing_is_placed_at_what_encloses_it);
    return UNITY_END();
}
