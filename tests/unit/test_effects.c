#include "effect.h"
#include "effect_cases.h"
#include "effect_invert.h"
#include "hysteresis.h"
#include "random.h"
#include "random_model.h"
#include "reference.h"
#include "series.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

static model_t model;
static record_t record;
static effect_run_t run;
static double* plain;
static double* output;

void setUp(void)
{
    model = effect_case_model();
    record = effect_case_record(NULL, 0);
    run = effect_run_new(&model, &record, true);
    plain = xcalloc(record.num_samples, sizeof(double));
    output = xcalloc(record.num_samples, sizeof(double));
    reference_run(&model, START_NEGATIVE_SATURATION, record.input, record.num_samples, plain);
}

void tearDown(void)
{
    effect_run_free(&run);
    record_free(&record);
    model_free(&model);
    free(plain);
    free(output);
}

static double largest_difference(const double* a, const double* b, size_t count)
{
    double largest = 0.0;
    for (size_t i = 0; i < count; ++i) {
        TEST_ASSERT_TRUE(isfinite(a[i]));
        TEST_ASSERT_TRUE(isfinite(b[i]));
        largest = fmax(largest, fabs(a[i] - b[i]));
    }
    return largest;
}

static void every_effect_has_its_case(void)
{
    TEST_ASSERT_EQUAL_UINT(effect_count(), effect_case_count());
    for (size_t c = 0; c < effect_case_count(); ++c) {
        TEST_ASSERT_NOT_NULL_MESSAGE(effect_case_use(effect_case_at(c)).effect, effect_case_at(c)->name);
    }
}

/// A time constant below a fiftieth of a sample lags by at most that times the speed. A mode of 5 sample
/// rates: at most 2 damping / w of the speed behind, and each change of speed, at most twice the speed, rings
/// with amplitude 1/w, in sum below 1 / (1 - e^(-damping w dt)) of them; w dt = 10 pi and damping 0.7 leave
/// no second one. Together < 5.4/(10 pi) of a sample's motion.
static void neutral_parameters_change_nothing(void)
{
    const double motion = effect_case_speed(&model, &record) * run.sample_time;
    for (size_t c = 0; c < effect_case_count(); ++c) {
        effect_use_t use = effect_case_use(effect_case_at(c));
        double bound = 8.0 * output_rounding(&model);
        for (size_t p = 0; p < use.effect->num_parameters; ++p) {
            const effect_limits_t limits = effect_use_limits(&run, &use, p);
            use.parameter[p] = limits.neutral;
            const bool tau = strcmp(use.effect->parameter[p].name, "tau") == 0;
            bound += tau ? 0.02 * motion : 0.0;
        }
        bound += strcmp(use.effect->name, "resonance") == 0 ? 5.4 / 31.4 * motion : 0.0;
        effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &use, 1, output);
        const double difference = largest_difference(plain, output, record.num_samples);
        TEST_ASSERT_TRUE_MESSAGE(difference <= bound, use.effect->name);
    }
}

/// The step-by-step hysteresis without effects, and with a width that stays 0, on models and inputs of every
/// kind: the sum's order and the strip's other side cost rounding only.
static void stepping_plays_is_the_reference(void)
{
    random_t random = random_new(20250);
    enum { LENGTH = 300 };
    double input[LENGTH];
    for (int round = 0; round < 200; ++round) {
        model_t any = random_model(&random);
        random_input(&random, &any, input, LENGTH);
        hysteresis_t hysteresis = hysteresis_neutral();
        if (round % 2 == 1) {
            hysteresis.width = xcalloc(LENGTH, sizeof(double));
        }
        reference_t reference = reference_new(&any, START_NEGATIVE_SATURATION, input[0]);
        hysteresis_state_t state = hysteresis_start(&any, START_NEGATIVE_SATURATION, &hysteresis, input[0]);
        const double bound = 4.0 * output_rounding(&any);
        TEST_ASSERT_DOUBLE_WITHIN(bound, reference_output(&reference), hysteresis_output(&state));
        for (size_t i = 1; i < LENGTH; ++i) {
            const double expected = reference_step(&reference, input[i]);
            TEST_ASSERT_DOUBLE_WITHIN(bound, expected, hysteresis_step(&state, input[i], 0.1));
        }
        hysteresis_state_free(&state);
        reference_free(&reference);
        hysteresis_free(&hysteresis);
        model_free(&any);
    }
}

