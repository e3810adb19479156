#include "column_course.h"
#include "effect.h"
#include "output_range.h"
#include "reference.h"
#include "sample_steps.h"
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double output_span(const model_t* model, const double* input, size_t num_samples)
{
    double* output = xcalloc(num_samples, sizeof(double));
    reference_run(model, START_MODEL, input, num_samples, output);
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (size_t i = 0; i < num_samples; ++i) {
        low = fmin(low, output[i]);
        high = fmax(high, output[i]);
    }
    free(output);
    return high > low ? high - low : 0.0;
}

static double** courses_of(const record_t* record, const double* time)
{
    double** course = xcalloc(record->num_auxiliary + 1, sizeof *course);
    for (size_t i = 0; i < record->num_auxiliary; ++i) {
        course[i] = column_course(time, record->auxiliary[i].value, record->num_samples);
    }
    return course;
}

effect_run_t effect_run_new(const model_t* model, const record_t* record, bool follows_columns)
{
    const size_t count = record->num_samples;
    effect_run_t run = {.num_samples = count,
                        .time = record->time,
                        .input = record->input,
                        .record = record,
                        .input_min = model->input_min,
                        .input_span = model->input_max - model->input_min,
                        .output_min = model_output_min(model),
                        .output_max = model_output_max(model),
                        .largest_radius = model_largest_moving_radius(model),
                        .middle = loop_middle_new(model)};
    if (record->time == NULL) {
        double* seconds = xcalloc(count, sizeof(double));
        for (size_t i = 0; i < count; ++i) {
            seconds[i] = (double)i;
        }
        run.time = seconds;
    }
    run.course = follows_columns ? courses_of(record, run.time) : NULL;
    run.sample_time = sample_time_of(run.time, count);
    run.duration = count > 1 ? run.time[count - 1] - run.time[0] : run.sample_time;
    run.output_span = run.output_max - run.output_min;
    if (run.input == NULL) {
        return run;
    }
    run.output_span = output_span(model, run.input, count);
    for (size_t i = 1; i < count; ++i) {
        const double move = fabs(run.input[i] - run.input[i - 1]);
        run.travel += move;
        run.input_rate = fmax(run.input_rate, move / (run.time[i] - run.time[i - 1]));
    }
    return run;
}

void effect_run_free(effect_run_t* run)
{
    if (run->record != NULL && run->time != run->record->time) {
        free((void*)(uintptr_t)run->time);
    }
    for (size_t i = 0; run->course != NULL && i < run->record->num_auxiliary; ++i) {
        free(run->course[i]);
    }
    free(run->course);
    loop_middle_free((loop_middle_t*)(uintptr_t)run->middle);
    *run = (effect_run_t){0};
}

outcome_t effect_check_columns(const record_t* record, const effect_use_t* uses, size_t num_uses)
{
    for (size_t u = 0; u < num_uses; ++u) {
        if (!uses[u].effect->needs_column || record_find_auxiliary(record, uses[u].column) != NULL) {
            continue;
        }
        char names[200] = "";
        size_t length = 0;
        for (size_t i = 0; i < record->num_auxiliary && length < sizeof names - 1; ++i) {
            const int written = snprintf(names + length, sizeof names - length, "%s\"%s\"", i > 0 ? ", " : "",
                                         record->auxiliary[i].name);
            length += written > 0 ? (size_t)written : 0;
        }
        return message_error(
            OUTCOME_BAD_INPUT, (location_t){.file = record->path},
            "the model's effect \"%s\" follows a column \"%s\" of numbers, which the record does not "
            "have; its auxiliary columns: %s",
            uses[u].effect->name, uses[u].column, names[0] != '\0' ? names : "none");
    }
    return OUTCOME_OK;
}

double* effect_use_column(const effect_run_t* run, const effect_use_t* use)
{
    const column_t* column = use->effect->needs_column && run->record != NULL
                                 ? record_find_auxiliary(run->record, use->column)
                                 : NULL;
    if (column == NULL) {
        return NULL;
    }
    const double* course = run->course[column - run->record->auxiliary];
    const double reference = use->has_reference ? use->reference : course[0];
    double* centred = xcalloc(run->num_samples, sizeof(double));
    for (size_t i = 0; i < run->num_samples; ++i) {
        centred[i] = course[i] - reference;
    }
    return centred;
}

void effect_use_apply(const effect_run_t* run, const effect_use_t* use, double* series)
{
    double* column = effect_use_column(run, use);
    use->effect->apply(run, use->parameter, column, series);
    free(column);
}

void effect_use_invert(const effect_run_t* run, const effect_use_t* use, double* series)
{
    double* column = effect_use_column(run, use);
    use->effect->invert(run, use->parameter, column, series);
    free(column);
}

