#include "effect_cases.h"
#include "fine_plant.h"
#include <cminpack.h>
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

static model_t model;
static record_t record;
static effect_run_t run;
static double* measured;
static double* trial;

void setUp(void)
{
    model = effect_case_model();
    record = effect_case_record(NULL, 0);
    run = effect_run_new(&model, &record, true);
    measured = xcalloc(record.num_samples, sizeof(double));
    trial = xcalloc(record.num_samples, sizeof(double));
}

void tearDown(void)
{
    effect_run_free(&run);
    record_free(&record);
    model_free(&model);
    free(measured);
    free(trial);
}

typedef struct {
    effect_use_t use;
    size_t num;
    effect_limits_t limits[EFFECT_MAX_PARAMETERS];
} search_t;

/// A search variable: the parameter or its logarithm.
static double to_search(const effect_limits_t* limits, double value)
{
    return limits->logarithmic ? log(value) : value;
}

/// A free variable whose sine sweeps the limits, so that the library's unbounded search applies; it starts
/// off the bounds, where the sine stands still.
static double to_free(const effect_limits_t* limits, double variable)
{
    const double low = to_search(limits, limits->low);
    const double high = to_search(limits, limits->high);
    const double part = (variable - low) / (high - low);
    return asin(2.0 * fmin(fmax(part, 0.02), 0.98) - 1.0);
}

static double from_free(const effect_limits_t* limits, double free_variable)
{
    const double low = to_search(limits, limits->low);
    const double high = to_search(limits, limits->high);
    return low + (high - low) * 0.5 * (1.0 + sin(free_variable));
}

/// The model with the search variables x less what was measured.
static void residual(search_t* search, const double* x, double* difference)
{
    for (size_t p = 0; p < search->num; ++p) {
        search->use.parameter[p] = search->limits[p].logarithmic ? exp(x[p]) : x[p];
    }
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, &search->use, 1, difference);
    for (size_t i = 0; i < record.num_samples; ++i) {
        difference[i] -= measured[i];
    }
}

static int free_residual(void* context, int m, int n, const double* x, double* fvec, int iflag)
{
    (void)m;
    (void)n;
    (void)iflag;
    search_t* search = context;
    double variable[EFFECT_MAX_PARAMETERS];
    for (size_t p = 0; p < search->num; ++p) {
        variable[p] = from_free(&search->limits[p], x[p]);
    }
    residual(search, variable, fvec);
    return 0;
}

static double rms(const double* values, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        sum += values[i] * values[i];
    }
    return sqrt(sum / (double)count);
}

/// Levenberg-Marquardt from each of the limits' starts; the best's search variables in best[num].
static void fit(search_t* search, double* best)
{
    const int m = (int)record.num_samples;
    const int n = (int)search->num;
    const int lwa = m * n + 5 * n + m;
    double* wa = xcalloc((size_t)lwa, sizeof(double));
    int iwa[EFFECT_MAX_PARAMETERS];
    double least = HUGE_VAL;
    for (size_t s = 0; s < 3; ++s) {
        double x[EFFECT_MAX_PARAMETERS];
        for (size_t p = 0; p < search->num; ++p) {
            const effect_limits_t* limits = &search->limits[p];
            x[p] = to_free(limits, to_search(limits, limits->start[s]));
        }
        TEST_ASSERT_TRUE(lmdif1(free_residual, search, m, n, x, trial, 1e-12, iwa, wa, lwa) > 0);
        (void)free_residual(search, m, n, x, trial, 1);
        const double left = rms(trial, record.num_samples);
        for (size_t p = 0; left < least && p < search->num; ++p) {
            best[p] = from_free(&search->limits[p], x[p]);
        }
        least = fmin(least, left);
    }
    free(wa);
}

/// How far least squares may be off in each search variable when every datum is off by `error`: a minimiser
/// moves by J^+ r, so by at most |row of J^+| sqrt(m) error = sqrt((J'J)^-1_pp m) error.
static void sensitivity(search_t* search, const double* truth, double error, double* off)
{
    const size_t m = record.num_samples;
    const size_t n = search->num;
    const double step = 1e-4;
    double* jacobian = xcalloc(m * n, sizeof(double));
    double normal[EFFECT_MAX_PARAMETERS * EFFECT_MAX_PARAMETERS];
    for (size_t p = 0; p < n; ++p) {
        double x[EFFECT_MAX_PARAMETERS];
        memcpy(x, truth, n * sizeof(double));
        x[p] += step;
        residual(search, x, &jacobian[p * m]);
        x[p] -= 2.0 * step;
        residual(search, x, trial);
        for (size_t i = 0; i < m; ++i) {
            jacobian[p * m + i] = (jacobian[p * m + i] - trial[i]) / (2.0 * step);
        }
    }
    for (size_t p = 0; p < n; ++p) {
        for (size_t q = 0; q < n; ++q) {
            normal[p * n + q] = 0.0;
            for (size_t i = 0; i < m; ++i) {
                normal[p * n + q] += jacobian[p * m + i] * jacobian[q * m + i];
            }
        }
    }
    free(jacobian);
    const lapack_int size = (lapack_int)n;
    const bool regular = LAPACKE_dpotrf(LAPACK_ROW_MAJOR, 'L', size, normal, size) == 0 &&
                         LAPACKE_dpotri(LAPACK_ROW_MAJOR, 'L', size, normal, size) == 0;
    for (size_t p = 0; p < n; ++p) {
        off[p] = regular ? sqrt(normal[p * n + p] * (double)m) * error : HUGE_VAL;
    }
}

