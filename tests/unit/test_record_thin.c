#include "model.h"
#include "random.h"
#include "record_thin.h"
#include "reference.h"
#include <math.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 100000, MOST = 12000, STRETCHES = 12, LENGTH = 2 * MOST / 3 / STRETCHES };

static double time_of[SAMPLES];
static double input[SAMPLES];
static double output[SAMPLES];
static double warmth[SAMPLES];
static char name[] = "temperature";
static char path[] = "made.csv";
static column_t column = {name, warmth};
static record_t record;
static record_t thinned;

/// Ramps of 200 samples and more between random levels, now and then a hold: times with a jitter of their
/// own.
void setUp(void)
{
    random_t random = random_new(6);
    double from = 0;
    double to = 10;
    size_t begin = 0;
    size_t length = 300;
    for (size_t t = 0; t < SAMPLES; t++) {
        if (t == begin + length) {
            begin = t;
            from = to;
            to = random_below(&random, 5) == 0 ? to : random_uniform(&random, 0, 10);
            length = 200 + (size_t)random_below(&random, 400);
        }
        time_of[t] = 0.01 * ((double)t + random_uniform(&random, 0, 0.3));
        input[t] = from + (to - from) * (double)(t - begin) / (double)length;
        output[t] = random_normal(&random);
        warmth[t] = (double)t;
    }
    record = (record_t){path, SAMPLES, time_of, input, output, 1, &column, NULL};
}

void tearDown(void)
{
    record_free(&thinned);
}

/// The sample of the whole record that a kept one is: the auxiliary column says its number.
static size_t number_of(size_t kept)
{
    return (size_t)lround(thinned.auxiliary[0].value[kept]);
}

static void test_a_short_record_stays_as_it_is(void)
{
    record.num_samples = MOST;
    thinned = record_thin(&record, MOST, 0);
    TEST_ASSERT_EQUAL(MOST, thinned.num_samples);
    TEST_ASSERT_NULL(thinned.carried);
    TEST_ASSERT_EQUAL_MEMORY(time_of, thinned.time, MOST * sizeof *time_of);
    TEST_ASSERT_EQUAL_MEMORY(input, thinned.input, MOST * sizeof *input);
    TEST_ASSERT_EQUAL_MEMORY(output, thinned.output, MOST * sizeof *output);
    TEST_ASSERT_EQUAL_MEMORY(warmth, thinned.auxiliary[0].value, MOST * sizeof *warmth);
    TEST_ASSERT_EQUAL_STRING(name, thinned.auxiliary[0].name);
    TEST_ASSERT_EQUAL_STRING(path, thinned.path);
}

static void test_a_start_that_is_not_to_be_judged_is_carried(void)
{
    static const size_t lengths[] = {MOST, SAMPLES};
    const size_t first = 5000; // beyond the first stretch of the long one
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        record.num_samples = lengths[i];
        record_t all = record_thin(&record, MOST, 0);
        thinned = record_thin(&record, MOST, first);
        TEST_ASSERT_EQUAL(all.num_samples, thinned.num_samples);
        for (size_t k = 0; k < thinned.num_samples; k++) {
            const bool was_carried = all.carried != NULL && all.carried[k];
            TEST_ASSERT_EQUAL(was_carried || number_of(k) < first, thinned.carried[k]);
        }
        record_free(&all);
        record_free(&thinned);
    }
}

static void test_what_is_kept_is_the_record_s_own_in_order(void)
{
    static const size_t lengths[] = {MOST + 1, 3 * MOST, SAMPLES};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        record.num_samples = lengths[i];
        thinned = record_thin(&record, MOST, 0);
        TEST_ASSERT_TRUE(thinned.num_samples <= MOST);
        TEST_ASSERT_EQUAL(0, number_of(0));
        TEST_ASSERT_EQUAL(lengths[i] - 1, number_of(thinned.num_samples - 1));
        for (size_t k = 0; k < thinned.num_samples; k++) {
            const size_t t = number_of(k);
            TEST_ASSERT_TRUE(k == 0 || t > number_of(k - 1));
            TEST_ASSERT_EQUAL_DOUBLE(time_of[t], thinned.time[k]);
            TEST_ASSERT_EQUAL_DOUBLE(input[t], thinned.input[k]);
            TEST_ASSERT_EQUAL_DOUBLE(output[t], thinned.output[k]);
        }
        record_free(&thinned);
    }
}

