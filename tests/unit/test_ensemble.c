#include "compress.h"
#include "ensemble.h"
#include "ensemble_gram.h"
#include "paper_study_cases.h"
#include "reference.h"
#include "unity.h"
#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { SMALL = 6 };

void setUp(void)
{
}

void tearDown(void)
{
}

static play_set_t moving_plays(const model_t* model)
{
    play_set_t plays = {model->radius, model->weight, 0};
    while (plays.num_plays < model->num_plays &&
           model->radius[plays.num_plays] < model_largest_moving_radius(model)) {
        ++plays.num_plays;
    }
    return plays;
}

static ensemble_plays_t found_for(const model_t* model, size_t num_plays)
{
    const play_set_t plays = moving_plays(model);
    ensemble_plays_t found;
    TEST_ASSERT_EQUAL_INT(OUTCOME_OK, ensemble_find(model, &plays, num_plays, &found));
    return found;
}

/// The states that the search sees are the reference's, scaled.
static void states_are_the_references(void)
{
    random_t random = random_new(11);
    for (int which = 0; which < NUM_CASES; ++which) {
        model_t model = study_model((study_case_t)which, 1);
        study_input_t input = study_random_input(&random, &model);
        drive_t drive = drive_of(&model, input.input, input.num_samples);
        double* state = xcalloc(input.num_samples, sizeof(double));
        const play_set_t plays = moving_plays(&model);
        for (size_t j = 0; j < plays.num_plays; ++j) {
            drive_states(&drive, model.radius[j] / drive.unit, state, NULL);
            reference_t reference = reference_new(&model, START_NEGATIVE_SATURATION, input.input[0]);
            for (size_t t = 0; t < input.num_samples; ++t) {
                reference_step(&reference, input.input[t]);
                // Envelopes, radii and their differences are below 2: a few roundings of 2 u on either side.
                TEST_ASSERT_DOUBLE_WITHIN(20.0 * DBL_EPSILON, reference.memory[j],
                                          drive.level + model.radius[j] + drive.unit * state[t]);
            }
            reference_free(&reference);
        }
        free(state);
        drive_free(&drive);
        study_input_free(&input);
        model_free(&model);
    }
}

/// Adds factor * sum of weight * state, counted from negative saturation, over the ensemble.
static void add_output(const drive_t* drive, const play_set_t* plays, double factor, double* output)
{
    double* state = xcalloc(drive->num_samples, sizeof(double));
    for (size_t j = 0; j < plays->num_plays; ++j) {
        drive_states(drive, plays->radius[j] / drive->unit, state, NULL);
        for (size_t t = 0; t < drive->num_samples; ++t) {
            output[t] += factor * plays->weight[j] * drive->unit * state[t];
        }
    }
    free(state);
}

/// The mean square over the ensemble of what the plays found leave, with weight k changed by `change`.
static double mean_square(const model_t* model, const ensemble_plays_t* found, size_t k, double change,
                          double* mean)
{
    drive_t drive = drive_new(model);
    double* error = xcalloc(drive.num_samples, sizeof(double));
    const play_set_t plays = moving_plays(model);
    found->weight[k] += change;
    const play_set_t small = {found->radius, found->weight, found->num_plays};
    add_output(&drive, &plays, 1.0, error);
    add_output(&drive, &small, -1.0, error);
    found->weight[k] -= change;
    double sum = 0.0;
    double squares = 0.0;
    for (size_t t = 0; t < drive.num_samples; ++t) {
        sum += error[t] + found->constant;
        squares += (error[t] + found->constant) * (error[t] + found->constant);
    }
    *mean = sum / (double)drive.num_samples;
    squares /= (double)drive.num_samples;
    free(error);
    drive_free(&drive);
    return squares;
}

