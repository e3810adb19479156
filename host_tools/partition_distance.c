#include "first_least.h"
#include "interval_table.h"
#include "model.h"
#include "partition_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// next[end - 1] = least of previous[i] + (value of the run i ... end - 1) over the starts i, and that start.
/// The values keep the quadrangle inequality, so that the best start does not decrease with the end.
typedef struct {
    const interval_table_t* table;
    interval_join_t* join;
    const double* previous; ///< [num_plays]
    double* next;           ///< [num_plays]
    uint32_t* start;        ///< [num_plays]
    double most_cost;       ///< dearer divisions are not looked for
    size_t evaluations;
} row_t;

static void fill_end(row_t* row, size_t end, size_t low, size_t high)
{
    enum { CHUNK = 512 };
    double buffer[2][CHUNK];
    double* value = buffer[0];
    double* best_value = buffer[1];
    double least = (double)INFINITY;
    size_t best = low;
    for (size_t first = low; first < high; first += CHUNK) {
        const size_t stop = first + CHUNK < high ? first + CHUNK : high;
        interval_table_row(row->table, row->join, first, stop, end - 1, value);
        const double total = least_cost(row->previous + first, value, stop - first, false);
        if (total < least) {
            double* const other = best_value;
            best_value = value;
            value = other;
            least = total;
            best = first;
        }
    }
    row->evaluations += high - low;
    row->next[end - 1] = least;
    best += isinf(least) ? 0 : first_at_most(row->previous + best, best_value, least, false);
    row->start[end - 1] = (uint32_t)best;
}

/// The ends from ... to, whose best starts lie in low ... high. The cost does not fall with the end.
static void fill_ends(row_t* row, size_t from, size_t to, size_t low, size_t high)
{
    while (from <= to) {
        const size_t end = from + (to - from) / 2;
        fill_end(row, end, low, high < end - 1 ? high + 1 : end);
        const size_t best = row->start[end - 1];
        if (row->next[end - 1] > row->most_cost) {
            for (size_t dearer = end; dearer <= to; ++dearer) {
                row->next[dearer - 1] = (double)INFINITY;
            }
            to = end - 1;
            high = best;
        } else {
            fill_ends(row, from, end - 1, low, best);
            from = end + 1;
            low = best;
        }
    }
}

/// The least costs of divisions into one more group at a time. Wasserstein groups are filled in two rows: up
/// to the play at the median, and on from it.
typedef struct {
    const play_set_t* plays;
    const partition_terms_t* terms;
    interval_table_t table;
    size_t num_groups;
    double* least;   ///< [num_plays + 1] of the first i plays in num_groups groups
    double* half;    ///< [num_plays] wasserstein: up to median i
    uint32_t* start; ///< [num_plays] where the last group begins when it ends with play i
    uint32_t* median;
    double most_cost; ///< costs above are left at infinity
    size_t evaluations;
} rows_t;

/// What num_groups groups can certainly be had for: ends at equal steps of sum weight^a gap^(1-a), a = 1/2
/// for k-median and 1/3 for k-means, the densities of good quantizers (Panter and Dite 1951).
static double known_cost(const play_set_t* plays, size_t num_groups, partition_cost_t cost)
{
    const size_t num_plays = plays->num_plays;
    const double exponent = cost == COST_VARIANCE ? 1.0 / 3.0 : 0.5;
    double* upto = xcalloc(num_plays + 1, sizeof(double));
    for (size_t j = 0; j < num_plays; ++j) {
        const double gap = j > 0 ? plays->radius[j] - plays->radius[j - 1] : 0.0;
        upto[j + 1] = upto[j] + pow(plays->weight[j], exponent) * pow(gap, 1.0 - exponent);
    }
    double total = 0.0;
    size_t start = 0;
    for (size_t k = 1; k <= num_groups; ++k) {
        const double step = upto[num_plays] * ((double)k / (double)num_groups);
        const size_t last = num_plays - (num_groups - k);
        size_t end = k == num_groups ? num_plays : start + 1;
        while (end < last && upto[end] < step) {
            ++end;
        }
        total += group_cost(plays, start, end, cost);
        start = end;
    }
    free(upto);
    // The table's sums are rounded otherwise.
    return total * (1.0 + 1e-9);
}

