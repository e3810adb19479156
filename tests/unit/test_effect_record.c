#include "classical_model.h"
#include "effect_catalogue.h"
#include "effect_record.h"
#include <math.h>
#include <stdlib.h>
#include <unity.h>

enum { WHOLE = 600, RAMP = 25, PLAYS = 4 };

static model_t model;
static double time_of[WHOLE];
static double input[WHOLE];
static double truth[WHOLE];
static double measured[WHOLE];
static record_t record;

/// A triangle whose sizes shrink and grow, on samples.
static double triangle(size_t t)
{
    const size_t turn = t / RAMP;
    const double size[] = {9, 7, 5, 6, 8};
    const double from = turn % 2 == 0 ? 10 - size[(turn + 4) % 5] : size[(turn + 4) % 5];
    const double to = turn % 2 == 0 ? size[turn % 5] : 10 - size[turn % 5];
    return from + (to - from) * (double)(t % RAMP) / RAMP;
}

/// A logger that loses the turning points, and up to four samples with each.
static bool is_lost(size_t t)
{
    return t >= RAMP && t % RAMP <= t / RAMP % 5;
}

/// The output at all samples with these effects; what the logger leaves of time and input.
static void make_record(const effect_use_t* uses, size_t num_uses)
{
    for (size_t t = 0; t < WHOLE; t++) {
        time_of[t] = 0.02 * (double)t;
        input[t] = triangle(t);
    }
    const record_t whole = {.num_samples = WHOLE, .time = time_of, .input = input};
    effect_run_t run = effect_run_new(&model, &whole, false);
    double output[WHOLE];
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, uses, num_uses, output);
    effect_run_free(&run);
    size_t kept = 0;
    for (size_t t = 0; t < WHOLE; t++) {
        if (!is_lost(t)) {
            time_of[kept] = time_of[t];
            input[kept] = input[t];
            truth[kept++] = output[t];
        }
    }
    record = (record_t){
        .path = "made.csv", .num_samples = kept, .time = time_of, .input = input, .output = measured};
}

void setUp(void)
{
    model = classical_model(PLAYS);
}

void tearDown(void)
{
    model_free(&model);
}

static void check_seen(const effect_use_t* uses, size_t num_uses)
{
    make_record(uses, num_uses);
    double* output = effect_simulate_record(&model, START_NEGATIVE_SATURATION, &record, uses, num_uses);
    for (size_t k = 0; k < record.num_samples; k++) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, truth[k], output[k]);
    }
    free(output);
}

static void test_the_plant_saw_what_was_lost(void)
{
    check_seen(NULL, 0);
}

/// Two sample times whatever was lost between.
static void test_a_delay_counts_the_samples_that_were_lost(void)
{
    const effect_use_t delay = {.effect = &effect_delay, .parameter = {0.04}};
    check_seen(&delay, 1);
}

/// A command without an output is what it says: the plays run over its own samples.
static void test_a_command_has_lost_nothing(void)
{
    make_record(NULL, 0);
    record.output = NULL;
    double* output = effect_simulate_record(&model, START_NEGATIVE_SATURATION, &record, NULL, 0);
    double w[PLAYS];
    for (size_t j = 0; j < PLAYS; j++) {
        w[j] = model.radius[j]; // as a descent to 0 leaves them
    }
    for (size_t k = 0; k < record.num_samples; k++) {
        double sum = 1 + 0.5 * input[k];
        for (size_t j = 0; j < PLAYS; j++) {
            w[j] = fmin(fmax(w[j], input[k] - model.radius[j]), input[k] + model.radius[j]);
            sum += model.weight[j] * w[j];
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, sum, output[k]);
    }
    free(output);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_plant_saw_what_was_lost);
    RUN_TEST(test_a_delay_counts_the_samples_that_were_lost);
    RUN_TEST(test_a_command_has_lost_nothing);
    return UNITY_END();
}