/// The same piecewise linear input with more samples, evenly or not, against the coarse one at the coarse
/// samples.
static void same_at_any_sample_rate(const double* sub, size_t num_sub)
{
    record_t fine = effect_case_record(sub, num_sub);
    effect_run_t fine_run = effect_run_new(&model, &fine, true);
    double* fine_output = xcalloc(fine.num_samples, sizeof(double));
    for (size_t c = 0; c < effect_case_count(); ++c) {
        const effect_use_t use = effect_case_use(effect_case_at(c));
        effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &use, 1, output);
        effect_simulate(&fine_run, &model, START_NEGATIVE_SATURATION, &use, 1, fine_output);
        double largest = 0.0;
        for (size_t i = 0; i < CASE_SAMPLES; ++i) {
            largest = fmax(largest, fabs(output[i] - fine_output[i * (num_sub + 1)]));
        }
        TEST_ASSERT_TRUE_MESSAGE(largest <= effect_case_bound(effect_case_at(c), &model, &record),
                                 use.effect->name);
    }
    free(fine_output);
    effect_run_free(&fine_run);
    record_free(&fine);
}

/// With straight envelopes everything inside a viscous play is linear between the samples, so that its exact
/// step must give the same in one long step as in ten, time constants above and below the step alike.
static void viscous_plays_are_exact(void)
{
    enum { LONG = 40, PART = 10, COUNT = LONG * PART + 1 };
    double time[COUNT];
    double input[COUNT];
    double fine[COUNT];
    random_t random = random_new(7);
    model_t classical = random_classical_model(&random);
    random_input(&random, &classical, fine, LONG + 1);
    for (size_t i = 0; i < COUNT; ++i) {
        const double part = (double)(i % PART) / PART;
        const double to = i / PART < LONG ? fine[i / PART + 1] : 0.0;
        time[i] = (double)i / PART;
        input[i] = (1.0 - part) * fine[i / PART] + part * to;
    }
    const double taus[] = {0.05, 0.5, 5.0};
    for (size_t k = 0; k < 3; ++k) {
        hysteresis_t hysteresis = hysteresis_neutral();
        hysteresis.play_lag = taus[k];
        hysteresis_run(&classical, START_NEGATIVE_SATURATION, &hysteresis, time, input, COUNT, fine);
        hysteresis_state_t state =
            hysteresis_start(&classical, START_NEGATIVE_SATURATION, &hysteresis, input[0]);
        for (size_t i = PART; i < COUNT; i += PART) {
            // Each of the PART steps adds its own rounding.
            TEST_ASSERT_DOUBLE_WITHIN(PART * LONG * output_rounding(&classical), fine[i],
                                      hysteresis_step(&state, input[i], 1.0));
        }
        hysteresis_state_free(&state);
    }
    model_free(&classical);
}

/// A ramp u = t from rest, in steps below and above the time constants: the lag gives t - tau (1 -
/// e^(-t/tau)), the mode t - 2 z/w + e^(-z w t) (2 z/w cos(q t) - (1 - 2 z^2)/q sin(q t)) with q = w sqrt(1 -
/// z^2).
static void ramps_are_exact_at_any_step(void)
{
    enum { COUNT = 12 };
    double time[COUNT];
    double lagged[COUNT];
    double ringing[COUNT];
    const effect_case_t lag = {"output_lag", NULL, {0.3}, 1.0};
    const effect_case_t mode = {"resonance", NULL, {0.4, 0.2}, 1.0};
    const double w = 6.283185307179586 * 0.4;
    const double q = w * sqrt(1.0 - 0.2 * 0.2);
    for (size_t i = 0; i < COUNT; ++i) {
        time[i] = 0.5 * (double)i + (i % 2 == 0 ? 0.0 : 0.3);
        lagged[i] = time[i];
        ringing[i] = time[i];
    }
    const effect_run_t ramp = {.num_samples = COUNT, .time = time};
    const effect_use_t lag_use = effect_case_use(&lag);
    const effect_use_t mode_use = effect_case_use(&mode);
    effect_use_apply(&ramp, &lag_use, lagged);
    effect_use_apply(&ramp, &mode_use, ringing);
    for (size_t i = 0; i < COUNT; ++i) {
        const double t = time[i];
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, t - 0.3 * (1.0 - exp(-t / 0.3)), lagged[i]);
        const double free_part = 0.4 / w * cos(q * t) - (1.0 - 0.08) / q * sin(q * t);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, t - 0.4 / w + exp(-0.2 * w * t) * free_part, ringing[i]);
    }
}

