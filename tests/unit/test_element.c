#include "bounded.h"
#include "element_fit.h"
#include "element_plant.h"
#include "model.h"
#include "random.h"
#include "series.h"
#include <math.h>
#include <stdlib.h>
#include <unity.h>

enum { SAMPLES = 3000 };

static const double noise = 0.002;
static double input[SAMPLES];
static double output[SAMPLES];
static double predicted[SAMPLES];

void setUp(void)
{
}

void tearDown(void)
{
}

static element_record_t calibrate(element_plant_step_t* step)
{
    random_t random = random_new(9);
    element_plant_input(1, input, SAMPLES);
    element_plant_run(step, input, SAMPLES, output);
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] += 5 * noise * random_normal(&random);
    }
    return (element_record_t){.input = input,
                              .output = output,
                              .num_samples = SAMPLES,
                              .input_min = 40,
                              .input_max = 60,
                              .noise = 5 * noise};
}

/// Of a calibration of its kind it leaves the noise, whose RMS over this many samples is known to 1/sqrt(2 n)
/// (four of those are asked), and the other kind more; on an input that it has not seen, the error of
/// ELEMENT_FREE fitted numbers is sqrt(ELEMENT_FREE / n) of the noise where the two inputs go alike (three of
/// those are asked).
static void check_kind(element_kind_t kind, element_plant_step_t* step)
{
    const element_record_t record = calibrate(step);
    double rmse;
    const element_t element = element_fit(kind, &record, &rmse);
    TEST_ASSERT_DOUBLE_WITHIN(4 * record.noise / sqrt(2.0 * SAMPLES), record.noise, rmse);
    double other;
    (void)element_fit(ELEMENT_KINDS - 1 - kind, &record, &other);
    TEST_ASSERT_TRUE(other > rmse);
    element_plant_input(2, input, SAMPLES);
    element_plant_run(step, input, SAMPLES, output);
    element_run(&element, 0, input, SAMPLES, predicted);
    TEST_ASSERT_TRUE(sqrt(series_mean_square(predicted, output, SAMPLES)) <
                     3 * record.noise * sqrt((double)ELEMENT_FREE / SAMPLES));
}

static void test_a_bouc_wen_element_is_found(void)
{
    check_kind(ELEMENT_BOUC_WEN, element_plant_bouc_wen);
}

static void test_a_jiles_atherton_element_is_found(void)
{
    check_kind(ELEMENT_JILES_ATHERTON, element_plant_jiles_atherton);
}

/// Gain and curve are linear, so their derivatives are differences to rounding. A shape's is a difference to
/// one side, over a step of at most 1e-4 of it: off by half that step times the curvature, which is the
/// difference of the slopes to the two sides over the step between them. Differences of outputs are known to
/// 1e-10 where steps of the midpoint rule are many.
static double slope_of(element_t* element, double* number, double step, size_t t)
{
    const double kept = *number;
    *number += step;
    element_run(element, 0, input, t + 1, predicted);
    *number = kept;
    return (predicted[t] - output[t]) / step;
}

static void test_derivatives_are_those_of_the_output(void)
{
    const element_record_t record = calibrate(element_plant_jiles_atherton);
    double rmse;
    element_t element = element_fit(ELEMENT_JILES_ATHERTON, &record, &rmse);
    double* derivatives = xmalloc(SAMPLES * ELEMENT_FREE * sizeof *derivatives);
    element_derivatives(&element, input, SAMPLES, derivatives);
    element_run(&element, 0, input, SAMPLES, output);
    for (size_t t = 7; t < SAMPLES; t += 271) {
        const double* row = &derivatives[t * ELEMENT_FREE];
        for (size_t k = 0; k < ELEMENT_SHAPES; k++) {
            const double step = 1e-3 * fmax(fabs(element.shape[k]), 0.1);
            const double up = slope_of(&element, &element.shape[k], step, t);
            const double down = slope_of(&element, &element.shape[k], -step, t);
            TEST_ASSERT_DOUBLE_WITHIN(fabs(up - down) + 1e-10 / step, 0.5 * (up + down), row[k]);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, slope_of(&element, &element.gain, 1, t), row[ELEMENT_SHAPES]);
        for (size_t k = 0; k < ELEMENT_CURVE; k++) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, slope_of(&element, &element.curve[k], 1, t),
                                      row[ELEMENT_SHAPES + 1 + k]);
        }
    }
    free(derivatives);
}

/// One step a sample, its slope taken where the input has come to and the state has not: as a program steps a
/// material that it simulates.
static double explicit_atherton(element_plant_t* p, double x)
{
    const double way = x > p->x ? 1 : -1;
    const double effective = (2 * x - 1 + 0.08 * p->z) / 0.25;
    const double ideal = 1 / tanh(effective) - 1 / effective;
    const double lack = ideal - p->wall;
    if (lack * way > 0) {
        p->wall += 2 * (x - p->x) * lack / (0.2 * way - 0.08 * lack);
    }
    p->x = x;
    p->z = 0.2 * ideal + 0.8 * p->wall;
    return 0.4 * p->z;
}

