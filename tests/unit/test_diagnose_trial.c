#include "classical_model.h"
#include "diagnose_trial.h"
#include "effect_catalogue.h"
#include "random.h"
#include <math.h>
#include <unity.h>

enum { SAMPLES = 2400, PLAYS = 4 };

/// A record of the plant: the model, an output lag of 0.05 s at 0.01 s a sample, and noise.
typedef struct {
    double time[SAMPLES], input[SAMPLES], output[SAMPLES];
    record_t record;
} work_t;

static const double noise = 0.01;
static model_t model;
static work_t slow;
static work_t fast;

static void make_work(work_t* work, double speed, uint64_t seed)
{
    random_t random = random_new(seed);
    for (size_t t = 0; t < SAMPLES; t++) {
        work->time[t] = 0.01 * (double)t;
        work->input[t] = 5 - 3 * cos(0.031 * speed * (double)t) - 2 * cos(0.0173 * speed * (double)t);
    }
    work->record = (record_t){.path = "made.csv",
                              .num_samples = SAMPLES,
                              .time = work->time,
                              .input = work->input,
                              .output = work->output};
    const effect_use_t lag = {.effect = &effect_output_lag, .parameter = {0.05}};
    effect_run_t run = effect_run_new(&model, &work->record, true);
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &lag, 1, work->output);
    effect_run_free(&run);
    for (size_t t = 0; t < SAMPLES; t++) {
        work->output[t] += noise * random_normal(&random);
    }
}

void setUp(void)
{
    model = classical_model(PLAYS);
    make_work(&slow, 0.25, 21);
    make_work(&fast, 1, 22);
}

void tearDown(void)
{
    model_free(&model);
}

static trial_t try_on_fast_work(const effect_use_t* use)
{
    const hypothesis_t hypothesis = hypothesis_of(use, 1);
    cause_t cause = {.hypothesis = &hypothesis};
    const diagnosis_t diagnosis = {
        .num_causes = 1, .cause = &cause, .scope = scope_of(&model, NULL, &slow.record)};
    trial_t trial;
    TEST_ASSERT_EQUAL(OUTCOME_OK, trial_run(&model, START_NEGATIVE_SATURATION, &diagnosis, &slow.record,
                                            &fast.record, &trial));
    return trial;
}

/// The gap on slow work is a quarter of that on fast work, the noise after it is the same. Predicted and
/// realised part by the two records' noise alone, each known to 1 / sqrt(2 SAMPLES) of itself: within three
/// standard deviations of sqrt(2) of that, of 1 - shrink.
static void test_shrink_is_predicted_for_other_work(void)
{
    const effect_use_t lag = {.effect = &effect_output_lag, .parameter = {0.05}};
    const trial_t trial = try_on_fast_work(&lag);
    const double left = trial.after / trial.before;
    const double bound = 3 * sqrt(2) * left / sqrt(2.0 * SAMPLES);
    TEST_ASSERT_DOUBLE_WITHIN(3 * noise / sqrt(2.0 * SAMPLES), noise, trial.after);
    TEST_ASSERT_DOUBLE_WITHIN(bound, 1 - left, trial.predicted);
}

/// Work that is only planned has no output: what is predicted of it is what was predicted of the same work
/// measured, to the bit.
static void test_planned_work_needs_no_output(void)
{
    const effect_use_t lag = {.effect = &effect_output_lag, .parameter = {0.05}};
    const trial_t measured = try_on_fast_work(&lag);
    fast.record.output = NULL;
    const trial_t planned = try_on_fast_work(&lag);
    TEST_ASSERT_TRUE(measured.is_measured);
    TEST_ASSERT_FALSE(planned.is_measured);
    TEST_ASSERT_EQUAL_DOUBLE(measured.predicted, planned.predicted);
    TEST_ASSERT_EQUAL_DOUBLE(0, planned.before);
    TEST_ASSERT_EQUAL_DOUBLE(0, planned.after);
}