static void three_times_the_rate_gives_the_same(void)
{
    same_at_any_sample_rate((const double[]){1.0 / 3.0, 2.0 / 3.0}, 2);
}

static void uneven_samples_give_the_same(void)
{
    same_at_any_sample_rate((const double[]){0.03, 0.4, 0.9}, 3);
}

/// A search's run is the plain one but for its tables, which are off by h^2/8 |curve''| <= 1e-7 a play in
/// cells of h = 1/1024, and a mean field, which ends when an iteration changes what the plays see by less
/// than 1e-5 of the range: with a loop gain below a half the rest is no more, and the output follows it with
/// its steepest slope. Where a sample hits another side of a step of `quantization`, a step.
static void searches_run_the_same(void)
{
    fast_plays_t* fast = fast_plays_new(&model, START_NEGATIVE_SATURATION);
    const double slope = effect_case_speed(&model, &record) / run.input_rate;
    for (size_t c = 0; c < effect_case_count(); ++c) {
        const effect_case_t* of = effect_case_at(c);
        const effect_use_t use = effect_case_use(of);
        const bool rounds = strcmp(of->name, "quantization") == 0;
        effect_run_t search = run;
        search.fast = fast;
        effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &use, 1, plain);
        effect_simulate(&search, &model, START_NEGATIVE_SATURATION, &use, 1, output);
        const double bound =
            fmax(of->gain, 1.4) * (8e-7 + 1e-5 * run.input_span * slope) + (rounds ? of->parameter[0] : 0.0);
        const double difference = largest_difference(plain, output, record.num_samples);
        char text[120];
        (void)snprintf(text, sizeof text, "%s %s: %.3g above %.3g", of->name,
                       of->mechanism != NULL ? of->mechanism : "", difference, bound);
        TEST_ASSERT_TRUE_MESSAGE(difference <= bound, text);
    }
    fast_plays_free(fast);
}

/// Where another body stands in, another start is that body's own, and a mean field beside it adds what it
/// adds to the plays: both as searches and as the model run them, to what searches_run_the_same allows.
static void a_mean_field_acts_beside_another_start(void)
{
    const effect_use_t uses[2] = {
        effect_case_use(&(effect_case_t){"noncongruency", "remanence_field", {0.15}, 1.3}),
        effect_case_use(&(effect_case_t){"initial_state", NULL, {0.4, 0.5, 0.6, 0.7, 0.6, 0.5}, 1.0})};
    const stand_in_t body = {.duhem = duhem_new(&model)};
    static double with_field[CASE_SAMPLES];
    static double without[CASE_SAMPLES];
    fast_plays_t* fast = fast_plays_new(&model, START_NEGATIVE_SATURATION);
    effect_run_t search = run;
    search.fast = fast;
    search.body = &body;
    effect_simulate(&search, &model, START_NEGATIVE_SATURATION, uses, 2, with_field);
    effect_simulate(&search, &model, START_NEGATIVE_SATURATION, &uses[1], 1, without);
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, uses, 1, output);
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, NULL, 0, plain);
    for (size_t i = 0; i < record.num_samples; ++i) {
        with_field[i] -= without[i];
        output[i] -= plain[i];
    }
    const double slope = effect_case_speed(&model, &record) / run.input_rate;
    const double bound = 2.0 * 1.4 * (8e-7 + 1e-5 * run.input_span * slope);
    TEST_ASSERT_TRUE(largest_difference(with_field, output, record.num_samples) <= bound);
    memset(plain, 0, record.num_samples * sizeof(double));
    TEST_ASSERT_TRUE(largest_difference(output, plain, record.num_samples) > 10.0 * bound);
    fast_plays_free(fast);
}

