#include "model.h"
#include "random.h"
#include "record_fill.h"
#include "sample_steps.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

enum { WHOLE = 400, RAMP = 25 };

static const double sample_time = 0.02;
static char path[] = "made.csv";
static record_t record;

void setUp(void)
{
}

void tearDown(void)
{
    record_free(&record);
}

typedef double input_t(size_t t);
typedef bool loss_t(size_t t);

/// Turns at the multiples of RAMP, on samples.
static double triangle(size_t t)
{
    const size_t place = t % (2 * RAMP);
    return (double)(place < RAMP ? place : 2 * RAMP - place);
}

/// Turns between two samples, one of which is lost.
static double late_triangle(size_t t)
{
    const double place = fmod((double)t + 0.3, 2 * RAMP);
    return fmin(place, 2 * RAMP - place);
}

/// A hump and a hollow in turn, smooth where they meet.
static double parabolas(size_t t)
{
    const double place = (double)(t % (2 * RAMP));
    const double hump = place * (2 * RAMP - place);
    return t / (2 * RAMP) % 2 == 0 ? hump : -hump;
}

static bool turns(size_t t)
{
    return t % RAMP == 0 && t > 0;
}

/// One to six samples, the turning point among them.
static bool runs_at_turns(size_t t)
{
    const size_t before = t / RAMP % 3;
    return (t % RAMP <= t / RAMP % 4 && t >= RAMP) || (t % RAMP >= RAMP - before && t >= RAMP);
}

static bool runs_at_smooth_turns(size_t t)
{
    return (t + 2) % (2 * RAMP) >= RAMP && (t + 2) % (2 * RAMP) < RAMP + 5;
}

static bool runs_on_the_way(size_t t)
{
    return t % RAMP >= 8 && t % RAMP < 8 + t / RAMP % 7;
}

static bool nothing(size_t t)
{
    (void)t;
    return false;
}

/// What a logger leaves of a record whose outputs and column count its samples.
static void lose(input_t* input, loss_t* lost)
{
    record = (record_t){.path = xstrdup(path),
                        .time = xmalloc(WHOLE * sizeof(double)),
                        .input = xmalloc(WHOLE * sizeof(double)),
                        .output = xmalloc(WHOLE * sizeof(double)),
                        .num_auxiliary = 1,
                        .auxiliary = xcalloc(1, sizeof(column_t))};
    record.auxiliary[0] = (column_t){xstrdup("temperature"), xmalloc(WHOLE * sizeof(double))};
    for (size_t t = 0; t < WHOLE; t++) {
        if (!lost(t)) {
            const size_t k = record.num_samples++;
            record.time[k] = sample_time * (double)t;
            record.input[k] = input(t);
            record.output[k] = 2.0 * (double)t;
            record.auxiliary[0].value[k] = -(double)t;
        }
    }
}

static void check_whole(input_t* input, loss_t* lost)
{
    lose(input, lost);
    record_fill(&record);
    TEST_ASSERT_EQUAL(WHOLE, record.num_samples);
    for (size_t t = 0; t < WHOLE; t++) {
        TEST_ASSERT_EQUAL(lost(t), record.carried[t]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, sample_time * (double)t, record.time[t]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, input(t), record.input[t]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 * (double)t, record.output[t]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, -(double)t, record.auxiliary[0].value[t]);
    }
}

static void test_lost_turns_come_back(void)
{
    check_whole(triangle, turns);
}

static void test_a_turn_between_the_samples_is_on_one_of_the_courses(void)
{
    check_whole(late_triangle, turns);
}

static void test_smooth_turns_come_back(void)
{
    check_whole(parabolas, turns);
}

static void test_turns_in_runs_of_lost_samples_come_back(void)
{
    check_whole(triangle, runs_at_turns);
    record_free(&record);
    check_whole(parabolas, runs_at_smooth_turns);
}

static void test_runs_of_lost_samples_are_on_a_line(void)
{
    check_whole(triangle, runs_on_the_way);
}

static void test_what_was_carried_stays_so(void)
{
    lose(triangle, turns);
    record.carried = xcalloc(record.num_samples, sizeof *record.carried);
    memset(record.carried, true, 10);
    record_fill(&record);
    for (size_t t = 0; t < WHOLE; t++) {
        TEST_ASSERT_EQUAL(t < 10 || turns(t), record.carried[t]);
    }
}

