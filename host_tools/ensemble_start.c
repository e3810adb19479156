#include "ensemble_start.h"
#include <math.h>
#include <stdlib.h>

/// Second moments of the cumulative sums S_j = sum over the first j plays of p w, from which those of any
/// group follow by subtraction.
typedef struct {
    const gram_t* gram;
    size_t num_plays;
    double* cumulative; ///< [(num_plays + 1)^2] E[S_i S_j]
    double* with_state; ///< [(num_plays + 1) * num_radii] E[S_j w(candidate)]
    double* weight;     ///< [num_plays + 1] total weight of the first j plays
} cumulated_t;

static cumulated_t cumulated_new(const gram_t* gram, const play_set_t* plays)
{
    const size_t n = plays->num_plays;
    const size_t g = gram->num_radii;
    cumulated_t m = {.gram = gram, .num_plays = n};
    m.cumulative = xcalloc((n + 1) * (n + 1), sizeof(double));
    m.with_state = xcalloc((n + 1) * g, sizeof(double));
    m.weight = xcalloc(n + 1, sizeof(double));
    for (size_t j = 0; j < n; ++j) {
        const double* covariance = &gram->covariance[j * gram->sub * g];
        m.weight[j + 1] = m.weight[j] + plays->weight[j];
        for (size_t i = 0; i < g; ++i) {
            m.with_state[(j + 1) * g + i] = m.with_state[j * g + i] + plays->weight[j] * covariance[i];
        }
    }
    for (size_t j = 0; j < n; ++j) {
        for (size_t i = 0; i < n; ++i) {
            m.cumulative[(j + 1) * (n + 1) + i + 1] =
                m.cumulative[(j + 1) * (n + 1) + i] +
                plays->weight[i] * m.with_state[(j + 1) * g + i * gram->sub];
        }
    }
    return m;
}

static void cumulated_free(cumulated_t* m)
{
    free(m->cumulative);
    free(m->with_state);
    free(m->weight);
    *m = (cumulated_t){0};
}

/// The least mean-square error of one play with the weight of the plays first + 1 ... end in their place.
static double group_error(const cumulated_t* m, size_t first, size_t end, size_t* candidate)
{
    const size_t g = m->gram->num_radii;
    const size_t width = m->num_plays + 1;
    const double weight = m->weight[end] - m->weight[first];
    double least = (double)INFINITY;
    for (size_t i = first * m->gram->sub; i <= (end - 1) * m->gram->sub; ++i) {
        const double mixed = m->with_state[end * g + i] - m->with_state[first * g + i];
        const double error = weight * (weight * m->gram->covariance[i * g + i] - 2.0 * mixed);
        if (error < least) {
            least = error;
            *candidate = i;
        }
    }
    return least + m->cumulative[end * width + end] - 2.0 * m->cumulative[first * width + end] +
           m->cumulative[first * width + first];
}

/// Bellman's recursion: least[k * width + end] over the first `end` plays in k groups.
void start_least_squares(const gram_t* gram, const play_set_t* plays, size_t num_groups, size_t* chosen)
{
    cumulated_t m = cumulated_new(gram, plays);
    const size_t width = plays->num_plays + 1;
    double* least = xcalloc((num_groups + 1) * width, sizeof(double));
    size_t* before = xcalloc((num_groups + 1) * width, sizeof(size_t));
    size_t candidate = 0;
    for (size_t i = 1; i < (num_groups + 1) * width; ++i) {
        least[i] = (double)INFINITY;
    }
    for (size_t first = 0; first < plays->num_plays; ++first) {
        for (size_t end = first + 1; end < width; ++end) {
            const double error = group_error(&m, first, end, &candidate);
            for (size_t k = 0; k < num_groups; ++k) {
                const double total = least[k * width + first] + error;
                if (total < least[(k + 1) * width + end]) {
                    least[(k + 1) * width + end] = total;
                    before[(k + 1) * width + end] = first;
                }
            }
        }
    }
    for (size_t k = num_groups, end = plays->num_plays; k > 0; --k) {
        const size_t first = before[k * width + end];
        group_error(&m, first, end, &chosen[k - 1]);
        end = first;
    }
    free(before);
    free(least);
    cumulated_free(&m);
}
