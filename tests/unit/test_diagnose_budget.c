#include "diagnose_budget.h"
#include "effect_catalogue.h"
#include "firmware.h"
#include "q_model.h"
#include "random.h"
#include "reference.h"
#include <float.h>
#include <math.h>
#include <string.h>
#include <unity.h>

enum { SAMPLES = 2000, PLAYS = 9 };

static model_t full;
static model_t compressed;
static double time_of[SAMPLES];
static double input[SAMPLES];
static double measured[SAMPLES];
static effect_run_t run;
static record_t record;
static const double noise = 0.02;
static const double rounding = 1e-9; // of sums of SAMPLES doubles of size 1, with 5 digits to spare

static void tanh_envelopes(model_t* model)
{
    model->input_max = 10;
    curve_free(&model->ascending);
    curve_free(&model->descending);
    model->ascending = curve_tanh(0.4, -2.2);
    model->descending = curve_tanh(0.4, -1.8);
}

/// What q15's header may be off by when it converts outputs, none above 8 here, in float: three roundings.
static const double in_float = 3 * 8 * (double)FLT_EPSILON;

/// Inputs that float holds exactly, so that lib/'s error bounds apply.
static void make_input(double largest)
{
    for (size_t t = 0; t < SAMPLES; t++) {
        time_of[t] = 0.01 * (double)t;
        const double swing = 0.5 + 0.5 * sin(0.31 * (double)t / 20);
        input[t] = (double)(float)(largest * swing * (0.5 - 0.5 * cos(2.1 * (double)t / 50)));
    }
}

void setUp(void)
{
    full = model_new("full");
    tanh_envelopes(&full);
    model_set_num_plays(&full, PLAYS);
    for (size_t j = 0; j < PLAYS; j++) {
        full.radius[j] = 0.1 * (double)(j + 1);
        full.weight[j] = 0.5 / (double)(j + 1);
    }
    compressed = model_new("compressed");
    tanh_envelopes(&compressed);
    model_set_num_plays(&compressed, 2);
    compressed.radius[0] = 0.15;
    compressed.radius[1] = 0.5;
    compressed.weight[0] = 0.8;
    compressed.weight[1] = 0.6;
    make_input(10);
    record = (record_t){
        .path = "made.csv", .num_samples = SAMPLES, .time = time_of, .input = input, .output = measured};
    run = effect_run_new(&full, &record, true);
}

void tearDown(void)
{
    effect_run_free(&run);
    model_free(&full);
    model_free(&compressed);
}

static hypothesis_t a_lag(void)
{
    const effect_use_t use = {.effect = &effect_output_lag, .parameter = {0.05}};
    return hypothesis_of(&use, 1);
}

/// The plant: the full model behind a lag, with noise; returns the noise's own RMS.
static double measure(const hypothesis_t* plant, double sigma)
{
    effect_simulate(&run, &full, START_NEGATIVE_SATURATION, plant->use, plant->num_uses, measured);
    random_t random = random_new(5);
    double sum = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        const double e = sigma * random_normal(&random);
        measured[t] += e;
        sum += e * e;
    }
    return sqrt(sum / SAMPLES);
}

static budget_chain_t chain_with(const hypothesis_t* verdict)
{
    return (budget_chain_t){.scalar = SCALAR_F32,
                            .full = &full,
                            .compressed = &compressed,
                            .compressed_path = "compressed.json",
                            .start = START_NEGATIVE_SATURATION,
                            .verdict = verdict,
                            .noise = noise};
}

static budget_t budget_of(const budget_chain_t* chain)
{
    budget_t budget;
    TEST_ASSERT_EQUAL(OUTCOME_OK, budget_find(chain, &run, measured, &budget));
    return budget;
}

static double part(const budget_t* budget, budget_part_t wanted)
{
    for (size_t i = 0; i < BUDGET_PARTS; i++) {
        if (budget->entry[i].part == wanted) {
            return budget->entry[i].rmse;
        }
    }
    TEST_FAIL_MESSAGE("the budget leaves a part out");
    return (double)NAN;
}

static double rms_difference(const double* a, const double* b)
{
    double sum = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        sum += (a[t] - b[t]) * (a[t] - b[t]);
    }
    return sqrt(sum / SAMPLES);
}

