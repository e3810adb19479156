/// What a body fitted to a calibration is still free to do on another record: the directions in which its
/// numbers are uncertain, as series over that record. A hypothesis about the gap is weighed with these left
/// open, each at its own price, so that what the calibration could not settle is not taken for an effect.
/// Source: M. C. Kennedy, A. O'Hagan, J. R. Statist. Soc. B 63 (2001) 425: model discrepancy learned from a
/// calibration.
#ifndef HYST_HOST_NUISANCE_H
#define HYST_HOST_NUISANCE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    size_t num_samples;
    size_t count;   ///< directions
    double* series; ///< [count][num_samples] what one standard deviation in a direction adds to the output
} nuisance_t;

/// derivatives[end - begin][num_numbers] of the output by the body's numbers at samples begin ... end - 1;
/// called in order from 0 on, more than once.
typedef void nuisance_rows_t(void* context, size_t begin, size_t end, double* derivatives);

/// precision: [num_numbers][num_numbers] upper triangle by columns, inverse covariance of the numbers;
/// overwritten. Directions whose series stay below `least` (sum of squares) are left out, as are those beyond
/// the largest few.
nuisance_t nuisance_new(double* precision, size_t num_numbers, size_t num_samples, double least,
                        nuisance_rows_t* rows, void* context);
void nuisance_free(nuisance_t* nuisance);

/// Which amounts explain a residual best, each at its price, when some of its samples count.
typedef struct {
    const nuisance_t* nuisance;
    double variance; ///< of what a residual holds besides
    double* factor;  ///< [count][count] Cholesky factor of series' series + variance I over what counts
} nuisance_filter_t;

/// counts: [num_samples] whether a sample does.
nuisance_filter_t nuisance_filter_new(const nuisance_t* nuisance, double variance, const bool* counts);
void nuisance_filter_free(nuisance_filter_t* filter);
/// amount[count] for a residual[num_samples] that is 0 where a sample does not count. The sum of squares of
/// the residual without them, plus variance times the amounts' squares, is then the least possible.
void nuisance_filter_find(const nuisance_filter_t* filter, const double* residual, double* amount);
/// Takes the amounts out of all samples.
void nuisance_take(const nuisance_t* nuisance, const double* amount, double* residual);

#endif
