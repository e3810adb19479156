#include "ensemble_input.h"
#include <math.h>
#include <stdlib.h>

enum { NUM_INPUTS = 96, NUM_REVERSALS = 24, SAMPLES_PER_RANGE = 40 };

/// erand48 is defined to the bit by POSIX: the same ensemble everywhere.
typedef struct {
    const model_t* model;
    unsigned short state[3];
    drive_t drive;
    size_t capacity;
    double input; ///< 0 ... 1 of the range
} generator_t;

static double uniform(generator_t* generator, double low, double high)
{
    return low + (high - low) * erand48(generator->state);
}

static drive_t empty_drive(const model_t* model)
{
    return (drive_t){.level = curve_value(&model->descending, model->input_min),
                     .unit = model_largest_moving_radius(model)};
}

static double scaled(const drive_t* drive, const curve_t* envelope, double v)
{
    return (curve_value(envelope, v) - drive->level) / drive->unit;
}

static void append(generator_t* generator, double input)
{
    drive_t* drive = &generator->drive;
    if (drive->num_samples == generator->capacity) {
        generator->capacity = 2 * generator->capacity + 1024;
        drive->ascending = xrealloc(drive->ascending, generator->capacity * sizeof(double));
        drive->descending = xrealloc(drive->descending, generator->capacity * sizeof(double));
    }
    const model_t* model = generator->model;
    const double v = model->input_min + input * (model->input_max - model->input_min);
    drive->ascending[drive->num_samples] = scaled(drive, &model->ascending, v);
    drive->descending[drive->num_samples] = scaled(drive, &model->descending, v);
    drive->num_samples += 1;
    generator->input = input;
}

static void ramp_to(generator_t* generator, double input)
{
    const double from = generator->input;
    const int steps = (int)ceil(fabs(input - from) * SAMPLES_PER_RANGE);
    for (int i = 1; i <= steps; ++i) {
        append(generator, i == steps ? input : from + (input - from) * i / steps);
    }
}

static void uniform_reversals(generator_t* generator)
{
    for (int i = 0; i < NUM_REVERSALS; ++i) {
        ramp_to(generator, uniform(generator, 0.0, 1.0));
    }
}

static void alternation(generator_t* generator, double centre, double amplitude)
{
    ramp_to(generator, fmin(centre + amplitude, 1.0));
    ramp_to(generator, fmax(centre - amplitude, 0.0));
}

static void mixed_amplitudes(generator_t* generator)
{
    for (int i = 0; i < NUM_REVERSALS / 2; ++i) {
        const double root = uniform(generator, 0.0, 1.0);
        alternation(generator, uniform(generator, 0.0, 1.0), 0.5 * root * root);
    }
}

static void nested_loops(generator_t* generator)
{
    double amplitude = 0.0;
    double centre = 0.5;
    for (int i = 0; i < NUM_REVERSALS / 2; ++i) {
        if (amplitude < 0.5 / 50.0) {
            amplitude = 0.5;
            centre = uniform(generator, 0.25, 0.75);
        }
        alternation(generator, centre, amplitude);
        amplitude *= uniform(generator, 0.5, 0.95);
    }
}

drive_t drive_new(const model_t* model)
{
    generator_t generator = {.model = model, .state = {0x330E, 1, 0}, .drive = empty_drive(model)};
    for (int i = 0; i < NUM_INPUTS; ++i) {
        append(&generator, 0.0);
        if (i % 4 == 0) {
            mixed_amplitudes(&generator);
        } else if (i % 4 == 2) {
            nested_loops(&generator);
        } else {
            uniform_reversals(&generator);
        }
    }
    return generator.drive;
}

drive_t drive_of(const model_t* model, const double* input, size_t num_samples)
{
    drive_t drive = empty_drive(model);
    drive.num_samples = num_samples;
    drive.ascending = xcalloc(num_samples, sizeof(double));
    drive.descending = xcalloc(num_samples, sizeof(double));
    for (size_t t = 0; t < num_samples; ++t) {
        drive.ascending[t] = scaled(&drive, &model->ascending, input[t]);
        drive.descending[t] = scaled(&drive, &model->descending, input[t]);
    }
    return drive;
}

void drive_free(drive_t* drive)
{
    free(drive->ascending);
    free(drive->descending);
    *drive = (drive_t){0};
}

void drive_states(const drive_t* drive, double radius, double* state, double* slope)
{
    double w = radius;
    double derivative = 0.0;
    for (size_t t = 0; t < drive->num_samples; ++t) {
        // A rising input leaves w below descending + radius anyway, a falling one above ascending - radius.
        if (drive->ascending[t] - radius > w) {
            w = drive->ascending[t] - radius;
            derivative = -2.0;
        } else if (drive->descending[t] + radius < w) {
            w = drive->descending[t] + radius;
            derivative = 0.0;
        }
        state[t] = w - radius;
        if (slope != NULL) {
            slope[t] = derivative;
        }
    }
}