static void test_each_part_is_its_own_step(void)
{
    static double of_full[SAMPLES];
    static double of_compressed[SAMPLES];
    static double lagged[SAMPLES];
    const hypothesis_t lag = a_lag();
    const double own_noise = measure(&lag, noise);
    const budget_chain_t chain = chain_with(&lag);
    const budget_t budget = budget_of(&chain);
    reference_run(&full, START_NEGATIVE_SATURATION, input, SAMPLES, of_full);
    reference_run(&compressed, START_NEGATIVE_SATURATION, input, SAMPLES, of_compressed);
    effect_simulate(&run, &full, START_NEGATIVE_SATURATION, lag.use, 1, lagged);
    TEST_ASSERT_DOUBLE_WITHIN(rounding, rms_difference(of_full, lagged), part(&budget, BUDGET_UNMODELLED));
    TEST_ASSERT_DOUBLE_WITHIN(rounding, rms_difference(of_full, of_compressed),
                              part(&budget, BUDGET_COMPRESSION));
    // What the lag leaves is the noise drawn, of which no more than the stated noise counts as such.
    TEST_ASSERT_DOUBLE_WITHIN(rounding, fmin(noise, own_noise), part(&budget, BUDGET_NOISE));
    TEST_ASSERT_DOUBLE_WITHIN(rounding, fmax(own_noise * own_noise - noise * noise, 0),
                              pow(part(&budget, BUDGET_UNEXPLAINED), 2));
    TEST_ASSERT_EQUAL_DOUBLE(0, part(&budget, BUDGET_CLAMPING));
    TEST_ASSERT_EQUAL_DOUBLE(0, part(&budget, BUDGET_IDENTIFICATION));
}

/// The error bounds of a header's numbers, which hold for inputs that its scalar holds exactly.
typedef struct {
    double table, rounding;
} bounds_t;

static bounds_t bounds_of(scalar_t scalar)
{
    firmware_t firmware;
    TEST_ASSERT_EQUAL(OUTCOME_OK, firmware_new(&compressed, "compressed.json", scalar, &firmware));
    const bounds_t bounds =
        scalar == SCALAR_F32
            ? (bounds_t){firmware.tabulated.table_error, firmware.tabulated.float_error}
            : (bounds_t){firmware.quantized.table_error, firmware.quantized.quantization_error};
    firmware_free(&firmware);
    return bounds;
}

static q_model_t fixed_model(scalar_t scalar)
{
    return q_new(&compressed, scalar == SCALAR_Q31 ? QUANTIZED_Q31 : QUANTIZED_Q15,
                 tabulate_default_error(&compressed));
}

/// Inputs that the scalar holds exactly.
static void snap_input(scalar_t scalar)
{
    if (scalar == SCALAR_F32) {
        return; // make_input's are floats
    }
    q_model_t q = fixed_model(scalar);
    for (size_t t = 0; t < SAMPLES; t++) {
        input[t] = q.quantized.input_offset + q.quantized.input_scale * (double)q_from_units(&q, input[t]);
    }
    q_free(&q);
}

static void test_table_and_rounding_keep_their_bounds(void)
{
    for (scalar_t scalar = SCALAR_F32; scalar < NUM_SCALARS; scalar++) {
        snap_input(scalar);
        const hypothesis_t lag = a_lag();
        measure(&lag, noise);
        budget_chain_t chain = chain_with(&lag);
        chain.scalar = scalar;
        const budget_t budget = budget_of(&chain);
        const bounds_t bounds = bounds_of(scalar);
        // tabulate.h and quantize.h bound every sample's error, hence its RMS.
        TEST_ASSERT_TRUE(part(&budget, BUDGET_TABLE) > 0);
        TEST_ASSERT_TRUE(part(&budget, BUDGET_TABLE) <= bounds.table);
        TEST_ASSERT_TRUE(part(&budget, BUDGET_ROUNDING) > 0);
        TEST_ASSERT_TRUE(part(&budget, BUDGET_ROUNDING) <= bounds.rounding);
        make_input(10);
    }
}

static double f32_rmse(void)
{
    tabulated_t tabulated;
    TEST_ASSERT_NULL(tabulate(&compressed, tabulate_default_error(&compressed), &tabulated));
    hyst_f32_segment_t memory[2];
    hyst_f32_state_t state;
    TEST_ASSERT_EQUAL(HYST_STATUS_OK, hyst_f32_init(&tabulated.model, &state, memory, 2));
    double sum = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        const double error = (double)hyst_f32_step(&tabulated.model, &state, (float)input[t]) - measured[t];
        sum += error * error;
    }
    tabulated_free(&tabulated);
    return sqrt(sum / SAMPLES);
}

static double fixed_rmse(scalar_t scalar)
{
    q_model_t q = fixed_model(scalar);
    double sum = 0;
    for (size_t t = 0; t < SAMPLES; t++) {
        const double error = q_to_units(&q, q_step(&q, q_from_units(&q, input[t]))) - measured[t];
        sum += error * error;
    }
    q_free(&q);
    return sqrt(sum / SAMPLES);
}

