/// A Bouc-Wen and a Jiles-Atherton plant by explicit Euler in fine steps, beside a reversible response that
/// is no spline: they share no code with the elements that are fitted to them.
#ifndef HYST_TEST_ELEMENT_PLANT_H
#define HYST_TEST_ELEMENT_PLANT_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    double x, z, wall;
} element_plant_t;

/// The output where the input has moved to x, a part of its range.
typedef double element_plant_step_t(element_plant_t* plant, double x);
double element_plant_bouc_wen(element_plant_t* plant, double x);
double element_plant_jiles_atherton(element_plant_t* plant, double x);

/// Up and down through 40 ... 60, then random reversals.
void element_plant_input(uint64_t seed, double* input, size_t num_samples);
/// The output from a first rise down to the range's foot on.
void element_plant_run(element_plant_step_t* step, const double* input, size_t num_samples, double* output);

#endif
