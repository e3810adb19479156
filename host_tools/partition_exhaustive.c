#include "model.h"
#include "partition_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const play_set_t* plays;
    const partition_terms_t* terms;
    size_t num_groups;
    size_t* beta; ///< [num_groups + 1] the partition being built
    size_t* best;
    double least;
    size_t evaluations;
} search_t;

static void finish(search_t* search, double cost)
{
    const size_t end = search->beta[search->num_groups];
    if (end < search->plays->num_plays) {
        cost += group_distance(search->plays, end, search->plays->num_plays, search->terms->limit);
    }
    if (isinf(search->least) || cost < search->least - 1e-12 * search->least) {
        search->least = cost;
        memcpy(search->best, search->beta, (search->num_groups + 1) * sizeof(size_t));
    }
}

/// Tries all ends of group k, whose start is chosen; `cost` is that of the groups before. Depth: num_groups.
static void visit(search_t* search, size_t k, double cost)
{
    if (k > search->num_groups) {
        finish(search, cost);
        return;
    }
    const size_t start = search->beta[k - 1];
    const size_t groups_behind = search->num_groups - k;
    const size_t last = search->plays->num_plays - groups_behind;
    const size_t first = groups_behind == 0 && !search->terms->limit_is_free ? last : start + 1;
    for (size_t end = first; end <= last; ++end) {
        search->beta[k] = end;
        search->evaluations += 1;
        const double group = group_cost(search->plays, start, end, search->terms->cost);
        visit(search, k + 1, cost_combined(search->terms->cost, cost, group));
    }
}

void divide_exhaustively(const play_set_t* plays, const partition_terms_t* terms, division_t* division)
{
    const size_t num_groups = division->most_groups;
    search_t search = {.plays = plays, .terms = terms, .num_groups = num_groups, .least = (double)INFINITY};
    search.beta = xcalloc(num_groups + 1, sizeof(size_t));
    search.best = xcalloc(num_groups + 1, sizeof(size_t));
    const size_t most_at_zero = terms->zero_is_free ? plays->num_plays - num_groups : 0;
    for (size_t at_zero = 0; at_zero <= most_at_zero; ++at_zero) {
        search.beta[0] = at_zero;
        visit(&search, 1, group_distance(plays, 0, at_zero, 0.0));
    }
    for (size_t k = 1; k <= num_groups; ++k) {
        division->before[k * (plays->num_plays + 1) + search.best[k]] = (uint32_t)search.best[k - 1];
    }
    division->last_end[num_groups] = search.best[num_groups];
    division->evaluations = search.evaluations;
    free(search.beta);
    free(search.best);
}

double partition_count(size_t num_plays, size_t num_groups, const partition_terms_t* terms)
{
    // Ends to choose out of the places between plays; a free place adds its own to both.
    const size_t free_places = (size_t)terms->zero_is_free + (size_t)terms->limit_is_free;
    const size_t places = num_plays - 1 + free_places;
    const size_t ends = num_groups - 1 + free_places;
    double count = 1.0;
    for (size_t i = 1; i <= ends; ++i) {
        count *= (double)(places - ends + i) / (double)i;
    }
    return count;
}