/// Run around its range, the model itself has the middle that it has in closed form.
static void the_major_loop_of_a_body_is_run(void)
{
    loop_middle_t* found = effect_run_find_middle(&run, &model, START_NEGATIVE_SATURATION);
    for (int i = 0; i <= 100; ++i) {
        const double v = run.input_min + run.input_span * i / 100.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, loop_middle_at(run.middle, v), loop_middle_at(found, v));
    }
    loop_middle_free(found);
}

/// What a plant of Preisach's kind adds sees the input as late as the plays do.
static void a_difference_of_preisach_s_kind_is_delayed_with_the_plays(void)
{
    everett_t everett = everett_none(&model);
    for (size_t k = 0; k < EVERETT_FREE; ++k) {
        everett.value[k] = 0.1 * sin((double)k);
    }
    effect_run_t search = run;
    search.everett = &everett;
    effect_simulate(&search, &model, START_NEGATIVE_SATURATION, NULL, 0, plain);
    const effect_use_t use = effect_case_use(&(effect_case_t){"delay", NULL, {3.0 * run.sample_time}, 1.0});
    effect_simulate(&search, &model, START_NEGATIVE_SATURATION, &use, 1, output);
    // Times are sums of steps: an interpolated input is a few roundings off.
    for (size_t i = 3; i < record.num_samples; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, plain[i - 3], output[i]);
    }
}

/// Or refuses it where it is no effect of the catalogue.
static void json_gives_the_use_back(void)
{
    for (size_t c = 0; c < effect_case_count(); ++c) {
        effect_use_t use = effect_case_use(effect_case_at(c));
        use.has_reference = use.effect->needs_column;
        use.reference = use.has_reference ? 21.5 : 0.0;
        model.effects = json_pack("[o]", effect_use_to_json(&use));
        TEST_ASSERT_NULL(effect_fault(model.effects).key);
        effect_use_t* uses;
        size_t num_uses;
        if (use.effect->outside != NULL) {
            TEST_ASSERT_EQUAL_INT(OUTCOME_BAD_INPUT,
                                  effect_uses_of_model(&model, "model.json", &uses, &num_uses));
            json_decref(model.effects);
            model.effects = NULL;
            continue;
        }
        TEST_ASSERT_EQUAL_INT(OUTCOME_OK, effect_uses_of_model(&model, "model.json", &uses, &num_uses));
        TEST_ASSERT_EQUAL_UINT(1, num_uses);
        TEST_ASSERT_EQUAL_PTR(use.effect, uses[0].effect);
        TEST_ASSERT_EQUAL_MEMORY(use.parameter, uses[0].parameter, sizeof use.parameter);
        TEST_ASSERT_EQUAL_STRING(use.column, uses[0].column);
        TEST_ASSERT_EQUAL_DOUBLE(use.reference, uses[0].reference);
        free(uses);
        json_decref(model.effects);
        model.effects = NULL;
    }
}

/// A program's filter takes each sample as it comes: y += (1 - exp(-h / tau)) (x - y).
static void a_held_lag_is_a_sampled_filter(void)
{
    const double tau = 0.02;
    const effect_use_t use = effect_case_use(&(effect_case_t){"output_lag", NULL, {tau, 0.0, 1.0}, 1.0});
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &use, 1, output);
    double y = plain[0];
    for (size_t i = 1; i < run.num_samples; ++i) {
        y += -expm1(-(run.time[i] - run.time[i - 1]) / tau) * (plain[i] - y);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, y, output[i]);
    }
}

/// So are viscous plays that are held: each sample moves a play by 1 - exp(-h / tau_j) of the way to where
/// the strip of that sample would put it.
static void held_viscous_plays_are_sampled_filters(void)
{
    const double tau = 0.02;
    const double spread = 0.7;
    const effect_use_t use =
        effect_case_use(&(effect_case_t){"rate_dependence", "play_lag", {tau, spread, 0.0, 0.0, 1.0}, 1.0});
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &use, 1, output);
    reference_t start = reference_new(&model, START_NEGATIVE_SATURATION, record.input[0]);
    for (size_t i = 1; i < run.num_samples; ++i) {
        const double v = record.input[i];
        const double low = curve_value(&model.ascending, v);
        const double high = curve_value(&model.descending, v);
        double y = curve_value(&model.nonhysteretic, v);
        for (size_t j = 0; j < model.num_plays; ++j) {
            const double r = model.radius[j];
            const double slow = tau * (1.0 + spread * r / model.radius[model.num_plays - 1]);
            const double target = fmin(fmax(start.memory[j], low - r), high + r);
            start.memory[j] += -expm1(-(run.time[i] - run.time[i - 1]) / slow) * (target - start.memory[j]);
            y += model.weight[j] * start.memory[j];
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, y, output[i]);
    }
    reference_free(&start);
}

