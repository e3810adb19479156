#include "identify.h"
#include "identify_samples.h"
#include "random.h"
#include "reference.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 3000, PLAYS = 20 };

static double input[SAMPLES];
static double output[SAMPLES];
static double predicted[SAMPLES];
static model_t truth;
static identify_result_t result;
static bool has_result;

void setUp(void)
{
    truth = model_new("truth");
    has_result = false;
}

void tearDown(void)
{
    model_free(&truth);
    if (has_result) {
        identify_result_free(&result);
    }
}

/// Radii on the identification's own grid, so that the truth lies in the family that is searched and the
/// least squares have their minimum, 0, at the truth.
static void set_plays(size_t first)
{
    const double largest = model_largest_moving_radius(&truth);
    model_set_num_plays(&truth, PLAYS);
    for (size_t j = 0; j < PLAYS; j++) {
        const double part = (double)(j + first) / (double)(PLAYS + first);
        truth.radius[j] = part * largest;
        truth.weight[j] = (0.2 + exp(-3 * part)) / (largest * PLAYS);
    }
}

/// Classical PI over -3 ... 5.
static void make_classical(void)
{
    truth.input_min = -3;
    truth.input_max = 5;
    curve_free(&truth.nonhysteretic);
    truth.nonhysteretic = curve_linear(0.4, 7);
    set_plays(1);
}

/// The envelopes and non-hysteretic part of the VO2 film (Zhang et al. 2015, Table 6); weights ours.
static void make_vo2(void)
{
    truth.input_min = 30;
    truth.input_max = 90;
    curve_free(&truth.ascending);
    curve_free(&truth.descending);
    curve_free(&truth.nonhysteretic);
    truth.ascending = curve_tanh(0.16, -10.26);
    truth.descending = curve_tanh(0.201, -11.58);
    truth.nonhysteretic = curve_tanh(0.03, -1.61);
    curve_add(&truth.nonhysteretic, -3.26);
    set_plays(0);
}

/// Loops of shrinking size from the lower end of the range, then back to full size.
static double shrinking(size_t t)
{
    const double cycles = 9.0 * (double)t / SAMPLES;
    const double whole = floor(cycles);
    const double amplitude = whole > 7 ? 1 : 1 - whole / 9;
    const double middle = 0.3 * sin(2.1 * whole);
    const double swing = -cos(2 * acos(-1) * cycles);
    return amplitude * swing + (1 - amplitude) * middle;
}

/// Loops that grow from nothing in the middle of the range.
static double growing(size_t t)
{
    const double part = (double)t / SAMPLES;
    return part * sin(2 * acos(-1) * 12 * part);
}

/// Full loops from the middle of the range.
static double full(size_t t)
{
    return sin(2 * acos(-1) * 9 * (double)t / SAMPLES);
}

/// A walk between random reversals that the fit has not seen.
static void make_unseen(double* values, uint64_t seed)
{
    random_t random = random_new(seed);
    double from = -1;
    double to = 1;
    for (size_t t = 0; t < SAMPLES; t++) {
        const size_t within = t % 60;
        if (within == 0) {
            from = to;
            to = random_uniform(&random, -1, 1);
        }
        values[t] = from + (to - from) * (double)within / 60;
    }
}

static void scale_input(void)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        input[t] =
            0.5 * (truth.input_min + truth.input_max) + 0.5 * (truth.input_max - truth.input_min) * input[t];
    }
}

static void make_record(double (*shape)(size_t), start_t start, double noise)
{
    random_t random = random_new(99);
    for (size_t t = 0; t < SAMPLES; t++) {
        input[t] = shape(t);
    }
    scale_input();
    reference_run(&truth, start, input, SAMPLES, output);
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] += noise * random_normal(&random);
    }
}

static char path[] = "made.csv";
static bool carried[SAMPLES];
static const record_t record = {.path = path, .num_samples = SAMPLES, .input = input, .output = output};

static void run_identify(identify_envelope_t envelope)
{
    const identify_options_t options = {.num_plays = PLAYS, .envelope = envelope};
    TEST_ASSERT_EQUAL(OUTCOME_OK, identify(&record, &options, &result));
    has_result = true;
    TEST_ASSERT_NULL(model_check(&result.model).key);
    TEST_ASSERT_TRUE(isfinite(result.rmse));
}

