#include "diagnose_where.h"
#include "random.h"
#include <math.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 4000 };

static double time_of[SAMPLES];
static double input[SAMPLES];
static double output[SAMPLES];
static double gap[SAMPLES];
static effect_run_t run;
static region_t region[WHERE_MAX_REGIONS];
static const double noise = 0.1;

void setUp(void)
{
    // Ten triangles of 4 s each between 0 and 10.
    random_t random = random_new(3);
    for (size_t t = 0; t < SAMPLES; t++) {
        const double phase = 10.0 * (double)t / SAMPLES;
        const double part = phase - floor(phase);
        time_of[t] = 0.01 * (double)t;
        input[t] = 10 * (part < 0.5 ? 2 * part : 2 - 2 * part);
        output[t] = 3 * input[t];
        gap[t] = noise * random_normal(&random);
    }
    run = (effect_run_t){.num_samples = SAMPLES,
                         .time = time_of,
                         .input = input,
                         .input_span = 10,
                         .duration = 40,
                         .sample_time = 0.01};
}

void tearDown(void)
{
}

static const region_t* region_on(axis_t axis, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (region[i].axis == axis) {
            return &region[i];
        }
    }
    return NULL;
}

/// A gap of 1 in 8 ... 12 s has all its energy there: a tenth of the samples, lift 10. The noise's own energy
/// is subtracted, so what is left of it is its estimate's scatter: 4000 squares of 0.1 against 400 of 1,
/// below 1 %.
static void test_time_region_is_found(void)
{
    for (size_t t = 800; t < 1200; t++) {
        gap[t] += 1;
    }
    const size_t count = where_find(&run, output, gap, noise, region);
    TEST_ASSERT_EQUAL(AXIS_TIME, region[0].axis);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 8, region[0].from);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 12, region[0].to);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 1, region[0].share);
    TEST_ASSERT_DOUBLE_WITHIN(0.5, 10, region[0].lift);
    TEST_ASSERT_TRUE(count >= 6);
}

static void test_descending_gap_is_found(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        const double phase = 10.0 * (double)t / SAMPLES;
        gap[t] += phase - floor(phase) >= 0.5 ? 1 : 0;
    }
    const size_t count = where_find(&run, output, gap, noise, region);
    TEST_ASSERT_EQUAL(AXIS_DIRECTION, region[0].axis);
    TEST_ASSERT_EQUAL_DOUBLE(-1, region[0].from);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 1, region[0].share);
    TEST_ASSERT_NOT_NULL(region_on(AXIS_TIME, count));
}

/// The first 0.2 s after each reversal, a tenth of the samples.
static void test_gap_after_reversals_is_found(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        gap[t] += (t + 199) % 200 < 20 ? 1 : 0; // the turning point itself still belongs to the move before
    }
    const size_t count = where_find(&run, output, gap, noise, region);
    const region_t* since = region_on(AXIS_SINCE_REVERSAL, count);
    TEST_ASSERT_NOT_NULL(since);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 0, since->from);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 0.2, since->to);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 1, since->share);
    char text[200];
    where_describe(since, "V", "um", text, sizeof text);
    TEST_ASSERT_NOT_NULL(strstr(text, "after a reversal"));
}

static void test_input_region_and_interval(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        gap[t] += input[t] > 7 && input[t] < 9 ? 1 : 0;
    }
    const size_t count = where_find(&run, output, gap, noise, region);
    const region_t* at = region_on(AXIS_INPUT, count);
    TEST_ASSERT_NOT_NULL(at);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 7, at->from);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 9, at->to);
    TEST_ASSERT_TRUE(at->share_low <= at->share && at->share <= at->share_high);
}

static const double pi = 3.14159265358979324;