/// The cases with a course between the samples; hold and late are the last of their parameters. A mode of six
/// samples' period.
static const effect_case_t held_cases[] = {
    {"rate_dependence", "diffusion", {0.15, 0.3, 0.6}, 1.0},
    {"rate_dependence", "excess", {0.15, 0.3, 0.6}, 1.0},
    {"resonance", NULL, {41.7, 0.1, 0.12, 0.3, 0.4}, 6.4},
};
enum { NUM_HELD = sizeof held_cases / sizeof held_cases[0], HELD_MODE = NUM_HELD - 1 };

/// A course that is straight but for what it does within `sudden` of each sample: from[i] + hold of the step
/// just after a sample, without `late` of the rest just before the next.
static void bend_course(const double* straight, double hold, double late, double* bent)
{
    for (size_t i = 0; i + 1 < CASE_SAMPLES; ++i) {
        const double step = straight[3 * i + 3] - straight[3 * i];
        bent[3 * i + 1] = straight[3 * i] + hold * step;
        bent[3 * i + 2] = straight[3 * i + 3] - late * (1.0 - hold) * step;
    }
}

/// Within this part of a sample's time a course bends.
static const double sudden = 1e-6;

/// The case as its parameters say, in output[], and without those of the course, run over the bent one, in
/// bent_output[3 i]. What moves within `sudden` of a sample's time instead of at it comes later by that part
/// of it: `sudden` samples' motion, twice.
static void check_course(const effect_case_t* of, const double* bent_output)
{
    const double motion = effect_case_speed(&model, &record) * run.sample_time;
    for (size_t i = 0; i < CASE_SAMPLES; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(of->gain * 2.0 * sudden * motion, bent_output[3 * i], output[i],
                                          of->mechanism != NULL ? of->mechanism : of->name);
    }
}

static void a_held_field_is_as_if_sampled(void)
{
    record_t fine = effect_case_record((const double[]){sudden, 1.0 - sudden}, 2);
    double* straight = xcalloc(fine.num_samples, sizeof(double));
    double* bent_output = xcalloc(fine.num_samples, sizeof(double));
    memcpy(straight, fine.input, fine.num_samples * sizeof(double));
    for (size_t c = 0; c < HELD_MODE; ++c) {
        effect_use_t use = effect_case_use(&held_cases[c]);
        double* hold = &use.parameter[use.effect->num_parameters - 1];
        effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &use, 1, output);
        bend_course(straight, *hold, 0.0, fine.input);
        *hold = 0.0;
        effect_run_t fine_run = effect_run_new(&model, &fine, true);
        effect_simulate(&fine_run, &model, START_NEGATIVE_SATURATION, &use, 1, bent_output);
        check_course(&held_cases[c], bent_output);
        effect_run_free(&fine_run);
    }
    free(straight);
    free(bent_output);
    record_free(&fine);
}

/// Its course is the output, as the samples tell.
static void a_held_mode_is_as_if_sampled(void)
{
    record_t fine = effect_case_record((const double[]){sudden, 1.0 - sudden}, 2);
    effect_run_t fine_run = effect_run_new(&model, &fine, true);
    double* course = xcalloc(fine.num_samples, sizeof(double));
    effect_use_t use = effect_case_use(&held_cases[HELD_MODE]);
    double* between = &use.parameter[use.effect->num_parameters - 2];
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &use, 1, output);
    for (size_t i = 0; i < CASE_SAMPLES; ++i) {
        course[3 * i] = plain[i];
    }
    bend_course(course, between[0], between[1], course);
    between[0] = 0.0;
    between[1] = 0.0;
    effect_use_apply(&fine_run, &use, course);
    check_course(&held_cases[HELD_MODE], course);
    free(course);
    effect_run_free(&fine_run);
    record_free(&fine);
}