/// RMSE of the identified model against the noise-free truth on an input neither fit nor noise has seen,
/// relative to the truth's range.
static double unseen_error(void)
{
    double* clean = xmalloc(sizeof output);
    make_unseen(input, 4);
    scale_input();
    reference_run(&truth, START_NEGATIVE_SATURATION, input, SAMPLES, clean);
    reference_run(&result.model, START_NEGATIVE_SATURATION, input, SAMPLES, predicted);
    double sum = 0;
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (size_t t = 0; t < SAMPLES; t++) {
        sum += (predicted[t] - clean[t]) * (predicted[t] - clean[t]);
        low = fmin(low, clean[t]);
        high = fmax(high, clean[t]);
    }
    free(clean);
    return sqrt(sum / SAMPLES) / (high - low);
}

/// Moving every weight to the next radius of the grid is the coarsest the family resolves: THEORY section 2
/// bounds what that changes by sum p times the grid's step. A recovered model is no further off than that, on
/// any input.
static double grid_bound(void)
{
    double weight = 0;
    for (size_t j = 0; j < PLAYS; j++) {
        weight += truth.weight[j];
    }
    const double range = curve_value(&truth.nonhysteretic, truth.input_max) -
                         curve_value(&truth.nonhysteretic, truth.input_min) +
                         2 * weight * model_largest_moving_radius(&truth);
    return weight * (truth.radius[1] - truth.radius[0]) / range;
}

static void test_classical_model_is_recovered(void)
{
    make_classical();
    make_record(shrinking, START_NEGATIVE_SATURATION, 0);
    run_identify(IDENTIFY_AUTO);
    TEST_ASSERT_EQUAL(CURVE_LINEAR, result.model.ascending.type);
    TEST_ASSERT_EQUAL(CURVE_LINEAR, result.model.nonhysteretic.type);
    // The truth is in the family and nothing but the regularisation (1e-3, squared) moves the minimum off it.
    TEST_ASSERT_TRUE(result.relative < 1e-4);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * 0.4, 0.4, curve_slope(&result.model.nonhysteretic, 0));
    TEST_ASSERT_TRUE(unseen_error() < 1e-3);
}

static void test_vo2_curves_are_recovered(void)
{
    make_vo2();
    make_record(shrinking, START_NEGATIVE_SATURATION, 0);
    run_identify(IDENTIFY_TANH);
    TEST_ASSERT_EQUAL(CURVE_TANH, result.model.ascending.type);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * 0.16, 0.16, result.model.ascending.slope);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * 10.26, -10.26, result.model.ascending.shift);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * 0.201, 0.201, result.model.descending.slope);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * 11.58, -11.58, result.model.descending.shift);
    TEST_ASSERT_TRUE(unseen_error() < grid_bound());
}

static void test_auto_keeps_to_the_noise(void)
{
    make_vo2();
    const double noise = 0.005;
    make_record(shrinking, START_NEGATIVE_SATURATION, noise);
    run_identify(IDENTIFY_AUTO);
    // About 25 free numbers on 3000 samples: the residual's expected RMS is the noise's, to 1 %; 5 sigma of
    // it is 6 %.
    TEST_ASSERT_TRUE(result.rmse < 1.07 * noise);
    TEST_ASSERT_TRUE(unseen_error() < grid_bound());
}

/// Envelopes of any steepness and place: what comes out must keep every condition of a model, above all the
/// order of the envelopes, which is tightest somewhere between the samples.
static void test_result_is_always_a_valid_model(void)
{
    random_t random = random_new(31);
    for (int round = 0; round < 6; round++) {
        make_vo2();
        const double slope = random_uniform(&random, 0.05, 0.4);
        truth.ascending = curve_tanh(slope, -slope * random_uniform(&random, 55, 70));
        truth.descending = curve_tanh(random_uniform(&random, 0.5, 2) * slope, -slope * 55);
        const double least = model_least_radius(&truth);
        const double largest = model_largest_moving_radius(&truth);
        for (size_t j = 0; j < PLAYS; j++) {
            truth.radius[j] = least + (double)j / PLAYS * fmax(largest - least, 0);
        }
        make_record(shrinking, START_NEGATIVE_SATURATION, 0.01);
        run_identify(round % 2 == 0 ? IDENTIFY_AUTO : IDENTIFY_TANH);
        identify_result_free(&result);
        model_free(&truth);
        has_result = false;
        truth = model_new("truth");
    }
}

static void test_table_family_follows_a_tanh_truth(void)
{
    make_vo2();
    make_record(shrinking, START_NEGATIVE_SATURATION, 0);
    run_identify(IDENTIFY_TABLE);
    TEST_ASSERT_EQUAL(CURVE_TABLE, result.model.ascending.type);
    TEST_ASSERT_TRUE(result.relative < 0.008);
}

