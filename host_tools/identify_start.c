#include "identify_start.h"

#include <cminpack.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Up to this part of a record is left out rather than guessed at.
static const double expendable = 0.3;
/// Nodes over the plays between which the estimated start is interpolated: a record shows no more detail of
/// it.
enum { NODES = 8 };

void start_plan_choose(start_plan_t* plan, const samples_t* samples, size_t num_plays)
{
    const double first = samples->u[0];
    plan->num_plays = num_plays;
    plan->fraction = xcalloc(num_plays, sizeof *plan->fraction);
    plan->leave_out = (double)samples->wiped <= expendable * (double)samples->num_samples;
    if (first > 0.98) {
        plan->start = START_POSITIVE_SATURATION;
    } else if (plan->leave_out || first < -0.98) {
        plan->start = START_NEGATIVE_SATURATION;
    } else {
        plan->start = START_MODEL;
    }
}

void start_plan_free(start_plan_t* plan)
{
    free(plan->fraction);
    *plan = (start_plan_t){0};
}

static fit_samples_t samples_from(const start_plan_t* plan, start_t start, const samples_t* samples)
{
    return (fit_samples_t){.num_samples = samples->num_samples,
                           .u = samples->u,
                           .y = samples->y,
                           .used = samples->used,
                           .start = start,
                           .fraction = plan->fraction};
}

typedef struct {
    start_plan_t* plan;
    const fit_t* fit;
    const samples_t* samples;
    double* output;
} estimate_t;

/// fraction_j = tanh of the interpolated node values: always within the strip.
static void set_fractions(start_plan_t* plan, const double* node)
{
    for (size_t j = 0; j < plan->num_plays; j++) {
        const double at = (NODES - 1) * (double)j / (double)(plan->num_plays > 1 ? plan->num_plays - 1 : 1);
        const size_t i = at >= NODES - 1 ? NODES - 2 : (size_t)at;
        plan->fraction[j] = tanh(node[i] + (at - (double)i) * (node[i + 1] - node[i]));
    }
}

static int estimate_residual(void* context, int m, int n, const double* node, double* residual, int task)
{
    (void)m;
    (void)n;
    (void)task;
    estimate_t* e = context;
    set_fractions(e->plan, node);
    const fit_samples_t run = samples_from(e->plan, START_MODEL, e->samples);
    fit_output(e->fit, &run, e->output);
    for (size_t i = 0; i < e->samples->num_samples; i++) {
        residual[i] = e->samples->measured[i] ? e->output[i] - e->samples->y[i] : 0;
    }
    return 0;
}

void start_estimate(start_plan_t* plan, const fit_t* fit, const samples_t* samples)
{
    const size_t m = samples->num_samples;
    double* work = xcalloc(m + m + m * NODES + 5 * m + 10 * NODES * NODES, sizeof *work);
    estimate_t context = {plan, fit, samples, work};
    double node[NODES];
    for (size_t i = 0; i < NODES; i++) {
        const size_t j = i * (plan->num_plays - 1) / (NODES - 1);
        node[i] = atanh(fmax(fmin(plan->fraction[j], 0.95), -0.95));
    }
    int pivot[NODES];
    lmdif1(estimate_residual, &context, (int)m, NODES, node, work + m, 1e-6, pivot, work + 2 * m,
           (int)(m * NODES + 5 * m + 10 * NODES * NODES));
    set_fractions(plan, node);
    free(work);
}

/// RMSE of the fit over the stretch before the memory is wiped out, when started from `start`.
static double stretch_rmse(const start_plan_t* plan, const fit_t* fit, const samples_t* samples,
                           start_t start)
{
    const fit_samples_t run = samples_from(plan, start, samples);
    double* output = xmalloc(samples->num_samples * sizeof *output);
    fit_output(fit, &run, output);
    double sum = 0;
    double measured = 0;
    for (size_t i = 0; i < samples->wiped; i++) {
        if (samples->measured[i]) {
            sum += (output[i] - samples->y[i]) * (output[i] - samples->y[i]);
            measured += 1;
        }
    }
    free(output);
    return sqrt(sum / fmax(measured, 1));
}

void start_try_assumptions(start_plan_t* plan, fit_t* fit, samples_t* samples)
{
    // The nearer end first: where both explain the stretch alike, it is the likelier past.
    const bool low = samples->u[0] <= 0;
    const start_t assumption[] = {low ? START_NEGATIVE_SATURATION : START_POSITIVE_SATURATION,
                                  low ? START_POSITIVE_SATURATION : START_NEGATIVE_SATURATION};
    double rmse[] = {0, 0};
    for (size_t i = 0; i < 2 && samples->wiped > 0; i++) {
        rmse[i] = stretch_rmse(plan, fit, samples, assumption[i]);
    }
    double limit = 1.5 * fit->rmse;
    if (fmin(rmse[0], rmse[1]) > limit) {
        // The model itself may be off in those loops: then no past at all explains them.
        start_estimate(plan, fit, samples);
        limit = fmax(limit, 1.2 * stretch_rmse(plan, fit, samples, START_MODEL));
    }
    for (size_t i = 0; i < 2; i++) {
        if (rmse[i] <= limit) {
            limit = 0.9 * rmse[i];
            plan->start = assumption[i];
            plan->leave_out = false;
        }
    }
    if (!plan->leave_out) {
        samples_use_from(samples, 0);
    }
}

void start_write_initial(const start_plan_t* plan, model_t* model, double first_input)
{
    const double ascending = curve_value(&model->ascending, first_input);
    const double descending = curve_value(&model->descending, first_input);
    model->initial = xmalloc(model->num_plays * sizeof *model->initial);
    for (size_t j = 0; j < model->num_plays; j++) {
        const double low = ascending - model->radius[j];
        const double high = descending + model->radius[j];
        model->initial[j] = 0.5 * (low + high) + 0.5 * plan->fraction[j] * (high - low);
        if (j > 0) {
            // A memory is 1-Lipschitz over the radii (THEORY section 2).
            const double gap = model->radius[j] - model->radius[j - 1];
            const double below = model->initial[j - 1];
            model->initial[j] = fmax(fmin(model->initial[j], below + gap), below - gap);
        }
    }
}
