#include "classical_model.h"
#include "diagnose_guess.h"
#include "effect_catalogue.h"
#include <math.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 2400, PLAYS = 4 };

static const double pi = 3.14159265358979324;
static double time_of[SAMPLES];
static double input[SAMPLES];
static double output[SAMPLES];
static double predicted[SAMPLES];
static double temperature[SAMPLES];
static column_t column = {"temperature", temperature};
static model_t model;
static record_t record;
static effect_run_t run;
static gap_t gap;

/// Classical PI over 0 ... 10 under two sines; `predicted` is the model's own, as is `output` so far.
void setUp(void)
{
    static const nuisance_t nothing = {0};
    model = classical_model(PLAYS);
    for (size_t t = 0; t < SAMPLES; t++) {
        time_of[t] = 7 + 0.01 * (double)t;
        input[t] = 5 - 3 * cos(0.031 * (double)t) - 2 * cos(0.0173 * (double)t);
        temperature[t] = 20 + 4 * sin(2 * pi * (double)t / SAMPLES);
    }
    record = (record_t){.path = "made.csv",
                        .num_samples = SAMPLES,
                        .time = time_of,
                        .input = input,
                        .output = output,
                        .num_auxiliary = 1,
                        .auxiliary = &column};
    run = effect_run_new(&model, &record, true);
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, NULL, 0, predicted);
    memcpy(output, predicted, sizeof output);
    gap = gap_new(&model, &run, START_NEGATIVE_SATURATION, output, NULL, &nothing, 1);
}

void tearDown(void)
{
    gap_free(&gap);
    effect_run_free(&run);
    model_free(&model);
}

/// Without a width the law is the sum that is solved for: exact but for rounding, which the square of the
/// sum's condition (below 1e3: its four terms are of like size) takes to 1e6 times 2e-16.
static void test_what_follows_a_column_is_solved_for(void)
{
    const effect_use_t truth = {
        .effect = &effect_exogenous, .column = "temperature", .parameter = {0.02, -0.1, 0, 0.05}};
    effect_use_apply(&run, &truth, output);
    effect_use_t use = {.effect = &effect_exogenous, .column = "temperature"};
    TEST_ASSERT_TRUE(guess_parameters(&gap, predicted, &use));
    for (size_t p = 0; p < effect_exogenous.num_parameters; p++) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-8 * fabs(truth.parameter[p]), truth.parameter[p], use.parameter[p]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_follows_a_column_is_solved_for);
    return UNITY_END();
}