/// Constant and weights solve a linear least-squares problem: no mean is left, the error is the one stated,
/// and no weight can be changed for the better. Outputs are below 200, so that 20,000 sums of 40 terms leave
/// less than 20000 * 200 * eps in a mean.
static void weights_and_constant_are_optimal(void)
{
    const double rounding = 20000.0 * 200.0 * DBL_EPSILON;
    for (int which = 0; which < NUM_CASES; ++which) {
        model_t model = study_model((study_case_t)which, 2);
        ensemble_plays_t found = found_for(&model, SMALL);
        double mean;
        const double least = mean_square(&model, &found, 0, 0.0, &mean);
        TEST_ASSERT_DOUBLE_WITHIN(rounding, 0.0, mean);
        TEST_ASSERT_DOUBLE_WITHIN(rounding, found.rms, sqrt(least));
        for (size_t k = 0; k < SMALL; ++k) {
            TEST_ASSERT_TRUE(found.weight[k] >= 0.0);
            const double change = 1e-3 * found.weight[k];
            double moved;
            // With the constant re-fitted: the variance.
            const double up = mean_square(&model, &found, k, change, &moved) - moved * moved;
            TEST_ASSERT_TRUE(up >= least - rounding * found.rms);
            const double down = mean_square(&model, &found, k, -change, &moved) - moved * moved;
            TEST_ASSERT_TRUE(down >= least - rounding * found.rms);
        }
        ensemble_plays_free(&found);
        model_free(&model);
    }
}

/// Where only as many plays have weight as are kept, they are found again: each is a group of the start.
static void plays_that_are_there_are_found(void)
{
    random_t random = random_new(12);
    for (int trial = 0; trial < 5; ++trial) {
        model_t model = study_model(trial % 2 == 0 ? CASE_VO2 : CASE_UNIFORM, 1);
        memset(model.weight, 0, model.num_plays * sizeof(double));
        for (size_t k = 0; k < SMALL; ++k) {
            model.weight[4 * k + random_below(&random, 4)] = random_uniform(&random, 0.1, 2.0);
        }
        ensemble_plays_t found = found_for(&model, SMALL);
        // Six states below 2, weights below 2: rounding of their sum, and of least squares with a condition
        // number below 1e3.
        TEST_ASSERT_TRUE(found.rms <= 24.0 * 1e3 * DBL_EPSILON);
        ensemble_plays_free(&found);
        model_free(&model);
    }
}

static model_t compressed(const model_t* model, partition_cost_t cost)
{
    const compress_options_t options = {.num_plays = SMALL, .cost = cost};
    compression_t compression;
    model_t small = compress_model(model, &options, &compression);
    compression_free(&compression);
    return small;
}

/// The RMSE of `ensemble` over inputs it has not seen, against that of entropy-sum, both with the constant
/// that suits these inputs best; for random weights over ten draws of them.
static double ratio_to_entropy_sum(study_case_t which)
{
    double ensemble = 0.0;
    double entropy = 0.0;
    for (uint64_t seed = 1; seed <= (which == CASE_RANDOM ? 10U : 1U); ++seed) {
        model_t model = study_model(which, seed);
        model_t grouped = compressed(&model, COST_ENTROPY_SUM);
        model_t best = compressed(&model, COST_ENSEMBLE);
        entropy += study_random_errors(&model, &grouped, 1000 + seed, 50).refitted;
        ensemble += study_random_errors(&model, &best, 1000 + seed, 50).refitted;
        model_free(&best);
        model_free(&grouped);
        model_free(&model);
    }
    return ensemble / entropy;
}

static void unseen_inputs_meet_the_specification(void)
{
    TEST_ASSERT_TRUE(ratio_to_entropy_sum(CASE_UNIFORM) <= 0.6);
    TEST_ASSERT_TRUE(ratio_to_entropy_sum(CASE_RANDOM) <= 0.6);
    TEST_ASSERT_TRUE(ratio_to_entropy_sum(CASE_ONE_PEAK) <= 0.85);
    TEST_ASSERT_TRUE(ratio_to_entropy_sum(CASE_TWO_PEAKS) <= 0.85);
}