/// A memory that is neither saturation: what it was must not bend the fit.
static void test_foreign_past_is_left_out(void)
{
    make_classical();
    make_record(full, START_DEMAGNETISED, 0);
    run_identify(IDENTIFY_AUTO);
    TEST_ASSERT_EQUAL(MEMORY_LEFT_OUT, result.memory);
    // Both ends of the range are visited after three quarters of the first of nine cycles, less the ends' 2
    // %.
    TEST_ASSERT_INT_WITHIN(SAMPLES / 9 / 20, SAMPLES / 12, result.first_fitted);
    TEST_ASSERT_TRUE(result.relative < 1e-4);
}

/// A first half loop four times as noisy as the rest says nothing against the saturation it began in.
static void test_what_no_past_explains_leaves_the_saturation(void)
{
    make_classical();
    make_record(shrinking, START_NEGATIVE_SATURATION, 0.002);
    random_t random = random_new(100);
    for (size_t t = 0; t < SAMPLES / 18; t++) {
        output[t] += 0.008 * random_normal(&random);
    }
    run_identify(IDENTIFY_LINEAR);
    TEST_ASSERT_EQUAL(MEMORY_ASSUMED, result.memory);
    TEST_ASSERT_EQUAL(START_NEGATIVE_SATURATION, result.start);
    TEST_ASSERT_EQUAL(0, result.first_fitted);
}

/// The memory is wiped out only at the very end: it must be estimated, not left out.
static void test_growing_loops_estimate_the_start(void)
{
    make_classical();
    make_record(growing, START_DEMAGNETISED, 0);
    run_identify(IDENTIFY_AUTO);
    TEST_ASSERT_EQUAL(MEMORY_ESTIMATED, result.memory);
    TEST_ASSERT_EQUAL(0, result.first_fitted);
    TEST_ASSERT_NOT_NULL(result.model.initial);
    TEST_ASSERT_TRUE(result.relative < grid_bound());
    TEST_ASSERT_TRUE(unseen_error() < 2 * grid_bound());
}

static void test_plays_beyond_the_excitation_are_undetermined(void)
{
    make_classical();
    make_record(shrinking, START_NEGATIVE_SATURATION, 0);
    // Twice the record's range: the outer half of the radii never moves.
    const identify_options_t options = {
        .num_plays = PLAYS, .envelope = IDENTIFY_LINEAR, .has_range = true, .input_min = -7, .input_max = 9};
    TEST_ASSERT_EQUAL(OUTCOME_OK, identify(&record, &options, &result));
    has_result = true;
    size_t undetermined = 0;
    for (size_t j = 0; j < PLAYS; j++) {
        const bool never_moves = result.model.radius[j] >= 4 * (1 + 1e-9);
        undetermined += never_moves;
        TEST_ASSERT_EQUAL(never_moves, result.undetermined[j]);
        TEST_ASSERT_TRUE(!never_moves || result.model.weight[j] <= 0);
    }
    TEST_ASSERT_EQUAL(undetermined, result.num_undetermined);
    TEST_ASSERT_TRUE(undetermined >= PLAYS / 2 - 1);
}

static void test_clockwise_loop_is_recognised(void)
{
    make_classical();
    make_record(shrinking, START_NEGATIVE_SATURATION, 0);
    // Just steep enough to rise: the ascending branch now lies above.
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] = 0.7 * input[t] - output[t];
    }
    run_identify(IDENTIFY_AUTO);
    TEST_ASSERT_TRUE(result.clockwise);
}

/// Rising 1, 3, 2, 4: the best non-decreasing fit is 1, 2.5, 2.5, 4, squared error 0.5. Falling on 3, 1, 2:
/// best non-increasing 3, 1.5, 1.5, another 0.5.
static void test_monotone_floor_is_the_isotonic_regression(void)
{
    static double up_and_down[] = {0, 1, 2, 3, 2, 1, 0};
    static double values[] = {1, 3, 2, 4, 3, 1, 2};
    record_t all = {.num_samples = 4, .input = up_and_down, .output = values};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(0.5 / 4), monotone_floor(&all, 0));
    all.num_samples = 7;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(1.0 / 7), monotone_floor(&all, 0));
}

/// The top and its output are made up: what is left rises and falls, and the turn is where the inputs have
/// it.
static void test_monotone_floor_is_that_of_measured_samples(void)
{
    static double up_and_down[] = {0, 1, 2, 3, 1, 0};
    static double values[] = {1, 2, 3, 0, 2.5, 1};
    static bool made_up[] = {false, false, false, true, false, false};
    const record_t filled = {.num_samples = 6, .input = up_and_down, .output = values, .carried = made_up};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0, monotone_floor(&filled, 0));
}

static void test_a_model_of_the_kind_is_above_its_floor(void)
{
    make_classical();
    make_record(shrinking, START_NEGATIVE_SATURATION, 0.01);
    run_identify(IDENTIFY_AUTO);
    TEST_ASSERT_TRUE(result.monotone_floor > 0);
    TEST_ASSERT_TRUE(result.rmse >= result.monotone_floor);
}

