/// Non-negative least squares, the bounded linear core of the identification.
/// Lawson and Hanson, Solving Least Squares Problems (1974), ch. 23, on a QR-reduced system.
#ifndef HYST_HOST_NNLS_H
#define HYST_HOST_NNLS_H

#include "message.h"
#include <stdbool.h>
#include <stddef.h>

typedef struct {
    double residual_norm; ///< ||A x - b||
    double kkt;           ///< largest violation of the optimality conditions, relative to ||a_j|| ||b||
    size_t iterations;    ///< passive-set changes
} nnls_info_t;

/// Minimises ||A x - b|| over x >= 0. a: [rows * columns] column-major; b: [rows]; both are overwritten.
/// x: [columns]. passive: [columns] in: the set to start from (a former solution's), out: the x_j > 0.
/// Columns of norm 0 get x_j = 0. OUTCOME_NUMERICAL (not reported) when it does not settle or is not finite.
outcome_t nnls_solve(double* a, size_t rows, size_t columns, double* b, double* x, bool* passive,
                     nnls_info_t* info);

#endif
