#include "element_plant.h"
#include "random.h"
#include <math.h>

enum { FINE = 100 };

void element_plant_input(uint64_t seed, double* input, size_t num_samples)
{
    random_t random = random_new(seed);
    double v = 0;
    double target = 1;
    size_t turns = 0;
    for (size_t t = 0; t < num_samples; t++) {
        input[t] = 40 + 20 * v;
        v += fmin(fmax(target - v, -0.01), 0.01);
        if (fabs(target - v) <= 0) {
            turns++;
            target = turns == 1 ? 0 : turns == 2 ? 1 : random_uniform(&random, 0, 1);
        }
    }
}

/// What is beside the element: smooth, increasing, of no spline.
static double reversible(double x)
{
    return 0.4 * atan(2 * (x - 0.4));
}

double element_plant_bouc_wen(element_plant_t* p, double x)
{
    const double move = (x - p->x) / FINE;
    for (size_t k = 0; k < FINE; k++) {
        p->z += move *
                (6 - pow(fabs(p->z), 1.3) * (4 * (move * p->z > 0 ? 1 : -1) + 1.5 + (move > 0 ? 0.4 : -0.4)));
    }
    p->x = x;
    return x - p->z / 9;
}

double element_plant_jiles_atherton(element_plant_t* p, double x)
{
    const double move = (x - p->x) / FINE;
    for (size_t k = 0; k < FINE; k++) {
        p->x += move;
        const double effective = (2 * p->x - 1 + 0.08 * p->z) / 0.25;
        const double ideal = 1 / tanh(effective) - 1 / effective;
        const double lack = ideal - p->wall;
        if (lack * move > 0) {
            p->wall += 2 * move * lack / (0.2 * (move > 0 ? 1 : -1) - 0.08 * lack);
        }
        p->z = 0.2 * ideal + 0.8 * p->wall;
    }
    return 0.4 * p->z;
}

void element_plant_run(element_plant_step_t* step, const double* input, size_t num_samples, double* output)
{
    element_plant_t p = {0};
    // From a first rise down to the range's foot.
    for (int k = 1; k <= 200; k++) {
        (void)step(&p, 1 - fabs((double)k / 100 - 1));
    }
    for (size_t t = 0; t < num_samples; t++) {
        const double x = (input[t] - 40) / 20;
        output[t] = 5 * (step(&p, x) + reversible(x));
    }
}