/// most_cost: see rows_t.
static rows_t rows_new(const play_set_t* plays, const partition_terms_t* terms, double most_cost)
{
    const size_t num_plays = plays->num_plays;
    rows_t rows = {.plays = plays, .terms = terms, .most_cost = most_cost};
    rows.table =
        interval_table_new(plays, terms->cost == COST_VARIANCE ? interval_inertia : interval_distance);
    rows.least = xmalloc((num_plays + 1) * sizeof(double));
    rows.half = xmalloc(num_plays * sizeof(double));
    rows.start = xcalloc(num_plays, sizeof(uint32_t));
    rows.median = xcalloc(num_plays, sizeof(uint32_t));
    rows.least[0] = 0.0;
    for (size_t i = 0; i < num_plays; ++i) {
        rows.least[i + 1] =
            terms->zero_is_free ? rows.least[i] + plays->weight[i] * plays->radius[i] : (double)INFINITY;
    }
    return rows;
}

static void rows_free(rows_t* rows)
{
    interval_table_free(&rows->table);
    free(rows->least);
    free(rows->half);
    free(rows->start);
    free(rows->median);
}

/// Fills a row for one more group, from the starts low ... high.
static void fill_row(rows_t* rows, row_t row, size_t first_end, size_t low, size_t high)
{
    fill_ends(&row, first_end, rows->plays->num_plays, low, high);
    rows->evaluations += row.evaluations;
}

/// Only whole divisions are wanted of the last row: no ends but the last, unless plays may move to the limit.
static void rows_next(rows_t* rows, bool last)
{
    const size_t num_plays = rows->plays->num_plays;
    const size_t low = rows->num_groups;
    const size_t high = low == 0 && !rows->terms->zero_is_free ? 0 : num_plays - 1;
    const size_t first_end = last && !rows->terms->limit_is_free ? num_plays : low + 1;
    if (rows->terms->cost == COST_VARIANCE) {
        const row_t whole = {
            &rows->table, join_inertia, rows->least, rows->half, rows->start, rows->most_cost, 0};
        fill_row(rows, whole, first_end, low, high);
        memcpy(rows->least + first_end, rows->half + first_end - 1,
               (num_plays + 1 - first_end) * sizeof(double));
    } else {
        // The play at the median counts for nothing in its group, so either half holds it.
        const row_t up = {
            &rows->table, join_distance_to_last, rows->least, rows->half, rows->start, rows->most_cost, 0};
        fill_row(rows, up, low + 1, low, high);
        const row_t on = {&rows->table, join_distance_to_first, rows->half, rows->least + 1,
                          rows->median, rows->most_cost,        0};
        fill_row(rows, on, first_end, low, num_plays - 1);
    }
    // Each group needs a play.
    for (size_t end = 0; end <= low; ++end) {
        rows->least[end] = (double)INFINITY;
    }
    rows->num_groups += 1;
}

static size_t group_start(const rows_t* rows, size_t end)
{
    return rows->start[rows->terms->cost == COST_VARIANCE ? end - 1 : rows->median[end - 1]];
}

/// The least cost of all plays, and where the last group ends: the plays after it move to the limit.
static double rows_cost(const rows_t* rows, size_t* last_end)
{
    const play_set_t* plays = rows->plays;
    double least = rows->least[plays->num_plays];
    *last_end = plays->num_plays;
    double moved = 0.0;
    for (size_t end = plays->num_plays; rows->terms->limit_is_free && end > rows->num_groups; --end) {
        moved += plays->weight[end - 1] * (rows->terms->limit - plays->radius[end - 1]);
        const double total = rows->least[end - 1] + moved;
        if (total < least) {
            least = total;
            *last_end = end - 1;
        }
    }
    return least;
}

void divide_by_distance(const play_set_t* plays, const partition_terms_t* terms, size_t least_groups,
                        division_t* division)
{
    rows_t rows = rows_new(plays, terms, known_cost(plays, least_groups, terms->cost));
    for (size_t k = 1; k <= division->most_groups; ++k) {
        rows_next(&rows, k == division->most_groups);
        for (size_t end = k; end <= plays->num_plays; ++end) {
            division->before[k * (plays->num_plays + 1) + end] = (uint32_t)group_start(&rows, end);
        }
        (void)rows_cost(&rows, &division->last_end[k]);
    }
    division->evaluations = rows.evaluations;
    rows_free(&rows);
}

size_t partition_least_groups(const play_set_t* plays, const partition_terms_t* terms, double cost)
{
    rows_t rows = rows_new(plays, terms, (double)INFINITY);
    size_t last_end;
    do {
        rows_next(&rows, false);
    } while (rows.num_groups < plays->num_plays && rows_cost(&rows, &last_end) > cost);
    const size_t num_groups = rows.num_groups;
    rows_free(&rows);
    return num_groups;
}
