#include "model.h"
#include "nnls.h"
#include "random.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

enum { MAX_ROWS = 24, MAX_COLUMNS = 8 };

typedef struct {
    size_t rows, columns;
    double a[MAX_ROWS * MAX_COLUMNS];
    double b[MAX_ROWS];
    double x[MAX_COLUMNS];
    bool passive[MAX_COLUMNS];
    nnls_info_t info;
} problem_t;

static double entry(random_t* random)
{
    return random_uniform(random, -1, 1);
}

/// Columns of all kinds: random, zero, copies of others; sometimes more columns than rows.
static void make(problem_t* p, random_t* random)
{
    *p = (problem_t){0};
    p->columns = 1 + random_below(random, MAX_COLUMNS);
    p->rows = 1 + random_below(random, MAX_ROWS);
    for (size_t j = 0; j < p->columns; j++) {
        const size_t kind = random_below(random, 8);
        for (size_t i = 0; i < p->rows; i++) {
            const double copied = j > 0 ? p->a[i] : 1;
            p->a[j * p->rows + i] = kind == 0 ? 0 : kind == 1 ? copied : entry(random);
        }
    }
    for (size_t i = 0; i < p->rows; i++) {
        p->b[i] = entry(random);
    }
}

static outcome_t solve(problem_t* p)
{
    double* a = xmalloc(sizeof p->a);
    double b[MAX_ROWS];
    memcpy(a, p->a, sizeof p->a);
    memcpy(b, p->b, sizeof b);
    const outcome_t outcome = nnls_solve(a, p->rows, p->columns, b, p->x, p->passive, &p->info);
    free(a);
    return outcome;
}

static long double residual_at(const problem_t* p, size_t i)
{
    long double sum = -(long double)p->b[i];
    for (size_t j = 0; j < p->columns; j++) {
        sum += (long double)p->a[j * p->rows + i] * (long double)p->x[j];
    }
    return sum;
}

/// The Karush-Kuhn-Tucker conditions hold if and only if x is optimal: the problem is convex. Householder QR
/// gives gradients to some n eps; entries are at most 1 and rows at most 24, so 1e-9 leaves three decades.
static void check_optimal(const problem_t* p)
{
    long double squares = 0;
    for (size_t i = 0; i < p->rows; i++) {
        squares += residual_at(p, i) * residual_at(p, i);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, (double)sqrtl(squares), p->info.residual_norm);
    for (size_t j = 0; j < p->columns; j++) {
        long double gradient = 0;
        long double size = 0;
        for (size_t i = 0; i < p->rows; i++) {
            gradient += (long double)p->a[j * p->rows + i] * residual_at(p, i);
            size += (long double)fabs(p->a[j * p->rows + i] * p->x[j]);
        }
        TEST_ASSERT_TRUE(isfinite(p->x[j]) && p->x[j] >= 0);
        TEST_ASSERT_EQUAL(p->x[j] > 0, p->passive[j]);
        const double allowed = 1e-9 * (1 + (double)size);
        TEST_ASSERT_TRUE_MESSAGE((double)gradient > -allowed, "a bound variable wants to grow");
        TEST_ASSERT_TRUE_MESSAGE(p->x[j] <= 0 || fabs((double)gradient) < allowed,
                                 "a free variable is not at rest");
    }
}

static void test_random_problems_are_solved_to_optimality(void)
{
    random_t random = random_new(20150757);
    for (int round = 0; round < 3000; round++) {
        problem_t p;
        make(&p, &random);
        TEST_ASSERT_EQUAL(OUTCOME_OK, solve(&p));
        check_optimal(&p);
    }
}

/// From any set of passive columns, right or wrong, the same optimum is reached.
static void test_warm_start_reaches_the_same_optimum(void)
{
    random_t random = random_new(7);
    for (int round = 0; round < 500; round++) {
        problem_t p;
        make(&p, &random);
        TEST_ASSERT_EQUAL(OUTCOME_OK, solve(&p));
        const double cold = p.info.residual_norm;
        for (size_t j = 0; j < p.columns; j++) {
            p.passive[j] = random_below(&random, 2) == 0;
        }
        TEST_ASSERT_EQUAL(OUTCOME_OK, solve(&p));
        check_optimal(&p);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, cold, p.info.residual_norm);
    }
}

static void test_known_solution_is_found(void)
{
    // Columns (1, 0) and (0, 1), target (2, -3): the second is held at its bound.
    problem_t p = {.rows = 2, .columns = 2, .a = {1, 0, 0, 1}, .b = {2, -3}};
    TEST_ASSERT_EQUAL(OUTCOME_OK, solve(&p));
    TEST_ASSERT_DOUBLE_WITHIN(4 * DBL_EPSILON, 2, p.x[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0, p.x[1]);
    TEST_ASSERT_DOUBLE_WITHIN(4 * DBL_EPSILON, 3, p.info.residual_norm);
}

static void test_zero_target_gives_zero(void)
{
    problem_t p = {.rows = 2, .columns = 2, .a = {1, 2, 3, 4}, .passive = {true, true}};
    TEST_ASSERT_EQUAL(OUTCOME_OK, solve(&p));
    TEST_ASSERT_EQUAL_DOUBLE(0, p.x[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0, p.x[1]);
    TEST_ASSERT_FALSE(p.passive[0] || p.passive[1]);
}

static void test_values_that_are_not_finite_are_refused(void)
{
    problem_t p = {.rows = 2, .columns = 1, .a = {1, 2}, .b = {1, HUGE_VAL}};
    TEST_ASSERT_EQUAL(OUTCOME_NUMERICAL, solve(&p));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_random_problems_are_solved_to_optimality);
    RUN_TEST(test_warm_start_reaches_the_same_optimum);
    RUN_TEST(test_known_solution_is_found);
    RUN_TEST(test_zero_target_gives_zero);
    RUN_TEST(test_values_that_are_not_finite_are_refused);
    return UNITY_END();
}