/// The bench tells where in a step the slope is taken, and with it other work is met; taken in the middle,
/// the error on other work is larger.
static void test_moments_of_a_step_are_found(void)
{
    const element_record_t record = calibrate(explicit_atherton);
    double rmse;
    element_t element = element_fit(ELEMENT_JILES_ATHERTON, &record, &rmse);
    element_plant_input(2, input, SAMPLES);
    element_plant_run(explicit_atherton, input, SAMPLES, output);
    element_run(&element, 0, input, SAMPLES, predicted);
    const double found = sqrt(series_mean_square(predicted, output, SAMPLES));
    TEST_ASSERT_TRUE(found < 3 * record.noise * sqrt((double)ELEMENT_FREE / SAMPLES));
    element.shape[ELEMENT_INPUT_AHEAD] = 0;
    element.shape[ELEMENT_STATE_AHEAD] = 0;
    element_run(&element, 0, input, SAMPLES, predicted);
    TEST_ASSERT_TRUE(sqrt(series_mean_square(predicted, output, SAMPLES)) > 2 * found);
}

/// A Bouc-Wen element's slope knows no input, so only the state's moment matters.
static void test_a_bouc_wen_step_has_one_moment(void)
{
    const element_record_t record = calibrate(element_plant_bouc_wen);
    double rmse;
    const element_t element = element_fit(ELEMENT_BOUC_WEN, &record, &rmse);
    double* derivatives = xmalloc(SAMPLES * ELEMENT_FREE * sizeof *derivatives);
    element_derivatives(&element, input, SAMPLES, derivatives);
    double largest = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        const double* row = &derivatives[t * ELEMENT_FREE];
        TEST_ASSERT_EQUAL_DOUBLE(0, row[ELEMENT_INPUT_AHEAD]);
        largest = fmax(largest, fabs(row[ELEMENT_STATE_AHEAD]));
    }
    TEST_ASSERT_TRUE(largest > 1e-6);
    free(derivatives);
}

/// Half the range beyond it stays where it is; a shift of the start moves the first output by as much and
/// fades on the way to the top: with slope steepness or more up to z = 0, and from there 1 - z falling at
/// least as exp(-steepness x), two courses of the same equation differ at the end by order * exp(1 -
/// steepness) of what they did at the start.
static void test_ends_and_start(void)
{
    const element_record_t record = calibrate(element_plant_bouc_wen);
    double rmse;
    const element_t element = element_fit(ELEMENT_BOUC_WEN, &record, &rmse);
    const double beyond[] = {30, 70, 90, 60};
    double from_ends[4];
    double shifted[4];
    element_run(&element, 0, beyond, 4, from_ends);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, from_ends[1], from_ends[2]);
    const double shift = 0.2 * element.gain;
    element_run(&element, shift, beyond, 4, shifted);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, from_ends[0] + shift, shifted[0]);
    const double fading = element.shape[BOUC_WEN_ORDER] * exp(1 - element.shape[BOUC_WEN_STEEPNESS]);
    TEST_ASSERT_DOUBLE_WITHIN(fading * fabs(shift), from_ends[3], shifted[3]);
    // Beyond what it can reach it starts from as near as it gets, and then goes on.
    element_run(&element, 100 * element.gain, beyond, 4, shifted);
    TEST_ASSERT_TRUE(isfinite(shifted[3]));
    TEST_ASSERT_DOUBLE_WITHIN(3 * fabs(element.gain), from_ends[3], shifted[3]);
}

/// Beyond the range an element is the same equation: one whose range is twice as wide, its numbers in that
/// range's parts, moves alike (steps below a hundredth of either range are one step in both); and the curve
/// goes on straight, as steep as its last two splines on the whole.
static void test_it_goes_on_beyond_its_range(void)
{
    const element_record_t record = calibrate(element_plant_bouc_wen);
    double rmse;
    const element_t element = element_fit(ELEMENT_BOUC_WEN, &record, &rmse);
    element_t wide = element;
    wide.input_min = 30;
    wide.input_max = 70;
    wide.shape[BOUC_WEN_STEEPNESS] *= 2;
    element_state_t narrow_state = element_saturated(&element);
    element_state_t wide_state = element_saturated(&wide);
    wide_state.inner = element_step(&narrow_state, 30);
    for (int i = 1; i <= 800; i++) {
        const double x = i <= 400 ? 30 + 0.1 * i : 110 - 0.1 * i;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, element_step(&wide_state, x), element_step(&narrow_state, x));
    }
    const double end = element_nonhysteretic(&element, 60);
    const double slope = (end - element_nonhysteretic(&element, 60 - 20 * 2.0 / 12)) / (20 * 2.0 / 12);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, end + 7 * slope, element_nonhysteretic(&element, 67));
}

static void test_bounded_numbers_come_back(void)
{
    const bounds_t linear = {-2, 3, false};
    const bounds_t logarithmic = {0.01, 100, true};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.7, bounded_from_free(linear, bounded_to_free(linear, 0.7)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.7, bounded_from_free(logarithmic, bounded_to_free(logarithmic, 0.7)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3, bounded_from_free(linear, asin(1)));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -2, bounded_from_free(linear, bounded_to_free(linear, -9)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_bouc_wen_element_is_found);
    RUN_TEST(test_a_jiles_atherton_element_is_found);
    RUN_TEST(test_derivatives_are_those_of_the_output);
    RUN_TEST(test_moments_of_a_step_are_found);
    RUN_TEST(test_a_bouc_wen_step_has_one_moment);
    RUN_TEST(test_ends_and_start);
    RUN_TEST(test_it_goes_on_beyond_its_range);
    RUN_TEST(test_bounded_numbers_come_back);
    return UNITY_END();
}