effect_limits_t effect_use_limits(const effect_run_t* run, const effect_use_t* use, size_t parameter)
{
    effect_limits_t limits;
    use->effect->limits(run, parameter, &limits);
    double* column = effect_use_column(run, use);
    double size = 0.0;
    for (size_t i = 0; column != NULL && i < run->num_samples; ++i) {
        size = fmax(size, fabs(column[i]));
    }
    free(column);
    // What is counted per unit of the column, as its unit says.
    if (size > 0.0 && strstr(use->effect->parameter[parameter].unit, "/column") != NULL) {
        limits = (effect_limits_t){
            .low = limits.low / size,
            .high = limits.high / size,
            .neutral = limits.neutral / size,
            .start = {limits.start[0] / size, limits.start[1] / size, limits.start[2] / size}};
    }
    return limits;
}

/// The uses of one stage in the catalogue's order, among equals in the given one.
static void apply_stage(const effect_run_t* run, const effect_use_t* uses, size_t num_uses,
                        effect_stage_t stage, double* series)
{
    for (size_t e = 0; e < effect_count(); ++e) {
        const effect_t* effect = effect_at(e);
        for (size_t u = 0; effect->stage == stage && u < num_uses; ++u) {
            if (uses[u].effect == effect && effect->apply != NULL) {
                effect_use_apply(run, &uses[u], series);
            }
        }
    }
}

hysteresis_t effect_hysteresis(const effect_run_t* run, const effect_use_t* uses, size_t num_uses)
{
    hysteresis_t hysteresis = hysteresis_neutral();
    hysteresis.middle = run->body_middle != NULL ? run->body_middle : run->middle;
    for (size_t u = 0; u < num_uses; ++u) {
        if (uses[u].effect->configure != NULL) {
            double* column = effect_use_column(run, &uses[u]);
            uses[u].effect->configure(run, uses[u].parameter, column, &hysteresis);
            free(column);
        }
    }
    return hysteresis;
}

/// Of the body that stands in, or of the model where that is NULL.
static double nonhysteretic_at(const effect_run_t* run, const model_t* model, const stand_in_t* body,
                               double v)
{
    if (body != NULL) {
        return stand_in_nonhysteretic(body, model, v);
    }
    return run->fast != NULL ? fast_plays_nonhysteretic(run->fast, v) : curve_value(&model->nonhysteretic, v);
}

/// What parts of the material see of the drive: of the field inside a share of the nonhysteretic part, and
/// what the hysteretic part sees.
typedef struct {
    double *field, *seen; ///< [num_samples], allocated together
} sight_t;

static sight_t sight_of(const effect_run_t* run, const model_t* model, const hysteresis_t* hysteresis,
                        const double* drive)
{
    const size_t n = run->num_samples;
    double* field = xmalloc(2 * n * sizeof(double));
    const sight_t sight = {field, field + n};
    hysteresis_field(hysteresis, run->time, drive, n, sight.field);
    for (size_t i = 0; i < n; ++i) {
        sight.seen[i] = hysteresis_seen(hysteresis, model, i, sight.field[i]);
        sight.seen[i] += hysteresis->shift != NULL ? hysteresis->shift[i] : 0.0;
    }
    return sight;
}

static void sight_free(sight_t* sight)
{
    free(sight->field);
}

/// Adds what the nonhysteretic part gives for the drive and its shares of field and shift beyond what it
/// would give for what the hysteretic part sees.
static void add_direct(const effect_run_t* run, const model_t* model, const stand_in_t* body,
                       const hysteresis_t* hysteresis, const double* drive, const sight_t* sight,
                       double* output)
{
    const double share = hysteresis->field.share;
    for (size_t i = 0; i < run->num_samples; ++i) {
        const double seen = sight->seen[i];
        if (drive[i] < seen || drive[i] > seen) {
            const double field = sight->field[i];
            const double shift =
                (hysteresis->shift != NULL ? hysteresis->shift_share * hysteresis->shift[i] : 0.0) -
                hysteresis_set_back(hysteresis, model, i, field);
            const double direct = nonhysteretic_at(run, model, body, drive[i] + shift);
            const double shared = share > 0.0 ? nonhysteretic_at(run, model, body, field + shift) : direct;
            output[i] += direct + share * (shared - direct) - nonhysteretic_at(run, model, body, seen);
        }
    }
}