/// Twelve stretches at full rate, of each but the first its first quarter carried.
static void test_judged_samples_lie_in_stretches(void)
{
    thinned = record_thin(&record, MOST, 0);
    size_t judged = 0;
    size_t stretches = 0;
    for (size_t k = 0; k < thinned.num_samples; k++) {
        judged += !thinned.carried[k];
        if (thinned.carried[k]) {
            continue;
        }
        const bool goes_on = k > 0 && !thinned.carried[k - 1];
        stretches += !goes_on;
        TEST_ASSERT_TRUE(!goes_on || number_of(k) == number_of(k - 1) + 1);
        // The carried part ahead of it is at full rate too.
        TEST_ASSERT_TRUE(goes_on || k == 0 || number_of(k) - number_of(k - LENGTH / 4) == LENGTH / 4);
    }
    TEST_ASSERT_EQUAL(STRETCHES, stretches);
    TEST_ASSERT_EQUAL(STRETCHES * LENGTH - (STRETCHES - 1) * (LENGTH / 4), judged);
}

/// Between two stretches lie (SAMPLES - 12 * 666) / 11 = 8364 samples in cells of at most 91: none of them
/// has two turning points, which are 200 apart. So all turning points are kept, and as plays do not care for
/// the rate they are, at every kept sample, in the states of the whole run; a sum of 8 rounds alike.
static void test_plays_run_as_on_the_whole_record(void)
{
    model_t model = model_new("plays");
    model.input_max = 10;
    model_set_num_plays(&model, 8);
    for (size_t j = 0; j < 8; j++) {
        model.radius[j] = 0.4 * (double)(j + 1);
        model.weight[j] = 1;
    }
    static double whole[SAMPLES];
    static double short_of[MOST];
    thinned = record_thin(&record, MOST, 0);
    reference_run(&model, START_NEGATIVE_SATURATION, input, SAMPLES, whole);
    reference_run(&model, START_NEGATIVE_SATURATION, thinned.input, thinned.num_samples, short_of);
    for (size_t k = 0; k < thinned.num_samples; k++) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, whole[number_of(k)], short_of[k]);
    }
    model_free(&model);
}

/// What a logger lost is put back before: a triangle's turning points, here with five neighbours each.
static void test_plays_saw_what_was_lost_of_a_long_record(void)
{
    enum { RAMP = 100 };
    model_t model = model_new("plays");
    model.input_max = 10;
    model_set_num_plays(&model, 1);
    model.radius[0] = 0.5;
    model.weight[0] = 1;
    static double whole[SAMPLES];
    static double short_of[MOST];
    for (size_t t = 0; t < SAMPLES; t++) {
        time_of[t] = 0.01 * (double)t;
        input[t] = fabs(10 - (double)(t % (2 * RAMP)) / RAMP * 10);
    }
    reference_run(&model, START_NEGATIVE_SATURATION, input, SAMPLES, whole);
    size_t left = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        if ((t + 2) % RAMP >= 6 || t < RAMP) {
            time_of[left] = time_of[t];
            warmth[left] = (double)t;
            input[left++] = input[t];
        }
    }
    record.num_samples = left;
    thinned = record_thin(&record, MOST, 0);
    TEST_ASSERT_TRUE(thinned.num_samples <= MOST);
    reference_run(&model, START_NEGATIVE_SATURATION, thinned.input, thinned.num_samples, short_of);
    for (size_t k = 0; k < thinned.num_samples; k++) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, whole[number_of(k)], short_of[k]);
        const size_t place = (number_of(k) + 2) % RAMP;
        TEST_ASSERT_TRUE(thinned.carried[k] || place >= 6 || number_of(k) < RAMP);
    }
    model_free(&model);
}

static void test_a_record_without_time_counts_its_samples(void)
{
    record.time = NULL;
    thinned = record_thin(&record, MOST, 0);
    for (size_t k = 0; k < thinned.num_samples; k++) {
        TEST_ASSERT_EQUAL_DOUBLE((double)number_of(k), thinned.time[k]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_short_record_stays_as_it_is);
    RUN_TEST(test_a_start_that_is_not_to_be_judged_is_carried);
    RUN_TEST(test_what_is_kept_is_the_record_s_own_in_order);
    RUN_TEST(test_judged_samples_lie_in_stretches);
    RUN_TEST(test_plays_run_as_on_the_whole_record);
    RUN_TEST(test_plays_saw_what_was_lost_of_a_long_record);
    RUN_TEST(test_a_record_without_time_counts_its_samples);
    return UNITY_END();
}
