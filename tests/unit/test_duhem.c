#include "duhem_fit.h"
#include "random.h"
#include "reference.h"
#include "series.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 3000, PLAYS = 10 };

static model_t model;
static double input[SAMPLES];
static double output[SAMPLES];
static double predicted[SAMPLES];
static double* precision;
static const double noise = 0.002;

/// A PI model with a loop like the element's below.
void setUp(void)
{
    model = model_new("plant");
    curve_free(&model.nonhysteretic);
    model.nonhysteretic = curve_linear(0.3, 0);
    model_set_num_plays(&model, PLAYS);
    for (size_t j = 0; j < PLAYS; j++) {
        model.radius[j] = 0.04 * (double)j;
        model.weight[j] = 0.07;
    }
    precision = xcalloc((size_t)DUHEM_FREE * DUHEM_FREE, sizeof *precision);
}

void tearDown(void)
{
    free(precision);
    model_free(&model);
}

static void make_input(uint64_t seed)
{
    random_t random = random_new(seed);
    double v = 0;
    double target = 1;
    size_t turns = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        input[t] = v;
        v += fmin(fmax(target - v, -0.01), 0.01);
        if (fabs(target - v) <= 0) {
            turns++;
            target = turns == 1 ? 0 : turns == 2 ? 1 : random_uniform(&random, 0, 1);
        }
    }
}

/// A Bouc-Wen element, z' = u' (6 - |z| (5 sign(u' z) + 1)), output u - z / 8, in 50 steps a sample.
static void run_element(void)
{
    double z = 0;
    double v = 0;
    // Down to where the branch no longer depends on the start, then to the range's foot.
    for (size_t k = 0; k < 200000; k++) {
        const double move = k < 100000 ? 1e-4 : -1e-4;
        z += move * (6 - fabs(z) * (5 * (move * z > 0 ? 1 : -1) + 1));
        v += move;
    }
    v = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        const double move = (input[t] - v) / 50;
        for (size_t k = 0; k < 50; k++) {
            z += move * (6 - fabs(z) * (5 * (move * z > 0 ? 1 : -1) + 1));
        }
        v = input[t];
        output[t] = v - z / 8;
    }
}

static record_t bench = {.num_samples = SAMPLES, .input = input, .output = output};

static duhem_t calibrate(double* rmse)
{
    random_t random = random_new(9);
    make_input(1);
    run_element();
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] += noise * random_normal(&random);
    }
    return duhem_fit(&model, START_NEGATIVE_SATURATION, &bench, noise, rmse, precision);
}

/// What is asked of a body that stands in for the plays: beside the noise it leaves at most half a per cent
/// of the output's range of a calibration of its kind (the grid is linear between nodes), and of an input
/// that it has not seen less than half of what the model leaves.
static void test_an_element_is_found_and_predicted(void)
{
    double rmse;
    const duhem_t duhem = calibrate(&rmse);
    TEST_ASSERT_TRUE(rmse < hypot(noise, 0.005));
    make_input(2);
    run_element();
    duhem_run(&duhem, &model, START_NEGATIVE_SATURATION, 0, input, SAMPLES, predicted);
    const double duhem_error = sqrt(series_mean_square(predicted, output, SAMPLES));
    reference_run(&model, START_NEGATIVE_SATURATION, input, SAMPLES, predicted);
    TEST_ASSERT_TRUE(duhem_error < 0.5 * sqrt(series_mean_square(predicted, output, SAMPLES)));
}

/// What stands at samples that are carried is no matter; their inputs are.
static void test_what_is_carried_is_not_fitted(void)
{
    static bool carried[SAMPLES];
    double rmse;
    (void)calibrate(&rmse);
    for (size_t t = 0; t < SAMPLES; t++) {
        carried[t] = t % 31 == 7;
        output[t] = carried[t] ? output[0] : output[t];
    }
    bench.carried = carried;
    (void)duhem_fit(&model, START_NEGATIVE_SATURATION, &bench, noise, &rmse, precision);
    bench.carried = NULL;
    TEST_ASSERT_TRUE(rmse < hypot(noise, 0.005));
}

/// The derivatives that the fit and the nuisance rest on, against differences. A step of the midpoint rule
/// leaves out the change of the slope half way, second order in a move of at most 0.01: of each derivative at
/// most a part of sum |move| * 0.01 * (slope change)^2 / 2, a few hundredths for the slopes here.
static void test_derivatives_are_those_of_the_output(void)
{
    double rmse;
    const duhem_t duhem = calibrate(&rmse);
    double derivative[DUHEM_FREE];
    duhem_state_t s = duhem_start(&duhem, &model, START_NEGATIVE_SATURATION, input[0], derivative);
    for (size_t t = 0; t < SAMPLES / 2; t++) {
        (void)duhem_step(&s, input[t]);
    }
    double largest = 0;
    for (size_t k = 0; k < DUHEM_FREE; k++) {
        largest = fmax(largest, fabs(derivative[k]));
    }
    for (size_t k = 0; k < DUHEM_FREE; k += 7) {
        double both[2];
        for (int side = 0; side < 2; side++) {
            duhem_t moved = duhem;
            double* number =
                k == DUHEM_FREE - 1 ? &moved.saturated : &moved.slope[k / DUHEM_NODES][k % DUHEM_NODES];
            *number += side == 0 ? -1e-5 : 1e-5;
            duhem_run(&moved, &model, START_NEGATIVE_SATURATION, 0, input, SAMPLES / 2, predicted);
            both[side] = predicted[SAMPLES / 2 - 1];
        }
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * largest, (both[1] - both[0]) / 2e-5, derivative[k]);
    }
}

/// Out of range it stays at the ends; a shift of the start moves the first output by as much.
static void test_ends_and_start(void)
{
    const duhem_t duhem = duhem_new(&model);
    const double beyond[] = {-1, 2, 1, 1};
    double from_ends[4];
    duhem_run(&duhem, &model, START_NEGATIVE_SATURATION, 0, beyond, 4, from_ends);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, duhem.saturated, from_ends[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, from_ends[1], from_ends[2]);
    double shifted[4];
    duhem_run(&duhem, &model, START_NEGATIVE_SATURATION, 0.1, beyond, 4, shifted);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, from_ends[0] + 0.1, shifted[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_element_is_found_and_predicted);
    RUN_TEST(test_what_is_carried_is_not_fitted);
    RUN_TEST(test_derivatives_are_those_of_the_output);
    RUN_TEST(test_ends_and_start);
    return UNITY_END();
}