/// The plays' sums over what they see, after the turns of their past.
static void run_fast_plays(const effect_run_t* run, const hysteresis_t* hysteresis, const double* seen,
                           double* sum)
{
    const size_t before = hysteresis->num_turns;
    if (before == 0) {
        fast_plays_run(run->fast, seen, run->num_samples, sum);
        return;
    }
    const size_t count = before + run->num_samples;
    double* course = xmalloc(2 * count * sizeof(double));
    memcpy(course, hysteresis->turn, before * sizeof(double));
    memcpy(course + before, seen, run->num_samples * sizeof(double));
    fast_plays_run(run->fast, course, count, course + count);
    memcpy(sum, course + count + before, run->num_samples * sizeof(double));
    free(course);
}

static void run_fast(const effect_run_t* run, const model_t* model, const hysteresis_t* hysteresis,
                     const double* drive, double* output)
{
    double* sum = xmalloc(run->num_samples * sizeof(double));
    sight_t sight = sight_of(run, model, hysteresis, drive);
    run_fast_plays(run, hysteresis, sight.seen, sum);
    for (size_t i = 0; i < run->num_samples; ++i) {
        output[i] = nonhysteretic_at(run, model, NULL, sight.seen[i]);
    }
    add_direct(run, model, NULL, hysteresis, drive, &sight, output);
    hysteresis_from_sums(model, hysteresis, drive, sum, run->num_samples, output);
    sight_free(&sight);
    free(sum);
}

/// The model's hysteresis over the drive's output.
static void run_plays(const effect_run_t* run, const model_t* model, start_t start,
                      const hysteresis_t* hysteresis, const double* drive, double* output)
{
    if (run->fast != NULL && hysteresis_keeps_plays(hysteresis)) {
        run_fast(run, model, hysteresis, drive, output);
    } else {
        hysteresis_run(model, start, hysteresis, run->time, drive, run->num_samples, output);
    }
}

/// The body that stands in, on what it sees: output[num_samples], its first one raised by `shift`.
static void run_body_alone(const effect_run_t* run, const model_t* model, start_t start,
                           const hysteresis_t* hysteresis, double shift, const double* drive, double* output)
{
    sight_t sight = sight_of(run, model, hysteresis, drive);
    stand_in_run(run->body, model, start, shift, sight.seen, run->num_samples, output);
    add_direct(run, model, run->body, hysteresis, drive, &sight, output);
    sight_free(&sight);
}

/// The body that stands in, and what the effects change in the plays beyond what they see. Another memory at
/// the start is this body's own to forget.
static void run_body(const effect_run_t* run, const model_t* model, start_t start, hysteresis_t* hysteresis,
                     const double* drive, double* output)
{
    if (hysteresis_sees_alone(hysteresis)) {
        run_body_alone(run, model, start, hysteresis, 0, drive, output);
        return;
    }
    hysteresis_t neutral = hysteresis_neutral();
    neutral.field = hysteresis->field;
    neutral.coercive = hysteresis->coercive;
    neutral.coercive_direct = hysteresis->coercive_direct;
    neutral.shift = hysteresis->shift;
    neutral.shift_share = hysteresis->shift_share;
    double* plain = xmalloc(run->num_samples * sizeof(double));
    double* body = xmalloc(run->num_samples * sizeof(double));
    run_plays(run, model, start, &neutral, drive, plain);
    double shift = 0;
    if (hysteresis_has_past(hysteresis)) {
        hysteresis_state_t first = hysteresis_start(model, start, hysteresis, drive[0]);
        shift = hysteresis_output(&first) - plain[0];
        hysteresis_state_free(&first);
        hysteresis_forget_past(hysteresis);
    }
    run_plays(run, model, start, hysteresis, drive, output);
    run_body_alone(run, model, start, hysteresis, shift, drive, body);
    for (size_t i = 0; i < run->num_samples; ++i) {
        output[i] += body[i] - plain[i];
    }
    free(plain);
    free(body);
}

/// It has the plays' past and sees what they see, all of it: what its share takes away of the nonhysteretic
/// part its splines give back there.
static void add_everett(const effect_run_t* run, const model_t* model, start_t start,
                        const hysteresis_t* hysteresis, const double* drive, double* output)
{
    sight_t sight = sight_of(run, model, hysteresis, drive);
    const hysteresis_t past = {.turn = hysteresis->turn, .num_turns = hysteresis->num_turns};
    double* plain = xmalloc(run->num_samples * sizeof(double));
    run_plays(run, model, start, &past, sight.seen, plain);
    everett_add(run->everett, past.turn, past.num_turns, sight.seen, plain, run->num_samples, output);
    free(plain);
    sight_free(&sight);
}