/// The frequency whose sine and cosine take most out of what the plain model leaves, in steps of half a line
/// width.
static double strongest_frequency(void)
{
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, NULL, 0, trial);
    double best = 0.0;
    double most = 0.0;
    for (double frequency = 1.0 / run.duration; frequency < 0.5 / run.sample_time;
         frequency += 0.5 / run.duration) {
        double real = 0.0;
        double imaginary = 0.0;
        for (size_t i = 0; i < record.num_samples; ++i) {
            const double angle = 6.283185307179586 * frequency * run.time[i];
            real += (measured[i] - trial[i]) * cos(angle);
            imaginary += (measured[i] - trial[i]) * sin(angle);
        }
        const double power = real * real + imaginary * imaginary;
        best = power > most ? frequency : best;
        most = fmax(most, power);
    }
    return best;
}

/// Forward Euler trails by at most one of its steps; where a kink falls between two samples, one sample in a
/// hundred at most, the coarse course is off by half a sample's motion, a tenth of that in the RMS and with
/// that one fine step's too.
static double rms_bound(const effect_case_t* of)
{
    return 2.0 * effect_case_bound(of, &model, &record) * 2.0 / FINE_STEPS;
}

/// The parameters found from the other implementation's output are off by no more than least squares explains
/// by what the two implementations differ by (twice, for the second order), and that is little.
static void recover(const effect_case_t* of)
{
    search_t search = {.use = effect_case_use(of)};
    search.num = search.use.effect->num_parameters;
    // What a case leaves out is left out of its search, and units are.
    while (search.use.effect->parameter[search.num - 1].is_unit ||
           (search.use.effect->parameter[search.num - 1].optional &&
            !(fabs(of->parameter[search.num - 1]) > 0))) {
        search.num--;
    }
    double truth[EFFECT_MAX_PARAMETERS];
    fine_plant(of, &model, &record, measured);
    for (size_t p = 0; p < search.num; ++p) {
        search.limits[p] = effect_use_limits(&run, &search.use, p);
        truth[p] = to_search(&search.limits[p], of->parameter[p]);
    }
    if (strcmp(of->name, "periodic_disturbance") == 0) {
        search.limits[0].start[0] = strongest_frequency();
    }
    residual(&search, truth, trial);
    const double difference = rms(trial, record.num_samples);
    TEST_ASSERT_TRUE_MESSAGE(difference <= rms_bound(of), of->name);
    double allowed[EFFECT_MAX_PARAMETERS];
    sensitivity(&search, truth, 2.0 * difference, allowed);
    double found[EFFECT_MAX_PARAMETERS];
    fit(&search, found);
    for (size_t p = 0; p < search.num; ++p) {
        search.use.parameter[p] = search.limits[p].logarithmic ? exp(found[p]) : found[p];
    }
    effect_use_normalise(&search.use);
    for (size_t p = 0; p < search.num; ++p) {
        found[p] = to_search(&search.limits[p], search.use.parameter[p]);
    }
    for (size_t p = 0; p < search.num; ++p) {
        char text[200];
        (void)snprintf(text, sizeof text, "%s %s: %.9g for %.9g", of->name,
                       search.use.effect->parameter[p].name, found[p], truth[p]);
        TEST_ASSERT_TRUE_MESSAGE(allowed[p] <= (search.limits[p].logarithmic ? 0.3 : 0.5 * fabs(truth[p])),
                                 text);
        // 1e-7: where the search stops, at 1e-12 of a sum of squares.
        TEST_ASSERT_TRUE_MESSAGE(fabs(found[p] - truth[p]) <= allowed[p] + 1e-7, text);
    }
}

static void every_effect_is_recovered(void)
{
    for (size_t c = 0; c < effect_case_count(); ++c) {
        if (strcmp(effect_case_at(c)->name, "quantization") != 0) {
            recover(effect_case_at(c));
        }
    }
}

/// A staircase has no slope to follow: step and offset are found by trying. A step wrong by half a step over
/// the levels passed puts the outermost level in the wrong place; so does an offset wrong by half a step.
static void quantization_is_recovered(void)
{
    effect_case_t of = {"quantization", NULL, {0.07, 0.02}, 1.0};
    const double step = of.parameter[0];
    fine_plant(&of, &model, &record, measured);
    effect_simulate(&run, &model, START_NEGATIVE_SATURATION, NULL, 0, trial);
    double* rounded = xcalloc(record.num_samples, sizeof(double));
    effect_use_t use = effect_case_use(&of);
    effect_use_t best = use;
    double least = HUGE_VAL;
    for (int i = 0; i < 400; ++i) {
        for (int k = 0; k < 10; ++k) {
            use.parameter[0] = 0.5 * step * exp(log(4.0) * i / 400.0);
            use.parameter[1] = use.parameter[0] * k / 10.0;
            memcpy(rounded, trial, record.num_samples * sizeof(double));
            effect_simulate_rest(&run, &use, 1, rounded);
            for (size_t t = 0; t < record.num_samples; ++t) {
                rounded[t] -= measured[t];
            }
            const double left = rms(rounded, record.num_samples);
            best = left < least ? use : best;
            least = fmin(least, left);
        }
    }
    free(rounded);
    TEST_ASSERT_DOUBLE_WITHIN(0.5 * step / (run.output_span / step), step, best.parameter[0]);
    TEST_ASSERT_DOUBLE_WITHIN(0.5 * step, of.parameter[1], best.parameter[1]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_effect_is_recovered);
    RUN_TEST(quantization_is_recovered);
    return UNITY_END();
}