/// Whatever stands at samples that are carried, the model is that of the others; the inputs there count.
static void test_what_is_carried_is_not_fitted(void)
{
    make_classical();
    make_record(shrinking, START_NEGATIVE_SATURATION, 0);
    for (size_t t = 0; t < SAMPLES; t++) {
        carried[t] = t % 31 == 7;
        output[t] = carried[t] ? output[SAMPLES / 2] : output[t];
    }
    record_t filled = record;
    filled.carried = carried;
    const identify_options_t options = {.num_plays = PLAYS, .envelope = IDENTIFY_LINEAR};
    TEST_ASSERT_EQUAL(OUTCOME_OK, identify(&filled, &options, &result));
    has_result = true;
    // As in test_classical_model_is_recovered.
    TEST_ASSERT_TRUE(result.relative < 1e-4);
    TEST_ASSERT_EQUAL(SAMPLES - SAMPLES / 31 - (SAMPLES % 31 > 7), result.num_samples);
}

/// Ramps of 60 samples; two in a row of every ten are put back, wherever they lie in the thinned blocks. Of
/// each block of b samples of a ramp at least 0.8 b were measured, and of those two are kept.
static void test_thinning_keeps_measured_samples(void)
{
    enum { LONG = 60000, MOST = 2000 };
    record_t filled = {.num_samples = LONG,
                       .input = xmalloc(LONG * sizeof(double)),
                       .output = xcalloc(LONG, sizeof(double)),
                       .carried = xmalloc(LONG * sizeof(bool))};
    for (size_t place = 0; place < 10; place++) {
        for (size_t t = 0; t < LONG; t++) {
            filled.input[t] = (double)(t % 120 < 60 ? t % 60 : 60 - t % 60) / 60;
            filled.carried[t] = t % 10 == place || t % 10 == (place + 1) % 10;
        }
        samples_t samples = samples_new(&filled, 0.5, 0.5, MOST);
        size_t used = 0;
        for (size_t i = 0; i < samples.num_samples; i++) {
            used += samples.used[i];
            TEST_ASSERT_EQUAL(!filled.carried[samples.index[i]], samples.used[i]);
            TEST_ASSERT_TRUE(i == 0 || samples.index[i] > samples.index[i - 1]);
        }
        TEST_ASSERT_EQUAL(MOST, used);
        samples_free(&samples);
    }
    record_free(&filled);
}

static void test_records_without_information_are_refused(void)
{
    const record_t turned = {.path = path, .num_samples = SAMPLES, .input = output, .output = input};
    const record_t few = {.path = path, .num_samples = 5, .input = output, .output = output};
    const record_t same = {.path = path, .num_samples = SAMPLES, .input = output, .output = output};
    const identify_options_t options = {.num_plays = PLAYS};
    for (size_t t = 0; t < SAMPLES; t++) {
        input[t] = 1;
        output[t] = (double)t;
    }
    TEST_ASSERT_EQUAL(OUTCOME_BAD_INPUT, identify(&record, &options, &result));
    TEST_ASSERT_EQUAL(OUTCOME_BAD_INPUT, identify(&turned, &options, &result));
    TEST_ASSERT_EQUAL(OUTCOME_BAD_INPUT, identify(&few, &options, &result));
    const identify_options_t narrow = {
        .num_plays = PLAYS, .has_range = true, .input_min = 0, .input_max = 10};
    TEST_ASSERT_EQUAL(OUTCOME_BAD_INPUT, identify(&same, &narrow, &result));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_classical_model_is_recovered);
    RUN_TEST(test_vo2_curves_are_recovered);
    RUN_TEST(test_auto_keeps_to_the_noise);
    RUN_TEST(test_result_is_always_a_valid_model);
    RUN_TEST(test_table_family_follows_a_tanh_truth);
    RUN_TEST(test_foreign_past_is_left_out);
    RUN_TEST(test_what_no_past_explains_leaves_the_saturation);
    RUN_TEST(test_growing_loops_estimate_the_start);
    RUN_TEST(test_plays_beyond_the_excitation_are_undetermined);
    RUN_TEST(test_clockwise_loop_is_recognised);
    RUN_TEST(test_monotone_floor_is_the_isotonic_regression);
    RUN_TEST(test_monotone_floor_is_that_of_measured_samples);
    RUN_TEST(test_thinning_keeps_measured_samples);
    RUN_TEST(test_a_model_of_the_kind_is_above_its_floor);
    RUN_TEST(test_what_is_carried_is_not_fitted);
    RUN_TEST(test_records_without_information_are_refused);
    return UNITY_END();
}