static void no_other_cost_has_a_smaller_error(void)
{
    for (int which = 0; which < NUM_CASES; ++which) {
        model_t model = study_model((study_case_t)which, 3);
        model_t best = compressed(&model, COST_ENSEMBLE);
        const double least = study_random_errors(&model, &best, 2000, 50).refitted;
        for (int cost = COST_ENTROPY_SUM; cost < COST_ENSEMBLE; ++cost) {
            model_t other = compressed(&model, (partition_cost_t)cost);
            TEST_ASSERT_TRUE(least < study_random_errors(&model, &other, 2000, 50).refitted);
            model_free(&other);
        }
        model_free(&best);
        model_free(&model);
    }
}

static void error_bound_holds(void)
{
    for (uint64_t seed = 1; seed <= 6; ++seed) {
        model_t model = study_model(seed % 2 == 0 ? CASE_VO2 : CASE_RANDOM, seed);
        const compress_options_t options = {.num_plays = (size_t)seed, .cost = COST_ENSEMBLE};
        compression_t compression;
        model_t small = compress_model(&model, &options, &compression);
        TEST_ASSERT_NULL(model_check(&small).key);
        TEST_ASSERT_EQUAL_UINT64(seed, small.num_plays);
        random_t random = random_new(seed);
        for (int i = 0; i < 50; ++i) {
            study_input_t input = study_random_input(&random, &model);
            // 60 terms below 4 on either side.
            TEST_ASSERT_TRUE(study_error(&model, &small, &input).largest <=
                             compression.error_bound + 60.0 * 60.0 * 4.0 * DBL_EPSILON);
            study_input_free(&input);
        }
        compression_free(&compression);
        model_free(&small);
        model_free(&model);
    }
}

/// The plays' groups: each play is in that of the nearest radius.
static void partition_is_that_of_the_nearest_radii(void)
{
    model_t model = study_model(CASE_TWO_PEAKS, 1);
    const compress_options_t options = {.num_plays = SMALL, .cost = COST_ENSEMBLE};
    compression_t compression;
    model_t small = compress_model(&model, &options, &compression);
    const size_t* beta = compression.partition.beta;
    TEST_ASSERT_EQUAL_UINT64(SMALL, compression.partition.num_groups);
    TEST_ASSERT_EQUAL_UINT64(0, beta[0]);
    TEST_ASSERT_EQUAL_UINT64(STUDY_PLAYS, beta[SMALL]);
    for (size_t k = 0; k < SMALL; ++k) {
        for (size_t j = beta[k]; j < beta[k + 1]; ++j) {
            for (size_t other = 0; other < SMALL; ++other) {
                TEST_ASSERT_TRUE(fabs(model.radius[j] - small.radius[k]) <=
                                 fabs(model.radius[j] - small.radius[other]));
            }
        }
    }
    compression_free(&compression);
    model_free(&small);
    model_free(&model);
}

static void assert_same(const ensemble_plays_t* expected, const ensemble_plays_t* found, double radius_unit,
                        double weight_unit, double within)
{
    TEST_ASSERT_EQUAL_UINT64(expected->num_plays, found->num_plays);
    for (size_t k = 0; k < expected->num_plays; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(within, expected->radius[k], found->radius[k] / radius_unit);
        TEST_ASSERT_DOUBLE_WITHIN(within, expected->weight[k], found->weight[k] / weight_unit);
    }
}

static void same_model_gives_the_same_plays(void)
{
    model_t model = study_model(CASE_RANDOM, 5);
    ensemble_plays_t first = found_for(&model, SMALL);
    ensemble_plays_t second = found_for(&model, SMALL);
    assert_same(&first, &second, 1.0, 1.0, 0.0);
    ensemble_plays_free(&first);
    ensemble_plays_free(&second);
    model_free(&model);
}