static void check_sum(const budget_t* budget, double firmware_rmse, double tolerance)
{
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, firmware_rmse, budget->total);
    double squares = 0;
    double roots = 0;
    double rest = 0;
    for (size_t i = 0; i < BUDGET_PARTS; i++) {
        const budget_entry_t* entry = &budget->entry[i];
        TEST_ASSERT_DOUBLE_WITHIN(rounding, entry->share, pow(entry->rmse / budget->total, 2));
        TEST_ASSERT_TRUE(i == 0 || entry->share <= budget->entry[i - 1].share);
        squares += entry->rmse * entry->rmse;
        const bool is_rest = entry->part == BUDGET_NOISE || entry->part == BUDGET_IDENTIFICATION ||
                             entry->part == BUDGET_UNEXPLAINED;
        rest += is_rest ? entry->rmse * entry->rmse : 0;
        roots += is_rest ? 0 : entry->rmse;
    }
    roots += sqrt(rest);
    const double total = budget->total * budget->total;
    TEST_ASSERT_DOUBLE_WITHIN(rounding, total, squares + budget->cross_share * total);
    // Cauchy-Schwarz: the steps' products are at most the products of their RMS; noise, misfit and the
    // unexplained are one step.
    TEST_ASSERT_TRUE(fabs(total - squares) <= roots * roots - squares + rounding);
}

static void test_parts_add_up_to_the_firmware_within_the_cross_terms(void)
{
    const hypothesis_t lag = a_lag();
    for (scalar_t scalar = SCALAR_F32; scalar < NUM_SCALARS; scalar++) {
        snap_input(scalar);
        measure(&lag, noise);
        budget_chain_t chain = chain_with(&lag);
        chain.scalar = scalar;
        const budget_t budget = budget_of(&chain);
        const double tolerance = scalar == SCALAR_Q15 ? in_float : rounding;
        check_sum(&budget, scalar == SCALAR_F32 ? f32_rmse() : fixed_rmse(scalar), tolerance);
        make_input(10);
    }
}

/// The firmware's outputs are whole steps of the header's output scale: rounding puts no less on them than
/// the way from the chords' outputs to the nearest such step.
static void test_fixed_point_rounds_at_least_to_its_output_steps(void)
{
    const hypothesis_t lag = a_lag();
    measure(&lag, noise);
    static double chords_output[SAMPLES];
    static double nearest[SAMPLES];
    for (scalar_t scalar = SCALAR_Q31; scalar < NUM_SCALARS; scalar++) {
        firmware_t firmware;
        TEST_ASSERT_EQUAL(OUTCOME_OK, firmware_new(&compressed, "compressed.json", scalar, &firmware));
        model_t chords = firmware_chords(&firmware, &compressed);
        reference_run(&chords, START_NEGATIVE_SATURATION, input, SAMPLES, chords_output);
        const quantized_t* q = &firmware.quantized;
        for (size_t t = 0; t < SAMPLES; t++) {
            const double steps = round((chords_output[t] - q->output_offset) / q->output_scale);
            nearest[t] = q->output_offset + q->output_scale * steps;
        }
        model_free(&chords);
        budget_chain_t chain = chain_with(&lag);
        chain.scalar = scalar;
        const budget_t budget = budget_of(&chain);
        const double least = rms_difference(chords_output, nearest);
        TEST_ASSERT_TRUE(least > 0);
        TEST_ASSERT_TRUE(part(&budget, BUDGET_ROUNDING) >= least - (scalar == SCALAR_Q15 ? in_float : 0));
        firmware_free(&firmware);
    }
}

static void test_a_chain_without_a_step_has_nothing_there(void)
{
    const hypothesis_t none = hypothesis_of(NULL, 0);
    measure(&none, noise);
    budget_chain_t chain = chain_with(NULL);
    chain.compressed = &full;
    const budget_t budget = budget_of(&chain);
    TEST_ASSERT_EQUAL_DOUBLE(0, part(&budget, BUDGET_COMPRESSION));
    // The plays of a run with effects are the reference's own, up to rounding.
    TEST_ASSERT_DOUBLE_WITHIN(rounding, 0, part(&budget, BUDGET_UNMODELLED));
    TEST_ASSERT_EQUAL(BUDGET_NOISE, budget.entry[0].part);
}