/// The diagnosed record has the column from 0 to 1. The next one begins at 20 and is 1.5 above that in a
/// quarter of its samples, else less than 1: counted from the first value, that quarter was never seen.
/// Counted from a bench's 0.5 none of it was.
static void test_a_column_that_goes_further_is_told(void)
{
    static double here[SAMPLES];
    static double there[SAMPLES];
    for (size_t t = 0; t < SAMPLES; t++) {
        here[t] = (double)t / (SAMPLES - 1);
        there[t] = t > 0 && t <= SAMPLES / 4 ? 21.5 : 20 + 0.0004 * (double)t;
    }
    column_t columns[2] = {{"load", here}, {"load", there}};
    slow.record.num_auxiliary = fast.record.num_auxiliary = 1;
    slow.record.auxiliary = &columns[0];
    fast.record.auxiliary = &columns[1];
    const effect_use_t gain = {.effect = &effect_exogenous, .parameter = {0.1}, .column = "load"};
    TEST_ASSERT_EQUAL_DOUBLE(0.25, try_on_fast_work(&gain).extrapolated);
    const effect_use_t known = {.effect = &effect_exogenous,
                                .parameter = {0.1},
                                .column = "load",
                                .has_reference = true,
                                .reference = 0.5};
    TEST_ASSERT_EQUAL_DOUBLE(1, try_on_fast_work(&known).extrapolated);
    const effect_use_t lag = {.effect = &effect_output_lag, .parameter = {0.05}};
    TEST_ASSERT_EQUAL_DOUBLE(0, try_on_fast_work(&lag).extrapolated);
}

/// A course that this plant does not have is run with the rest, as `simulate` runs the written model.
static void test_drift_is_tried_as_written(void)
{
    const effect_use_t drift = {.effect = &effect_drift_linear, .parameter = {0.1}};
    const trial_t trial = try_on_fast_work(&drift);
    TEST_ASSERT_TRUE(trial.after > trial.before);
}

/// A sensor that rises from rest as either record begins: where identify left out such a start of the
/// calibration, it takes no part in what is realised or predicted. The ends of the first 720 samples' inputs
/// are visited after 60 at the earliest, when 5 exp(-12) is left of it.
static void test_a_start_that_is_left_out_is_not_judged(void)
{
    const effect_use_t lag = {.effect = &effect_output_lag, .parameter = {0.05}};
    for (size_t t = 0; t < SAMPLES; t++) {
        slow.output[t] -= 5 * exp(-slow.time[t] / 0.05);
        fast.output[t] -= 5 * exp(-fast.time[t] / 0.05);
    }
    model.identification = json_pack("{s:i}", "first_fitted", 80);
    const trial_t trial = try_on_fast_work(&lag);
    // At least 70 % of the samples are judged.
    const double scatter = noise / sqrt(2 * 0.7 * SAMPLES);
    TEST_ASSERT_DOUBLE_WITHIN(3 * scatter, noise, trial.after);
    const double left = trial.after / trial.before;
    TEST_ASSERT_DOUBLE_WITHIN(3 * sqrt(2) * left * scatter / noise, 1 - left, trial.predicted);
}

static void test_missing_column_is_refused(void)
{
    const effect_use_t column = {.effect = &effect_exogenous, .column = "temperature"};
    const hypothesis_t hypothesis = hypothesis_of(&column, 1);
    cause_t cause = {.hypothesis = &hypothesis};
    const diagnosis_t diagnosis = {.num_causes = 1, .cause = &cause};
    trial_t trial;
    TEST_ASSERT_EQUAL(OUTCOME_BAD_INPUT, trial_run(&model, START_NEGATIVE_SATURATION, &diagnosis,
                                                   &slow.record, &fast.record, &trial));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_shrink_is_predicted_for_other_work);
    RUN_TEST(test_planned_work_needs_no_output);
    RUN_TEST(test_a_column_that_goes_further_is_told);
    RUN_TEST(test_drift_is_tried_as_written);
    RUN_TEST(test_a_start_that_is_left_out_is_not_judged);
    RUN_TEST(test_missing_column_is_refused);
    return UNITY_END();
}