/// Units do not matter: powers of two scale without rounding, so that every step of the search is the same.
static void units_do_not_matter(void)
{
    model_t model = study_model(CASE_TWO_PEAKS, 1);
    ensemble_plays_t plain = found_for(&model, 4);
    const double radius_unit = 0x1p-300;
    const double weight_unit = 0x1p+600;
    curve_scale(&model.ascending, radius_unit);
    curve_scale(&model.descending, radius_unit);
    for (size_t j = 0; j < model.num_plays; ++j) {
        model.radius[j] *= radius_unit;
        model.weight[j] *= weight_unit;
    }
    ensemble_plays_t scaled = found_for(&model, 4);
    assert_same(&plain, &scaled, radius_unit, weight_unit, 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(plain.rms, scaled.rms / radius_unit / weight_unit);
    ensemble_plays_free(&plain);
    ensemble_plays_free(&scaled);
    model_free(&model);
}

static void as_many_plays_as_there_are_stay(void)
{
    model_t model = study_model(CASE_RANDOM, 6);
    for (size_t num_plays = STUDY_PLAYS; num_plays <= ENSEMBLE_MOST_PLAYS; num_plays += 17) {
        ensemble_plays_t found = found_for(&model, num_plays);
        TEST_ASSERT_EQUAL_UINT64(STUDY_PLAYS, found.num_plays);
        TEST_ASSERT_EQUAL_DOUBLE_ARRAY(model.radius, found.radius, STUDY_PLAYS);
        TEST_ASSERT_EQUAL_DOUBLE_ARRAY(model.weight, found.weight, STUDY_PLAYS);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, found.rms);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, found.constant);
        ensemble_plays_free(&found);
    }
    model_free(&model);
}

/// Any number of plays that have no weight, one radius, or both.
static void degenerate_plays_have_an_answer(void)
{
    for (int kind = 0; kind < 3; ++kind) {
        model_t model = study_model(CASE_UNIFORM, 1);
        for (size_t j = 0; j < model.num_plays; ++j) {
            model.weight[j] = kind == 0 ? 1.0 : 0.0;
            model.radius[j] = kind == 1 ? model.radius[j] : 0.25;
        }
        for (size_t num_plays = 1; num_plays <= 29; num_plays += 7) {
            ensemble_plays_t found = found_for(&model, num_plays);
            TEST_ASSERT_EQUAL_UINT64(num_plays, found.num_plays);
            double weight = 0.0;
            for (size_t k = 0; k < num_plays; ++k) {
                weight += found.weight[k];
                TEST_ASSERT_TRUE(found.radius[k] >= model.radius[0] &&
                                 found.radius[k] <= model.radius[model.num_plays - 1]);
            }
            // One linear equation for a weight of 30 and its rounding; nothing to be met without weight.
            TEST_ASSERT_DOUBLE_WITHIN(30.0 * 1e3 * DBL_EPSILON, kind == 0 ? 30.0 : 0.0, weight);
            TEST_ASSERT_DOUBLE_WITHIN(30.0 * 1e3 * DBL_EPSILON, 0.0, found.rms);
            ensemble_plays_free(&found);
        }
        model_free(&model);
    }
}

/// More plays than the search looks at one by one, at one to the most that can be kept: the error falls.
static void many_plays_are_taken_together(void)
{
    enum { MANY = 1000 };
    random_t random = random_new(13);
    model_t model = study_model(CASE_UNIFORM, 1);
    model_set_num_plays(&model, MANY);
    for (size_t j = 0; j < MANY; ++j) {
        model.radius[j] = (double)(j + 1) / (MANY + 40.0);
        model.weight[j] = random_uniform(&random, 0.0, 0.1);
    }
    double last = (double)INFINITY;
    for (size_t num_plays = 1; num_plays <= 16; num_plays *= 4) {
        ensemble_plays_t found = found_for(&model, num_plays);
        TEST_ASSERT_TRUE(found.rms < last);
        last = found.rms;
        ensemble_plays_free(&found);
    }
    model_free(&model);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(states_are_the_references);
    RUN_TEST(weights_and_constant_are_optimal);
    RUN_TEST(plays_that_are_there_are_found);
    RUN_TEST(unseen_inputs_meet_the_specification);
    RUN_TEST(no_other_cost_has_a_smaller_error);
    RUN_TEST(error_bound_holds);
    RUN_TEST(partition_is_that_of_the_nearest_radii);
    RUN_TEST(same_model_gives_the_same_plays);
    RUN_TEST(units_do_not_matter);
    RUN_TEST(as_many_plays_as_there_are_stay);
    RUN_TEST(degenerate_plays_have_an_answer);
    RUN_TEST(many_plays_are_taken_together);
    return UNITY_END();
}