/// An offset of 1 a degree shows what of a thermometer's noise a plant is taken to feel. A parabola over 41
/// samples leaves 9 / (4 * 41) of the noise's mean square inside; the ends, a hundredth of the record, up to
/// 9 / 20.
static void a_sensors_noise_is_not_felt(void)
{
    static const double noise = 0.05;
    random_t random = random_new(12);
    effect_use_t use = {.column = "temperature", .has_reference = true, .reference = 20.0};
    for (size_t e = 0; e < effect_count(); ++e) {
        use.effect =
            effect_at(e)->needs_column && effect_at(e)->mechanism == NULL ? effect_at(e) : use.effect;
    }
    use.parameter[1] = 1.0;
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &use, 1, output);
    for (size_t i = 0; i < CASE_SAMPLES; ++i) {
        record.auxiliary[0].value[i] += noise * random_normal(&random);
    }
    effect_run_t noisy_run = effect_run_new(&model, &record, true);
    double* felt = xcalloc(CASE_SAMPLES, sizeof(double));
    effect_simulate(&noisy_run, &model, START_NEGATIVE_SATURATION, &use, 1, felt);
    const double part = 9.0 / (4.0 * 41.0) + 0.01 * 9.0 / 20.0;
    TEST_ASSERT_TRUE(series_mean_square(felt, output, CASE_SAMPLES) < part * noise * noise);
    free(felt);
    effect_run_free(&noisy_run);
}

static double seen_after(const field_t* field, field_state_t state, double input)
{
    field_move(field, &state, input, 0.004);
    return state.seen;
}

/// What the plays see rises with the input however little that moves, also far behind a slow input (the
/// inverse halves between such): rounding of numbers up to 2 aside.
static void a_field_inside_rises_with_the_input(void)
{
    const double holds[] = {0.0, 0.5, 1.0 - 1e-9, 1.0 - 1e-12, 1.0};
    for (size_t h = 0; h < sizeof holds / sizeof holds[0]; ++h) {
        const field_t field = {.excess = 0.15, .hold = holds[h]};
        field_state_t state = field_start(2.0);
        field_move(&field, &state, 0.0, 0.004);
        double before = seen_after(&field, state, 0.0);
        TEST_ASSERT_TRUE(before > 0.0);
        for (double move = 1e-17; move < 2.0; move *= 3.0) {
            const double seen = seen_after(&field, state, move);
            TEST_ASSERT_TRUE(seen >= before - 8.0 * DBL_EPSILON);
            before = seen;
        }
    }
}

/// Behind a diffusion the excess field's own hold says nothing; an entry of 0 changes nothing.
static void a_diffusion_s_hold_counts(void)
{
    const effect_use_t diffusion =
        effect_case_use(&(effect_case_t){"rate_dependence", "diffusion", {0.1, 0.25, 0.7}, 1.0});
    const effect_use_t excess =
        effect_case_use(&(effect_case_t){"rate_dependence", "excess", {0.1, 0.5, 0.3}, 1.0});
    effect_use_t none = excess;
    none.parameter[0] = 0.0;
    const effect_use_t orders[2][3] = {{diffusion, excess, none}, {none, excess, diffusion}};
    for (size_t k = 0; k < 2; ++k) {
        hysteresis_t both = effect_hysteresis(&run, orders[k], 3);
        TEST_ASSERT_EQUAL_DOUBLE(0.7, both.field.hold);
        TEST_ASSERT_DOUBLE_WITHIN(4.0 * DBL_EPSILON, 1.0 - 0.75 * 0.5, both.field.share);
        hysteresis_free(&both);
    }
    const effect_use_t last[] = {excess, none};
    hysteresis_t one = effect_hysteresis(&run, last, 2);
    TEST_ASSERT_EQUAL_DOUBLE(0.3, one.field.hold);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, one.field.share);
    hysteresis_free(&one);
}

