/// Steps a second of the segment memory against a plain loop over all plays, on this machine, from one run:
///   f32_throughput        prints a line for each number of plays
/// Both run the same tabulated model over the same smooth input, and their outputs are compared.
#include "f32_model.h"
#include "f32_plain.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum {
    MOST_PLAYS = 256,
    NUM_KNOTS = 50,
    NUM_SAMPLES = 1 << 14,
    NUM_ROUNDS = 5,
    SAMPLES_TIMES_PLAYS = 1 << 24
};

static float input[NUM_SAMPLES];
static float plain_memory[MOST_PLAYS];

/// tanh envelopes of a VO2 film (Zhang et al. 2015, Table 6), weights all alike.
static f32_model_t film(size_t num_plays)
{
    float radius[MOST_PLAYS];
    float weight[MOST_PLAYS];
    hyst_f32_knot_t knot[NUM_KNOTS];
    for (size_t j = 0; j < num_plays; ++j) {
        radius[j] = (float)(j + 1) / (float)(num_plays + 1);
        weight[j] = 1.0F / (float)num_plays;
    }
    for (int k = 0; k < NUM_KNOTS; ++k) {
        const double v = 30.0 + 60.0 * k / (NUM_KNOTS - 1);
        knot[k] = (hyst_f32_knot_t){.input = (float)v,
                                    .ascending = (float)tanh(0.16 * v - 10.26),
                                    .descending = (float)tanh(0.201 * v - 11.58),
                                    .nonhysteretic = (float)tanh(0.03 * v - 1.61)};
    }
    return f32_tabulated(radius, weight, num_plays, knot, NUM_KNOTS, -3.26F);
}

/// Loops of all sizes.
static void make_inputs(const hyst_f32_model_t* model)
{
    for (int i = 0; i < NUM_SAMPLES; ++i) {
        const double part = 0.5 + 0.3 * sin(0.0092 * i) + 0.199 * sin(0.0035 * i);
        input[i] = model->input_min + (float)part * (model->input_max - model->input_min);
    }
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// The plain loop with the same tables, the cell remembered as well.
static float plain_step(const f32_model_t* made, float* last, uint32_t* cell, float* sum, float v)
{
    const hyst_f32_knot_t* knot = &made->knot[*cell];
    while (v < knot->input) {
        --knot;
        --*cell;
    }
    while (*cell + 2 < made->model.num_knots && v >= knot[1].input) {
        ++knot;
        ++*cell;
    }
    const float along = v - knot->input;
    if (v > *last) {
        *sum = f32_plain_meet(made->radius, made->weight, plain_memory, made->model.num_plays,
                              knot->ascending + knot->ascending_slope * along, true);
    } else if (v < *last) {
        *sum = f32_plain_meet(made->radius, made->weight, plain_memory, made->model.num_plays,
                              knot->descending + knot->descending_slope * along, false);
    }
    *last = v;
    return made->model.constant + knot->nonhysteretic + knot->nonhysteretic_slope * along + *sum;
}

static double time_segments(f32_model_t* made, int num_repeats, double* total)
{
    hyst_f32_state_t state = f32_state(made);
    const double start = seconds();
    for (int r = 0; r < num_repeats; ++r) {
        for (int i = 0; i < NUM_SAMPLES; ++i) {
            *total += (double)hyst_f32_step(&made->model, &state, input[i]);
        }
    }
    return seconds() - start;
}

static double time_plain(const f32_model_t* made, int num_repeats, double* total)
{
    for (uint32_t j = 0; j < made->model.num_plays; ++j) {
        plain_memory[j] = made->knot[0].descending + made->radius[j];
    }
    float last = made->model.input_min;
    float sum = 0.0F;
    uint32_t cell = 0;
    const double start = seconds();
    for (int r = 0; r < num_repeats; ++r) {
        for (int i = 0; i < NUM_SAMPLES; ++i) {
            *total += (double)plain_step(made, &last, &cell, &sum, input[i]);
        }
    }
    return seconds() - start;
}

/// False where the two disagree by more than both may.
static bool measure(size_t num_plays)
{
    f32_model_t made = film(num_plays);
    const int num_repeats = 1 + SAMPLES_TIMES_PLAYS / NUM_SAMPLES / (int)num_plays;
    double least[2] = {(double)INFINITY, (double)INFINITY};
    double total[2] = {0.0, 0.0};
    make_inputs(&made.model);
    for (int round = 0; round < NUM_ROUNDS; ++round) {
        least[0] = fmin(least[0], time_segments(&made, num_repeats, &total[0]));
        least[1] = fmin(least[1], time_plain(&made, num_repeats, &total[1]));
    }
    const double num_samples = (double)NUM_SAMPLES * num_repeats;
    printf("%3zu plays: segments %6.1f ns a step, plain loop %6.1f ns, ratio %.2f\n", num_plays,
           1e9 * least[0] / num_samples, 1e9 * least[1] / num_samples, least[1] / least[0]);
    // A plain sum's own rounding is below the segments' bound: (N + 2) u of the same magnitudes.
    const double difference = fabs(total[0] - total[1]) / (num_samples * NUM_ROUNDS);
    const bool agree = difference <= 2.0 * f32_bound(&made).output;
    f32_free(&made);
    return agree;
}

int main(void)
{
    static const size_t num_plays[] = {1, 2, 3, 5, 8, 16, 32, 64, 128, 256};
    for (size_t i = 0; i < sizeof num_plays / sizeof num_plays[0]; ++i) {
        if (!measure(num_plays[i])) {
            fputs("error: segments and plain loop disagree\n", stderr);
            return EXIT_FAILURE;
        }
    }
    return EXIT_SUCCESS;
}