/// Amplitudes whose squares sum to 1: the lower tone holds 0.84 of the energy. Reaching out to the other
/// would gain 0.16 of it for 10 of 50 Hz.
static void add_tones(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        gap[t] +=
            sqrt(2 * 0.84) * sin(2 * pi * 2 * time_of[t]) + sqrt(2 * 0.16) * sin(2 * pi * 12 * time_of[t]);
    }
}

/// Of two tones the stronger is found with its share: whole periods, so each is one bin of 1 / 40 Hz. Tone
/// times noise changes the shares by some 2 * 0.1 / sqrt(4000) = 0.3 %, four times that by 1.3 %.
static void test_band_holds_its_tone(void)
{
    add_tones();
    const size_t count = where_find(&run, output, gap, noise, region);
    const region_t* band = region_on(AXIS_FREQUENCY, count);
    TEST_ASSERT_NOT_NULL(band);
    TEST_ASSERT_EQUAL_PTR(&region[0], band); // no other axis has a share to tell
    TEST_ASSERT_TRUE(band->from < 2 && 2 < band->to);
    TEST_ASSERT_DOUBLE_WITHIN(0.013, 0.84, band->share);
    TEST_ASSERT_TRUE(band->share_low <= band->share && band->share <= band->share_high);
    // One bin, and now and then a neighbour whose noise is above its mean: of 2001.
    TEST_ASSERT_TRUE(band->to - band->from < 5.0 / 40);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * band->lift,
                              band->share * 50.0 / (band->to - band->from) * 2001.0 / 2000.0, band->lift);
    char text[200];
    where_describe(band, "V", "um", text, sizeof text);
    TEST_ASSERT_NOT_NULL(strstr(text, "Hz"));
}

/// Every tenth sample is missing, and its neighbours' mean in its place: cos(2 pi f h) of the tone's value
/// there. Of the tone 0.9 + 0.1 cos is left as a line, 0.09 (1 - cos)^2 of its energy is spread out.
static void test_band_of_an_uneven_record(void)
{
    add_tones();
    size_t n = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        if (t % 10 != 5) {
            time_of[n] = time_of[t];
            input[n] = input[t];
            output[n] = output[t];
            gap[n++] = gap[t];
        }
    }
    run.num_samples = n;
    double kept[2];
    double whole[2];
    static const double frequency[2] = {2, 12};
    static const double energy[2] = {0.84, 0.16};
    for (int i = 0; i < 2; i++) {
        const double mean = cos(2 * pi * frequency[i] * 0.01);
        kept[i] = energy[i] * pow(0.9 + 0.1 * mean, 2);
        whole[i] = kept[i] + energy[i] * 0.09 * pow(1 - mean, 2);
    }
    const size_t count = where_find(&run, output, gap, noise, region);
    const region_t* band = region_on(AXIS_FREQUENCY, count);
    TEST_ASSERT_NOT_NULL(band);
    TEST_ASSERT_TRUE(band->from < 2 && 2 < band->to);
    TEST_ASSERT_DOUBLE_WITHIN(0.013, kept[0] / (whole[0] + whole[1]), band->share);
}

/// A gap that is like the output lies at the output's own frequencies: that is no news, and stands last.
static void test_band_of_a_gain_error_is_not_telling(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        gap[t] += 0.1 * output[t];
    }
    const size_t count = where_find(&run, output, gap, noise, region);
    TEST_ASSERT_TRUE(region[0].axis != AXIS_FREQUENCY);
    const region_t* band = region_on(AXIS_FREQUENCY, count);
    TEST_ASSERT_NOT_NULL(band);
    TEST_ASSERT_TRUE(band->lift > 10); // though it is a small part of the spectrum
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_time_region_is_found);
    RUN_TEST(test_descending_gap_is_found);
    RUN_TEST(test_gap_after_reversals_is_found);
    RUN_TEST(test_input_region_and_interval);
    RUN_TEST(test_band_holds_its_tone);
    RUN_TEST(test_band_of_an_uneven_record);
    RUN_TEST(test_band_of_a_gain_error_is_not_telling);
    return UNITY_END();
}