static void run_hysteresis(const effect_run_t* run, const model_t* model, start_t start,
                           hysteresis_t* hysteresis, const double* drive, double* output)
{
    if (run->body != NULL) {
        run_body(run, model, start, hysteresis, drive, output);
    } else {
        run_plays(run, model, start, hysteresis, drive, output);
    }
    if (run->everett != NULL) {
        add_everett(run, model, start, hysteresis, drive, output);
    }
}

/// A mean field for searches: what the output adds to what the body sees, to the output that it then gives,
/// until it stays; the first sample is the start's, without it. A play's states move no further than its
/// input did, so where the field's loop gain is below 1 this contracts; it need not go beyond the cells of
/// the searches' tables.
static void run_mean_field(const effect_run_t* run, const model_t* model, start_t start,
                           const hysteresis_t* hysteresis, const double* drive, double* output)
{
    enum { ITERATIONS = 12 };
    const double enough = 1e-5 * run->input_span;
    double* shift = xcalloc(run->num_samples, sizeof(double));
    hysteresis_t inner = *hysteresis;
    inner.remanence_field = 0.0;
    inner.shift = shift;
    double change = HUGE_VAL;
    for (int i = 0; i < ITERATIONS && change > enough; ++i) {
        hysteresis_t each = inner; // a body that stands in takes the past from it
        run_hysteresis(run, model, start, &each, drive, output);
        change = 0.0;
        for (size_t t = 1; t < run->num_samples; ++t) {
            const double next = hysteresis_remanent_shift(hysteresis, model, drive[t], output[t]);
            change = fmax(change, fabs(next - shift[t]));
            shift[t] = next;
        }
    }
    free(shift);
}

void effect_simulate_hysteresis(const effect_run_t* run, const model_t* model, start_t start,
                                const effect_use_t* uses, size_t num_uses, double* output)
{
    if (run->num_samples == 0) {
        return;
    }
    const size_t size = run->num_samples * sizeof(double);
    double* drive = memcpy(xmalloc(size), run->input, size);
    apply_stage(run, uses, num_uses, EFFECT_DRIVE, drive);
    hysteresis_t hysteresis = effect_hysteresis(run, uses, num_uses);
    // Acts on the whole output, whatever body gives it.
    const hysteresis_t stiffness = {.stiffness = hysteresis.stiffness, .middle = hysteresis.middle};
    hysteresis.stiffness = (stiffness_t){0};
    hysteresis_t without_field = hysteresis;
    without_field.remanence_field = 0.0;
    if (fabs(hysteresis.remanence_field) > 0.0 && run->fast != NULL &&
        hysteresis_keeps_plays(&without_field)) {
        run_mean_field(run, model, start, &hysteresis, drive, output);
    } else {
        run_hysteresis(run, model, start, &hysteresis, drive, output);
    }
    for (size_t i = 0; i < run->num_samples; ++i) {
        output[i] = hysteresis_stiffened(&stiffness, model, drive[i], output[i]);
    }
    hysteresis_free(&hysteresis);
    free(drive);
}

void effect_simulate_rest(const effect_run_t* run, const effect_use_t* uses, size_t num_uses, double* series)
{
    if (run->num_samples == 0) {
        return;
    }
    apply_stage(run, uses, num_uses, EFFECT_BODY, series);
    apply_stage(run, uses, num_uses, EFFECT_SENSOR, series);
}

void effect_simulate(const effect_run_t* run, const model_t* model, start_t start, const effect_use_t* uses,
                     size_t num_uses, double* output)
{
    effect_simulate_hysteresis(run, model, start, uses, num_uses, output);
    effect_simulate_rest(run, uses, num_uses, output);
}

loop_middle_t* effect_run_find_middle(const effect_run_t* run, const model_t* model, start_t start)
{
    enum { CELLS = LOOP_MIDDLE_CELLS, SAMPLES = 3 * CELLS + 1 };
    double* series = xmalloc((2 * SAMPLES + CELLS + 1) * sizeof(double));
    double* output = series + SAMPLES;
    double* descending = output + SAMPLES;
    const double cell = run->input_span / CELLS;
    // Up, down and up again: the last two are the major loop.
    for (size_t i = 0; i < SAMPLES; ++i) {
        const size_t into = i % (2 * CELLS);
        series[i] = run->input_min + cell * (double)(into <= CELLS ? into : 2 * CELLS - into);
    }
    effect_run_t loop = *run;
    loop.input = series;
    loop.num_samples = SAMPLES;
    effect_simulate_hysteresis(&loop, model, start, NULL, 0, output);
    for (size_t i = 0; i <= CELLS; ++i) {
        descending[i] = output[2 * CELLS - i];
    }
    loop_middle_t* middle = loop_middle_between(model, output + 2 * CELLS, descending);
    free(series);
    return middle;
}