static void check_same(void)
{
    const size_t num_samples = record.num_samples;
    record_fill(&record);
    TEST_ASSERT_EQUAL(num_samples, record.num_samples);
    TEST_ASSERT_NULL(record.carried);
}

static void test_nothing_lost_nothing_added(void)
{
    lose(triangle, nothing);
    check_same();
}

/// Eight sample times are the most that a straight line is trusted for.
static bool pauses(size_t t)
{
    return t % 100 >= 60 && t % 100 < 68;
}

static void test_pauses_stay(void)
{
    lose(triangle, pauses);
    check_same();
}

static void test_times_that_are_no_multiples_stay(void)
{
    random_t random = random_new(3);
    lose(triangle, nothing);
    for (size_t t = 1; t < record.num_samples; t++) {
        record.time[t] =
            record.time[t - 1] + sample_time * (t % 3 == 0 ? random_uniform(&random, 1.2, 1.8) : 1);
    }
    check_same();
}

/// The second half at every fourth sample: three "lost" for five that are there.
static bool another_rate(size_t t)
{
    return t > WHOLE / 2 && t % 4 != 0;
}

static void test_another_rate_is_no_loss(void)
{
    lose(triangle, another_rate);
    check_same();
}

static void test_a_record_without_times_stays(void)
{
    lose(triangle, turns);
    free(record.time);
    record.time = NULL;
    check_same();
}

/// Every fifth step double: of a long record the median is that of whole stretches, not of every fifth step.
static void test_a_long_record_s_sample_time(void)
{
    enum { LONG = 450000 };
    double* time = xmalloc(LONG * sizeof *time);
    for (size_t t = 0; t < LONG; t++) {
        time[t] = sample_time * (double)(t + t / 5);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * sample_time, sample_time, sample_time_of(time, LONG));
    free(time);
}

/// A measured input at rest: what is put back lies no further out than a neighbour's step leads.
static void test_noise_is_not_carried_away(void)
{
    random_t random = random_new(5);
    lose(triangle, turns);
    for (size_t t = 0; t < record.num_samples; t++) {
        record.input[t] = random_normal(&random);
    }
    record_fill(&record);
    for (size_t t = RAMP; t < WHOLE; t += RAMP) {
        const double* x = &record.input[t];
        const double step = fmax(fabs(x[-1] - x[-2]), fabs(x[2] - x[1]));
        TEST_ASSERT_TRUE(x[0] <= fmax(x[-1], x[1]) + step);
        TEST_ASSERT_TRUE(x[0] >= fmin(x[-1], x[1]) - step);
    }
}

static void test_a_short_record_has_no_courses(void)
{
    lose(triangle, nothing);
    record.num_samples = 2;
    record.time[1] = 5 * sample_time;
    check_same();
    record.num_samples = 5;
    for (size_t t = 1; t < record.num_samples; t++) {
        record.time[t] = record.time[t - 1] + sample_time * (t == 2 ? 2 : 1);
    }
    record_fill(&record);
    TEST_ASSERT_EQUAL(6, record.num_samples);
    for (size_t t = 0; t < record.num_samples; t++) {
        TEST_ASSERT_TRUE(isfinite(record.input[t]));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_lost_turns_come_back);
    RUN_TEST(test_a_turn_between_the_samples_is_on_one_of_the_courses);
    RUN_TEST(test_smooth_turns_come_back);
    RUN_TEST(test_turns_in_runs_of_lost_samples_come_back);
    RUN_TEST(test_runs_of_lost_samples_are_on_a_line);
    RUN_TEST(test_what_was_carried_stays_so);
    RUN_TEST(test_nothing_lost_nothing_added);
    RUN_TEST(test_pauses_stay);
    RUN_TEST(test_times_that_are_no_multiples_stay);
    RUN_TEST(test_another_rate_is_no_loss);
    RUN_TEST(test_a_record_without_times_stays);
    RUN_TEST(test_a_long_record_s_sample_time);
    RUN_TEST(test_noise_is_not_carried_away);
    RUN_TEST(test_a_short_record_has_no_courses);
    return UNITY_END();
}
