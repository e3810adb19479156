#include "classical_model.h"
#include "diagnose.h"
#include "diagnose_shrink.h"
#include "diagnose_text.h"
#include "effect_catalogue.h"
#include "random.h"
#include <math.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 3000, PLAYS = 8 };

static double time_of[SAMPLES];
static double input[SAMPLES];
static double output[SAMPLES];
static model_t model;
static diagnosis_t diagnosis;
static random_t noise_source;
static const double pi = 3.14159265358979324;
static const double noise = 0.01;
static const double frequency = 0.7; ///< of the input [Hz], 21 periods in 30 s
static const record_t record = {
    .path = "made.csv", .num_samples = SAMPLES, .time = time_of, .input = input, .output = output};

/// Classical PI over 0 ... 10, driven over 1 ... 9.
void setUp(void)
{
    noise_source = random_new(21);
    model = classical_model_of_falling_weights(PLAYS);
    for (size_t t = 0; t < SAMPLES; t++) {
        time_of[t] = 0.01 * (double)t;
        input[t] = 5 - 4 * cos(2 * pi * frequency * time_of[t]);
    }
    diagnosis = (diagnosis_t){0};
}

void tearDown(void)
{
    diagnosis_free(&diagnosis);
    model_free(&model);
}

/// The plays by Eq. (4) from a descent to 0, and noise.
static void run_plant(void)
{
    double w[PLAYS];
    for (size_t j = 0; j < PLAYS; j++) {
        w[j] = model.radius[j];
    }
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] = 1 + 0.5 * input[t] + noise * random_normal(&noise_source);
        for (size_t j = 0; j < PLAYS; j++) {
            w[j] = fmin(fmax(w[j], input[t] - model.radius[j]), input[t] + model.radius[j]);
            output[t] += model.weight[j] * w[j];
        }
    }
}

static void add_hum(double hum_frequency, double amplitude)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] += amplitude * sin(2 * pi * hum_frequency * time_of[t] + 0.4);
    }
}

static void run_diagnosis_with(const record_t* bench)
{
    const diagnose_options_t options = {
        .calibration_rmse = noise, .calibration_noise = noise, .calibration = bench};
    TEST_ASSERT_EQUAL(OUTCOME_OK, diagnose(&model, &record, &options, &diagnosis));
}

static void run_diagnosis(void)
{
    run_diagnosis_with(NULL);
}

static bool is_named(const char* name)
{
    const effect_use_t* use = diagnosis.cause[0].hypothesis->use;
    bool found = false;
    for (size_t i = 0; !diagnosis.is_unknown && i < diagnosis.cause[0].hypothesis->num_uses; i++) {
        found = found || strcmp(use[i].effect->name, name) == 0;
    }
    for (size_t k = 0; k < diagnosis.num_indistinguishable; k++) {
        const hypothesis_t* other = diagnosis.cause[diagnosis.indistinguishable[k]].hypothesis;
        for (size_t i = 0; i < other->num_uses; i++) {
            found = found || strcmp(other->use[i].effect->name, name) == 0;
        }
    }
    return found;
}

static void test_a_hum_of_its_own_frequency_is_named(void)
{
    run_plant();
    add_hum(1.37 * frequency, 0.1);
    run_diagnosis();
    TEST_ASSERT_FALSE(diagnosis.is_unknown);
    const hypothesis_t* verdict = diagnosis.cause[0].hypothesis;
    TEST_ASSERT_EQUAL(1, verdict->num_uses);
    TEST_ASSERT_EQUAL_PTR(&effect_periodic_disturbance, verdict->use[0].effect);
    // Five times the Cramer-Rao bound, sqrt(24 / n) noise / (amplitude duration) over 2 pi.
    const double bound = 5 * sqrt(24.0 / SAMPLES) * noise / (0.1 * 30) / (2 * pi);
    TEST_ASSERT_DOUBLE_WITHIN(bound, 1.37 * frequency, verdict->use[0].parameter[0]);
}

