#include "parallel.h"
#include <unity.h>

enum { COUNT = 1000 };

static unsigned calls[COUNT];

void setUp(void)
{
    for (size_t i = 0; i < COUNT; i++) {
        calls[i] = 0;
    }
}

void tearDown(void)
{
}

/// Pieces of very different lengths.
static void count_call(void* context, size_t index)
{
    unsigned* call = context;
    volatile unsigned spin = index % 7 == 0 ? 20000 : 1;
    while (spin > 0) {
        spin--;
    }
    call[index]++;
}

static void test_each_piece_is_done_once(void)
{
    static const size_t threads[] = {0, 1, 2, 7, 2 * COUNT};
    for (size_t i = 0; i < sizeof threads / sizeof threads[0]; i++) {
        setUp();
        parallel_for(COUNT, threads[i], count_call, calls, (parallel_progress_t){"count", 0, 1});
        for (size_t k = 0; k < COUNT; k++) {
            TEST_ASSERT_EQUAL(1, calls[k]);
        }
    }
}

static void test_fewer_pieces_than_threads(void)
{
    parallel_for(3, 8, count_call, calls, (parallel_progress_t){"count", 0, 1});
    for (size_t k = 0; k < COUNT; k++) {
        TEST_ASSERT_EQUAL(k < 3 ? 1 : 0, calls[k]);
    }
}

static void test_no_pieces_at_all(void)
{
    parallel_for(0, 4, count_call, calls, (parallel_progress_t){"count", 0, 1});
    TEST_ASSERT_EQUAL(0, calls[0]);
    TEST_ASSERT_TRUE(parallel_processors() >= 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_piece_is_done_once);
    RUN_TEST(test_fewer_pieces_than_threads);
    RUN_TEST(test_no_pieces_at_all);
    return UNITY_END();
}
