#include "diagnose_verdict.h"

#include "effect_catalogue.h"
#include "random.h"
#include <math.h>
#include <stdlib.h>
#include <unity.h>

enum { MOST = 3 };

static hypothesis_t hypotheses[MOST];
static const effect_use_t rounding = {.effect = &effect_quantization, .parameter = {0.1, 0}};
static const effect_use_t gain = {.effect = &effect_gain_offset, .parameter = {1.1, 0}};

void setUp(void)
{
}

void tearDown(void)
{
    for (size_t k = 0; k < MOST; k++) {
        hypothesis_free(&hypotheses[k]);
    }
}

/// One that leaves this mean square.
static void put(size_t index, const effect_use_t* uses, size_t num_uses, double mean_square)
{
    hypotheses[index] = hypothesis_of(uses, num_uses);
    hypotheses[index].fit_rmse = sqrt(mean_square);
}

static diagnosis_t judge(const scale_t* scale, size_t count)
{
    const candidates_t candidates = {.count = count, .hypothesis = hypotheses};
    diagnosis_t d = {0};
    verdict_find(scale, &candidates, &d);
    return d;
}

static const scale_t scale = {.noise = 1, .known = 1, .floor = 1, .grain = 0.3};

/// A hypothesis of one effect more than hypothesis 0, as likely as `odds` times that: by halving what it
/// leaves.
static void put_with_odds(const effect_use_t* uses, size_t num_uses, double odds)
{
    double low = 0;
    double high = hypothesis_mean_square(&hypotheses[0]);
    for (int i = 0; i < 60; i++) {
        hypothesis_free(&hypotheses[1]);
        put(1, uses, num_uses, 0.5 * (low + high));
        diagnosis_t d = judge(&scale, 2);
        const size_t named = d.cause[0].hypothesis == &hypotheses[1] ? 0 : 1;
        const double ratio = d.cause[named].probability / d.cause[1 - named].probability;
        *(ratio > odds ? &low : &high) = 0.5 * (low + high);
        free(d.cause);
    }
}

/// The stated odds are 6, whether or not a converter is known to be in all of them.
static void check_alarm(const effect_use_t* uses, size_t num_known)
{
    put(0, uses + 1, num_known, 2);
    put_with_odds(uses, num_known + 1, 5.9);
    diagnosis_t d = judge(&scale, 2);
    TEST_ASSERT_EQUAL_PTR(&hypotheses[0], d.cause[0].hypothesis);
    TEST_ASSERT_FALSE(d.confident);
    TEST_ASSERT_FALSE(d.is_unknown);
    TEST_ASSERT_EQUAL_UINT(1, d.num_indistinguishable);
    free(d.cause);
    put_with_odds(uses, num_known + 1, 6.1);
    d = judge(&scale, 2);
    TEST_ASSERT_EQUAL_PTR(&hypotheses[1], d.cause[0].hypothesis);
    free(d.cause);
}

static void test_nothing_is_named_that_is_hardly_likelier_than_nothing(void)
{
    const effect_use_t uses[] = {gain};
    check_alarm(uses, 0);
}

static void test_nor_beside_a_known_converter(void)
{
    const effect_use_t uses[] = {gain, rounding};
    check_alarm(uses, 1);
}

/// The stated part of the verdict's weight is a quarter.
static void test_what_is_a_quarter_as_likely_cannot_be_told(void)
{
    const effect_use_t uses[] = {gain};
    put(0, NULL, 0, 2);
    for (size_t more = 0; more < 2; more++) {
        put_with_odds(uses, 1, more == 1 ? 0.26 : 0.24);
        diagnosis_t d = judge(&scale, 2);
        TEST_ASSERT_EQUAL_PTR(&hypotheses[0], d.cause[0].hypothesis);
        TEST_ASSERT_EQUAL_UINT(more, d.num_indistinguishable);
        free(d.cause);
    }
}