/// Each of two coercive fields takes its own share of the nonhysteretic part along, in either order.
static void coercive_fields_keep_their_shares(void)
{
    const effect_use_t one =
        effect_case_use(&(effect_case_t){"exogenous", "coercive_field", {0.04, 0.0, 0.3}, 1.0});
    const effect_use_t other =
        effect_case_use(&(effect_case_t){"exogenous", "coercive_field", {0.02, 0.0, 1.0}, 1.0});
    const effect_use_t orders[2][2] = {{one, other}, {other, one}};
    for (size_t k = 0; k < 2; ++k) {
        hysteresis_t both = effect_hysteresis(&run, orders[k], 2);
        for (size_t i = 0; i < record.num_samples; ++i) {
            const double q = both.coercive[i] / (0.04 + 0.02);
            TEST_ASSERT_DOUBLE_WITHIN(8.0 * DBL_EPSILON * fabs(q), (0.3 * 0.04 + 0.02) * q,
                                      both.coercive_direct[i]);
        }
        hysteresis_free(&both);
    }
}

/// A width that is 0 leaves plays that trail where they are, and nothing is read beyond its one sample.
static void a_past_at_speed_needs_no_column(void)
{
    hysteresis_t hysteresis = hysteresis_neutral();
    hysteresis.play_lag = 0.1;
    hysteresis.approach = 5.0;
    hysteresis_run(&model, START_NEGATIVE_SATURATION, &hysteresis, record.time, record.input, 1, plain);
    hysteresis.width = xcalloc(1, sizeof(double));
    hysteresis_run(&model, START_NEGATIVE_SATURATION, &hysteresis, record.time, record.input, 1, output);
    TEST_ASSERT_EQUAL_DOUBLE(plain[0], output[0]);
    hysteresis_free(&hysteresis);
}

/// An approach that takes no time leaves the plays where it began: at the upper end of their strips there, or
/// at the lower one.
static void a_past_beyond_the_range_begins_at_the_strips_other_end(void)
{
    for (int beyond = 0; beyond < 2; ++beyond) {
        const double end = beyond == 1 ? curve_value(&model.descending, model.input_max)
                                       : curve_value(&model.ascending, model.input_max);
        const double sign = beyond == 1 ? 1.0 : -1.0;
        double expected = curve_value(&model.nonhysteretic, record.input[0]);
        for (size_t j = 0; j < model.num_plays; ++j) {
            expected += model.weight[j] * (end + sign * model.radius[j]);
        }
        hysteresis_t hysteresis = hysteresis_neutral();
        hysteresis.play_lag = 0.1;
        hysteresis.approach = 1e12;
        hysteresis.beyond = beyond;
        hysteresis_run(&model, START_NEGATIVE_SATURATION, &hysteresis, record.time, record.input, 1, output);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, expected, output[0]);
    }
}

/// Without a reference the column counts from its first value, with one from there.
static void the_reference_shifts_the_column(void)
{
    effect_use_t use = effect_case_use(&(effect_case_t){"exogenous", NULL, {0.0, 0.5}, 0.0});
    use.has_reference = true;
    use.reference = 18.0;
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &use, 1, output);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, plain[0] + 0.5 * (20.0 - 18.0), output[0]);
}

/// Uses are applied in the catalogue's order whatever order they come in: lag, then clip.
static void order_is_the_catalogue_s(void)
{
    effect_use_t uses[2] = {effect_case_use(&(effect_case_t){"output_saturation", NULL, {-0.5, 0.5}, 1.0}),
                            effect_case_use(&(effect_case_t){"output_lag", NULL, {0.5}, 1.0})};
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, uses, 2, output);
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &uses[1], 1, plain);
    for (size_t i = 0; i < record.num_samples; ++i) {
        TEST_ASSERT_EQUAL_DOUBLE(fmax(-0.5, fmin(0.5, plain[i])), output[i]);
    }
}