static void test_the_pair_that_cancels_most_is_named(void)
{
    // The plant is the compressed model itself: what fewer plays change is what the full model is off by, so
    // the two cancel.
    reference_run(&compressed, START_NEGATIVE_SATURATION, input, SAMPLES, measured);
    static double of_full[SAMPLES];
    reference_run(&full, START_NEGATIVE_SATURATION, input, SAMPLES, of_full);
    const budget_chain_t chain = chain_with(NULL);
    const budget_t budget = budget_of(&chain);
    TEST_ASSERT_EQUAL(BUDGET_COMPRESSION, budget.pair[0]);
    TEST_ASSERT_EQUAL(BUDGET_UNEXPLAINED, budget.pair[1]);
    // Twice the product of a course and its opposite.
    const double expected = -2 * pow(rms_difference(of_full, measured) / budget.total, 2);
    TEST_ASSERT_DOUBLE_WITHIN(rounding * fabs(expected), expected, budget.pair_share);
}

static void test_known_misfit_is_identification(void)
{
    const hypothesis_t lag = a_lag();
    const double own = measure(&lag, 3 * noise);
    budget_chain_t chain = chain_with(&lag);
    chain.misfit = 2 * noise;
    const budget_t budget = budget_of(&chain);
    TEST_ASSERT_DOUBLE_WITHIN(rounding, sqrt(3) * noise, part(&budget, BUDGET_IDENTIFICATION));
    TEST_ASSERT_DOUBLE_WITHIN(rounding, sqrt(own * own - 4 * noise * noise),
                              part(&budget, BUDGET_UNEXPLAINED));
}

static void test_inputs_beyond_the_range_are_clamped(void)
{
    effect_run_free(&run);
    make_input(12);
    run = effect_run_new(&full, &record, true);
    const hypothesis_t lag = a_lag();
    measure(&lag, noise);
    static double beyond[SAMPLES];
    static double within[SAMPLES];
    static double clamped[SAMPLES];
    for (size_t t = 0; t < SAMPLES; t++) {
        clamped[t] = fmin(input[t], 10);
    }
    reference_run(&compressed, START_NEGATIVE_SATURATION, input, SAMPLES, beyond);
    reference_run(&compressed, START_NEGATIVE_SATURATION, clamped, SAMPLES, within);
    const budget_chain_t chain = chain_with(&lag);
    const budget_t budget = budget_of(&chain);
    TEST_ASSERT_TRUE(rms_difference(beyond, within) > 0);
    TEST_ASSERT_DOUBLE_WITHIN(rounding, rms_difference(beyond, within), part(&budget, BUDGET_CLAMPING));
}

static void test_a_model_that_no_scalar_can_hold_is_refused(void)
{
    const hypothesis_t lag = a_lag();
    measure(&lag, noise);
    compressed.weight[0] = 1e39;
    const budget_chain_t chain = chain_with(&lag);
    budget_t budget;
    TEST_ASSERT_EQUAL(OUTCOME_NUMERICAL, budget_find(&chain, &run, measured, &budget));
}

/// Between two of q15's inputs the envelope rises by all of its range: no slope of 16 bits does that.
static void test_a_model_too_steep_for_q15_is_refused_there(void)
{
    curve_free(&compressed.ascending);
    curve_free(&compressed.descending);
    compressed.ascending = curve_tanh(1e6, -5.001e6);
    compressed.descending = curve_tanh(1e6, -5e6);
    const hypothesis_t none = hypothesis_of(NULL, 0);
    measure(&none, noise);
    budget_chain_t chain = chain_with(NULL);
    budget_t budget;
    chain.scalar = SCALAR_Q31;
    TEST_ASSERT_EQUAL(OUTCOME_OK, budget_find(&chain, &run, measured, &budget));
    chain.scalar = SCALAR_Q15;
    TEST_ASSERT_EQUAL(OUTCOME_NUMERICAL, budget_find(&chain, &run, measured, &budget));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_part_is_its_own_step);
    RUN_TEST(test_table_and_rounding_keep_their_bounds);
    RUN_TEST(test_parts_add_up_to_the_firmware_within_the_cross_terms);
    RUN_TEST(test_a_chain_without_a_step_has_nothing_there);
    RUN_TEST(test_the_pair_that_cancels_most_is_named);
    RUN_TEST(test_known_misfit_is_identification);
    RUN_TEST(test_inputs_beyond_the_range_are_clamped);
    RUN_TEST(test_fixed_point_rounds_at_least_to_its_output_steps);
    RUN_TEST(test_a_model_that_no_scalar_can_hold_is_refused);
    RUN_TEST(test_a_model_too_steep_for_q15_is_refused_there);
    return UNITY_END();
}