/// Of 100 above the floor the best leaves 14 or 16; the floor is far below either.
static void test_what_leaves_over_15_percent_is_unknown(void)
{
    const effect_use_t uses[] = {gain};
    for (int more = 0; more < 2; more++) {
        put(0, NULL, 0, 101);
        put(1, uses, 1, more ? 17 : 15);
        diagnosis_t d = judge(&scale, 2);
        TEST_ASSERT_EQUAL(more == 1, d.is_unknown);
        free(d.cause);
        hypothesis_free(&hypotheses[0]);
        hypothesis_free(&hypotheses[1]);
    }
}

/// Steps of s explain s^2 / 12 of the gap by themselves: of that and the 2 above the floor, 2 are 15 % where
/// s is sqrt(12 * 2 * 0.85 / 0.15) = 11.7.
static void test_what_steps_explain_is_no_unknown(void)
{
    for (int more = 0; more < 2; more++) {
        const effect_use_t coarse = {.effect = &effect_quantization, .parameter = {more ? 11.8 : 11.5, 0}};
        put(0, &coarse, 1, 3);
        diagnosis_t d = judge(&scale, 1);
        TEST_ASSERT_EQUAL(more == 0, d.is_unknown);
        free(d.cause);
        hypothesis_free(&hypotheses[0]);
    }
}

/// The body leaves 1 on its bench and is expected to leave 4 here; what leaves 2 shows that it leaves 3 at
/// most.
static void test_the_floor_is_lowered_by_what_is_left(void)
{
    scale_t lowered = {.noise = 1, .known = 1, .floor = 4, .grain = 1, .floor_grain = 0.1};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5, scale_least_floor(&lowered));
    scale_lower(&lowered, 2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3, lowered.floor);
    TEST_ASSERT_TRUE(lowered.grain < 1);
    scale_lower(&lowered, 0.1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, lowered.floor);
}

/// What errors leave beyond half a step, drawn: a course anywhere between the steps, rounded with an error of
/// 1 on it. The squares' mean is known to sqrt(4.5 step / DRAWS) of itself where the step is large (three
/// times that allowed), and is the error's own square where it is small.
static void test_floor_behind_steps_is_what_errors_leave(void)
{
    enum { DRAWS = 400000 };
    const scale_t output = {.noise = 1, .known = 1, .floor = 1, .floor_grain = 0.14};
    const double steps[] = {0.01, 2, 10, 60};
    for (size_t k = 0; k < sizeof steps / sizeof steps[0]; k++) {
        const double step = steps[k];
        random_t random = random_new(31 + k);
        double sum = 0;
        for (size_t i = 0; i < DRAWS; i++) {
            const double at = random_uniform(&random, 0, step);
            const double level = step * round((at + random_normal(&random)) / step);
            const double beyond = fmax(fabs(at - level) - step / 2, 0);
            sum += beyond * beyond;
        }
        const scale_t behind = scale_behind_steps(&output, step, 0, DRAWS);
        // A normal error's fourth power is known to sqrt(2 / DRAWS) of the square at least.
        const double bound = 3 * sqrt((4.5 * step + 2) / DRAWS);
        TEST_ASSERT_DOUBLE_WITHIN(bound * behind.noise, behind.noise, sum / DRAWS);
        TEST_ASSERT_TRUE(behind.noise < behind.known);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 1, scale_behind_steps(&output, 0.01, 0, DRAWS).noise);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_is_named_that_is_hardly_likelier_than_nothing);
    RUN_TEST(test_nor_beside_a_known_converter);
    RUN_TEST(test_what_is_a_quarter_as_likely_cannot_be_told);
    RUN_TEST(test_what_leaves_over_15_percent_is_unknown);
    RUN_TEST(test_what_steps_explain_is_no_unknown);
    RUN_TEST(test_the_floor_is_lowered_by_what_is_left);
    RUN_TEST(test_floor_behind_steps_is_what_errors_leave);
    return UNITY_END();
}
