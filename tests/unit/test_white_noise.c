#include "random.h"
#include "white_noise.h"
#include <math.h>
#include <unity.h>

enum { SAMPLES = 10000, FEW = 4 };

static const double noise = 0.3;
/// The median of n magnitudes scatters by 1.17 / sqrt(n) of itself where they are independent. Second
/// differences further than two samples apart are, so that scatter grows by at most sqrt(5): 2.6 %, taken
/// four times.
static const double scatter = 4 * 1.17 * 2.2360679775 / 100;
static double signal[SAMPLES];

void setUp(void)
{
    random_t random = random_new(11);
    for (size_t t = 0; t < SAMPLES; t++) {
        signal[t] = noise * random_normal(&random);
    }
}

void tearDown(void)
{
}

static void test_white_noise_is_found_to_its_scatter(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(scatter * noise, noise, white_noise(signal, SAMPLES));
}

static void test_a_straight_course_beneath_adds_nothing(void)
{
    const double alone = white_noise(signal, SAMPLES);
    for (size_t t = 0; t < SAMPLES; t++) {
        signal[t] += 1e3 - 0.5 * (double)t;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, alone, white_noise(signal, SAMPLES));
}

static void test_it_grows_with_the_signal(void)
{
    const double alone = white_noise(signal, SAMPLES);
    for (size_t t = 0; t < SAMPLES; t++) {
        signal[t] *= -8;
    }
    TEST_ASSERT_EQUAL_DOUBLE(8 * alone, white_noise(signal, SAMPLES));
}

/// A step spoils two second differences. With one in 100 samples the median of all is a quantile of the sound
/// ones between 0.49 and 0.51 of them: 2.4 % of the median further, for their density there is 0.43 / median.
static void test_jumps_are_not_noise(void)
{
    const double alone = white_noise(signal, SAMPLES);
    double level = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        level += t % 100 == 50 ? 1e3 : 0;
        signal[t] += level;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.03 * alone, alone, white_noise(signal, SAMPLES));
}

static void test_too_few_samples_have_none(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0, white_noise(signal, FEW));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_white_noise_is_found_to_its_scatter);
    RUN_TEST(test_a_straight_course_beneath_adds_nothing);
    RUN_TEST(test_it_grows_with_the_signal);
    RUN_TEST(test_jumps_are_not_noise);
    RUN_TEST(test_too_few_samples_have_none);
    return UNITY_END();
}