/// What the model itself gave can be asked for again: within what two right computations may differ by.
static void inverse_gives_back(const effect_case_t* of, double* command, double* clamped, double* again)
{
    const effect_use_t use = effect_case_use(of);
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &use, 1, output);
    effect_invert(&run, &model, START_NEGATIVE_SATURATION, &use, 1, output, command, clamped);
    effect_run_t back = run;
    back.input = command;
    effect_simulate(&back, &model, START_NEGATIVE_SATURATION, &use, 1, again);
    double largest = 0.0;
    size_t num_clamped = 0;
    for (size_t i = 0; i < record.num_samples; ++i) {
        num_clamped += clamped[i] > 0.0 ? 1 : 0;
        largest = fmax(largest, fabs(again[i] - output[i]));
    }
    char text[120];
    (void)snprintf(text, sizeof text, "%s %s: %.3g, %zu clamped", use.effect->name,
                   use.effect->mechanism != NULL ? use.effect->mechanism : "", largest, num_clamped);
    TEST_ASSERT_TRUE_MESSAGE(largest <= effect_case_bound(of, &model, &record), text);
    TEST_ASSERT_EQUAL_UINT_MESSAGE(0, num_clamped, text);
    // And nearer than what the effect changes, where it changes anything.
    TEST_ASSERT_TRUE_MESSAGE(largest <= 0.5 * largest_difference(plain, output, record.num_samples), text);
}

static void inverse_gives_the_wanted_output(void)
{
    double* command = xcalloc(record.num_samples, sizeof(double));
    double* clamped = xcalloc(record.num_samples, sizeof(double));
    double* again = xcalloc(record.num_samples, sizeof(double));
    for (size_t c = 0; c < effect_case_count() + NUM_HELD; ++c) {
        const effect_case_t* of = c < NUM_HELD ? &held_cases[c] : effect_case_at(c - NUM_HELD);
        if (effect_case_use(of).effect->no_inverse == NULL) {
            inverse_gives_back(of, command, clamped, again);
        }
    }
    free(command);
    free(clamped);
    free(again);
}

/// The limits' promises, for every effect.
static void limits_hold_their_starts(void)
{
    for (size_t c = 0; c < effect_case_count(); ++c) {
        const effect_use_t use = effect_case_use(effect_case_at(c));
        for (size_t p = 0; p < use.effect->num_parameters; ++p) {
            const effect_limits_t limits = effect_use_limits(&run, &use, p);
            TEST_ASSERT_TRUE_MESSAGE(limits.low < limits.high, use.effect->name);
            TEST_ASSERT_TRUE(limits.low >= use.effect->parameter[p].least - DBL_MIN);
            TEST_ASSERT_TRUE(limits.high <= use.effect->parameter[p].most);
            TEST_ASSERT_TRUE(limits.neutral >= limits.low && limits.neutral <= limits.high);
            TEST_ASSERT_TRUE(!limits.logarithmic || limits.low > 0.0);
            for (size_t s = 0; s < 3; ++s) {
                TEST_ASSERT_TRUE(limits.start[s] >= limits.low && limits.start[s] <= limits.high);
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_effect_has_its_case);
    RUN_TEST(neutral_parameters_change_nothing);
    RUN_TEST(stepping_plays_is_the_reference);
    RUN_TEST(viscous_plays_are_exact);
    RUN_TEST(ramps_are_exact_at_any_step);
    RUN_TEST(three_times_the_rate_gives_the_same);
    RUN_TEST(uneven_samples_give_the_same);
    RUN_TEST(searches_run_the_same);
    RUN_TEST(a_mean_field_acts_beside_another_start);
    RUN_TEST(the_major_loop_of_a_body_is_run);
    RUN_TEST(a_difference_of_preisach_s_kind_is_delayed_with_the_plays);
    RUN_TEST(json_gives_the_use_back);
    RUN_TEST(a_held_lag_is_a_sampled_filter);
    RUN_TEST(held_viscous_plays_are_sampled_filters);
    RUN_TEST(a_held_field_is_as_if_sampled);
    RUN_TEST(a_held_mode_is_as_if_sampled);
    RUN_TEST(a_sensors_noise_is_not_felt);
    RUN_TEST(a_field_inside_rises_with_the_input);
    RUN_TEST(a_diffusion_s_hold_counts);
    RUN_TEST(coercive_fields_keep_their_shares);
    RUN_TEST(a_past_at_speed_needs_no_column);
    RUN_TEST(a_past_beyond_the_range_begins_at_the_strips_other_end);
    RUN_TEST(the_reference_shifts_the_column);
    RUN_TEST(order_is_the_catalogue_s);
    RUN_TEST(inverse_gives_the_wanted_output);
    RUN_TEST(limits_hold_their_starts);
    return UNITY_END();
}
