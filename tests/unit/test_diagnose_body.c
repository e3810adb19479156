#include "diagnose_body.h"

#include "element_plant.h"
#include "random.h"
#include "reference.h"
#include "series.h"
#include <math.h>
#include <unity.h>

enum { SAMPLES = 3000, DENSE = 200 };

static const double noise = 0.01;
static model_t model;
static double bench_input[SAMPLES], bench_output[SAMPLES];
static double work_input[SAMPLES], work_output[SAMPLES];
static record_t bench, work;

static record_t record_of(double* input, double* output)
{
    return (record_t){.path = "made.csv", .num_samples = SAMPLES, .input = input, .output = output};
}

void setUp(void)
{
    model = model_new("plant");
    model.input_min = 40;
    model.input_max = 60;
    model.nonhysteretic = curve_linear(0.3, 0);
    model_set_num_plays(&model, 2);
    for (size_t j = 0; j < 2; j++) {
        model.radius[j] = 1 + 3 * (double)j;
        model.weight[j] = 0.05;
    }
    element_plant_input(1, bench_input, SAMPLES);
    element_plant_input(2, work_input, SAMPLES);
    bench = record_of(bench_input, bench_output);
    work = record_of(work_input, work_output);
}

void tearDown(void)
{
    model_free(&model);
}

static void add_noise(double* output)
{
    random_t random = random_new(3);
    for (size_t t = 0; t < SAMPLES; t++) {
        output[t] += noise * random_normal(&random);
    }
}

static double misfit(void)
{
    double* predicted = xmalloc(SAMPLES * sizeof *predicted);
    reference_run(&model, START_NEGATIVE_SATURATION, bench_input, SAMPLES, predicted);
    const double square = series_mean_square(predicted, bench_output, SAMPLES);
    free(predicted);
    return sqrt(square);
}

static body_t find(void)
{
    return body_find(&model, START_NEGATIVE_SATURATION, &bench, misfit(), noise, true, &work);
}

/// What acts on the record is what the diagnosis is after: here it cancels all that the plant differs from
/// the model by, so that the model meets the record exactly and the plant's own body does not.
static void check_element(element_kind_t kind, element_plant_step_t* step)
{
    element_plant_run(step, bench_input, SAMPLES, bench_output);
    add_noise(bench_output);
    reference_run(&model, START_NEGATIVE_SATURATION, work_input, SAMPLES, work_output);
    body_t body = find();
    TEST_ASSERT_TRUE(body.stands_in);
    TEST_ASSERT_TRUE(body.stand_in.is_element);
    TEST_ASSERT_EQUAL(kind, body.stand_in.element.kind);
    body_free(&body);
}

static void test_a_bouc_wen_plant_is_told_by_its_bench_alone(void)
{
    check_element(ELEMENT_BOUC_WEN, element_plant_bouc_wen);
}

static void test_a_jiles_atherton_plant_is_told_by_its_bench_alone(void)
{
    check_element(ELEMENT_JILES_ATHERTON, element_plant_jiles_atherton);
}

/// A plant of many plays, which wipes out and is congruent: a sum of `line` and plays of radii 0 ... 0.4 of
/// the range, by their rule, from negative saturation.
static void run_preisach(const double* input, double* output)
{
    double state[DENSE];
    for (size_t j = 0; j < DENSE; j++) {
        state[j] = 0.4 * (double)j / DENSE;
    }
    for (size_t t = 0; t < SAMPLES; t++) {
        const double x = (input[t] - 40) / 20;
        output[t] = 12 + 4 * x;
        for (size_t j = 0; j < DENSE; j++) {
            const double r = 0.4 * (double)j / DENSE;
            state[j] = fmin(fmax(state[j], x - r), x + r);
            output[t] += 4.0 / DENSE * state[j];
        }
    }
}

/// Its plays stay, with what they miss, though 1.5 times the gain acts on the record. A play's bend is off by
/// at most sqrt(2 / 3) / 2 cells times its weight over the range (test_everett.c): 4 the plant's, 2 the
/// model's.
static void test_a_plant_of_preisach_s_kind_keeps_its_plays(void)
{
    run_preisach(bench_input, bench_output);
    add_noise(bench_output);
    run_preisach(work_input, work_output);
    for (size_t t = 0; t < SAMPLES; t++) {
        work_output[t] *= 1.5;
    }
    body_t body = find();
    TEST_ASSERT_FALSE(body.stands_in);
    TEST_ASSERT_TRUE(body.has_everett);
    const double most = (4.0 + 2.0) * 0.5 * sqrt(2.0 / 3) / EVERETT_CELLS;
    TEST_ASSERT_TRUE(body.misfit < sqrt(most * most + noise * noise));
    TEST_ASSERT_TRUE(misfit() > 2 * most);
    body_free(&body);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_bouc_wen_plant_is_told_by_its_bench_alone);
    RUN_TEST(test_a_jiles_atherton_plant_is_told_by_its_bench_alone);
    RUN_TEST(test_a_plant_of_preisach_s_kind_keeps_its_plays);
    return UNITY_END();
}