/// A whole period ahead at the start, and half as strong again: no gradient leads there from an even one.
/// What another record is told of it is the settled machine.
static void test_a_machine_that_runs_up_is_named(void)
{
    run_plant();
    for (size_t t = 0; t < SAMPLES; t++) {
        const double start = exp(-time_of[t] / 2);
        output[t] += 0.1 * (1 + 0.5 * start) * sin(2 * pi * (1.37 * frequency * time_of[t] + start) + 0.4);
    }
    run_diagnosis();
    TEST_ASSERT_FALSE(diagnosis.is_unknown);
    const hypothesis_t* verdict = diagnosis.cause[0].hypothesis;
    TEST_ASSERT_EQUAL(1, verdict->num_uses);
    TEST_ASSERT_EQUAL_PTR(&effect_periodic_disturbance_run_up, verdict->use[0].effect);
    // What is left is the noise, known to some 3 %.
    TEST_ASSERT_TRUE(verdict->fit_rmse < 1.1 * noise);
    effect_use_t uses[HYPOTHESIS_MAX_EFFECTS];
    TEST_ASSERT_EQUAL(1, diagnosis_handed_out(&diagnosis, uses));
    TEST_ASSERT_EQUAL_DOUBLE(0, uses[0].parameter[7]);
    TEST_ASSERT_EQUAL_DOUBLE(0, uses[0].parameter[8]);
}

static void test_a_hum_in_step_with_the_input_is_none(void)
{
    run_plant();
    add_hum(3 * frequency, 0.1);
    run_diagnosis();
    TEST_ASSERT_FALSE(diagnosis.is_none);
    TEST_ASSERT_FALSE(is_named("periodic_disturbance"));
}

/// Far above what loops answer with: mains beside slow work. It is too fast to be an answer.
static void test_a_hum_far_above_the_input_is_named(void)
{
    run_plant();
    add_hum(40 * frequency, 0.1);
    run_diagnosis();
    TEST_ASSERT_EQUAL(1, diagnosis.cause[0].hypothesis->num_uses);
    TEST_ASSERT_EQUAL_PTR(&effect_periodic_disturbance, diagnosis.cause[0].hypothesis->use[0].effect);
    TEST_ASSERT_FALSE(diagnosis.is_unknown);
}

static void test_lines_that_follow_the_input(void)
{
    effect_run_t run = effect_run_new(&model, &record, true);
    const double slow[EFFECT_MAX_PARAMETERS] = {frequency / 3, 1e-3, 0, 0, 1e-3, 0.1, 0};
    const double at_input[EFFECT_MAX_PARAMETERS] = {frequency, 0.1, 0.1};
    const double within[EFFECT_MAX_PARAMETERS] = {4 * frequency + 0.4 / 29.99, 0.1};
    const double outside[EFFECT_MAX_PARAMETERS] = {4 * frequency + 0.6 / 29.99, 0.1};
    const double half[EFFECT_MAX_PARAMETERS] = {0.5 * frequency, 0.1};
    const double tenth[EFFECT_MAX_PARAMETERS] = {10 * frequency, 0.1};
    const double eleventh[EFFECT_MAX_PARAMETERS] = {11 * frequency, 0.1};
    const double mains[EFFECT_MAX_PARAMETERS] = {50, 0.1};
    const effect_t* hum = &effect_periodic_disturbance;
    TEST_ASSERT_FALSE(hum->follows_input(&run, at_input)); // not known to be periodic
    run.input_frequency = frequency;
    TEST_ASSERT_TRUE(hum->follows_input(&run, at_input));
    TEST_ASSERT_TRUE(hum->follows_input(&run, slow)); // its third harmonic does
    TEST_ASSERT_TRUE(hum->follows_input(&run, within));
    TEST_ASSERT_FALSE(hum->follows_input(&run, outside));
    TEST_ASSERT_FALSE(hum->follows_input(&run, half));
    TEST_ASSERT_TRUE(hum->follows_input(&run, tenth));
    TEST_ASSERT_FALSE(hum->follows_input(&run, eleventh));
    run.input_frequency = 1;
    TEST_ASSERT_FALSE(hum->follows_input(&run, mains));
    effect_run_free(&run);
}

/// The plant saturates beyond the range that the model knows, where it is straight on.
static void test_a_range_that_was_left_is_told(void)
{
    model.input_min = 4;
    model.input_max = 6;
    run_plant();
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] = 6.5 + 3 * tanh((output[t] - 6.5) / 3);
    }
    run_diagnosis();
    TEST_ASSERT_FALSE(is_named("periodic_disturbance"));
    TEST_ASSERT_FALSE(diagnosis.confident);
    TEST_ASSERT_NOT_NULL(strstr(diagnosis.advice, "beyond its 4 ... 6"));
    // |4 cos| > 1 + 0.02, the tolerance being a hundredth of the range; a sample at each of 84 crossings.
    const double expected = 1 - 2 / pi * asin(1.02 / 4);
    TEST_ASSERT_DOUBLE_WITHIN(84.0 / SAMPLES, expected, diagnosis.scope.beyond);
}

/// Loops of one size on the bench say nothing for sure of smaller ones.
static void test_loops_that_were_never_made_leave_doubt(void)
{
    static double bench_input[SAMPLES];
    // All 0: where the model's misfit is its noise, read only for the steps of a converter.
    static double bench_output[SAMPLES];
    const record_t bench = {.path = "bench.csv",
                            .num_samples = SAMPLES,
                            .time = time_of,
                            .input = bench_input,
                            .output = bench_output};
    for (size_t t = 0; t < SAMPLES; t++) {
        input[t] = 5 - 2.5 * cos(2 * pi * frequency * time_of[t]);
    }
    run_plant();
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] = 1.1 * output[t];
        bench_input[t] = 5 - 5 * cos(2 * pi * 1.01 * time_of[t]);
    }
    run_diagnosis_with(&bench);
    TEST_ASSERT_TRUE(is_named("gain_offset"));
    TEST_ASSERT_FALSE(diagnosis.confident);
    TEST_ASSERT_NOT_NULL(strstr(diagnosis.advice, "loops of several sizes: 100 %"));
    diagnosis_free(&diagnosis);
    for (size_t t = 0; t < SAMPLES; t++) {
        bench_input[t] = 5 + (bench_input[t] - 5) * (1 - (double)t / SAMPLES);
    }
    run_diagnosis_with(&bench);
    TEST_ASSERT_TRUE(is_named("gain_offset"));
    TEST_ASSERT_NULL(strstr(diagnosis.advice, "loops that the calibration never made"));
}

/// A sensor that rises from rest as the record begins hides what else there is; where the calibration's start
/// had to be left out, the record's is, too.
static void test_a_start_like_the_calibrations_is_left_out(void)
{
    run_plant();
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] += 0.1 * time_of[t] / 30 - 5 * exp(-time_of[t] / 0.05);
    }
    model.identification = json_pack("{s:i}", "first_fitted", 80);
    run_diagnosis();
    // Both ends were visited after half a period, 71.4 samples, but for the last hundredth of the range:
    // 2 asin(0.1) / pi of the half.
    TEST_ASSERT_TRUE(diagnosis.scope.first_judged >= 66 && diagnosis.scope.first_judged <= 72);
    TEST_ASSERT_EQUAL(SAMPLES - diagnosis.scope.first_judged, diagnosis.num_judged);
    TEST_ASSERT_EQUAL_STRING("drift", diagnosis.cause[0].hypothesis->use[0].effect->name);
    TEST_ASSERT_EQUAL(1, diagnosis.cause[0].hypothesis->num_uses);
    // Of a ramp from 0.1 first / n to 0.1 and the noise. Noise scatters the mean square by 2 noise gap /
    // sqrt(n) and noise^2 sqrt(2 / n), the RMS by half that over itself; four times. The transient leaves 5
    // exp(-13).
    const double n = (double)diagnosis.num_judged;
    const double from = 0.1 * (double)diagnosis.scope.first_judged / SAMPLES;
    const double ramp = (0.01 + 0.1 * from + from * from) / 3;
    const double rmse = sqrt(ramp + noise * noise);
    const double scatter = (2 * noise * sqrt(ramp / n) + noise * noise * sqrt(2 / n)) / (2 * rmse);
    TEST_ASSERT_DOUBLE_WITHIN(4 * scatter + 5 * exp(-13), rmse, diagnosis.rmse);
    char summary[600];
    text_summary(&diagnosis, "", summary, sizeof summary);
    TEST_ASSERT_NOT_NULL(strstr(summary, "shrink the error of other stretches of this record by"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_hum_of_its_own_frequency_is_named);
    RUN_TEST(test_a_machine_that_runs_up_is_named);
    RUN_TEST(test_a_hum_in_step_with_the_input_is_none);
    RUN_TEST(test_a_hum_far_above_the_input_is_named);
    RUN_TEST(test_lines_that_follow_the_input);
    RUN_TEST(test_a_range_that_was_left_is_told);
    RUN_TEST(test_loops_that_were_never_made_leave_doubt);
    RUN_TEST(test_a_start_like_the_calibrations_is_left_out);
    return UNITY_END();
}
