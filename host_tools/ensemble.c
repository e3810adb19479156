#include "ensemble.h"
#include "ensemble_start.h"
#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The search sees at most so many plays; where there are more, neighbours are first taken together.
enum { MOST_NODES = 240, MOST_SWEEPS = 50, NUM_POLISHED = 3, NUM_DISTURBANCES = 60 };

/// Each evaluation costs of the order of num_plays^2 operations; so many in all, after which the disturbances
/// end. About 1 s, reached from some 20 plays on.
static const double most_operations = 3e8;

typedef struct {
    const gram_t* gram;
    size_t count;
    size_t evaluations;
} search_t;

typedef struct {
    size_t chosen[ENSEMBLE_MOST_PLAYS]; ///< candidates, ascending
    double error;
} choice_t;

/// Plays j with the same floor(j * num_nodes / num_plays) as one play each at their centroid.
static void take_together(const play_set_t* plays, size_t num_nodes, double* radius, double* weight)
{
    for (size_t node = 0, j = 0; node < num_nodes; ++node) {
        group_sums_t sums = group_sums_begin(plays->radius[j]);
        weight[node] = 0.0;
        for (; j * num_nodes / plays->num_plays == node && j < plays->num_plays; ++j) {
            group_sums_add(&sums, plays->radius[j], plays->weight[j]);
            weight[node] += plays->weight[j];
        }
        radius[node] = group_centroid(&sums);
    }
}

/// The output's play part over the ensemble.
static double* play_output(const drive_t* drive, const play_set_t* plays)
{
    double* output = xcalloc(drive->num_samples, sizeof *output);
    double* state = xcalloc(drive->num_samples, sizeof *state);
    for (size_t j = 0; j < plays->num_plays; ++j) {
        if (plays->weight[j] > 0.0) {
            drive_states(drive, plays->radius[j], state, NULL);
            cblas_daxpy((int)drive->num_samples, plays->weight[j], state, 1, output, 1);
        }
    }
    free(state);
    return output;
}

static int compare_candidates(const void* a, const void* b)
{
    const size_t first = *(const size_t*)a;
    const size_t second = *(const size_t*)b;
    return (first > second) - (first < second);
}

/// Exchanges one candidate at a time for the best other one, until none is worth it.
static void descend(search_t* search, choice_t* choice)
{
    const size_t count = search->count;
    choice->error = gram_error(search->gram, choice->chosen, count);
    bool improved = true;
    for (int sweep = 0; sweep < MOST_SWEEPS && improved; ++sweep) {
        improved = false;
        for (size_t k = 0; k < count; ++k) {
            choice_t tried = *choice;
            tried.chosen[k] = gram_exchange(search->gram, choice->chosen, count, k);
            search->evaluations += search->gram->num_radii;
            qsort(tried.chosen, count, sizeof *tried.chosen, compare_candidates);
            tried.error = gram_error(search->gram, tried.chosen, count);
            if (tried.error < choice->error * (1.0 - 1e-9)) {
                *choice = tried;
                improved = true;
            }
        }
    }
}

/// The candidate first ... last that is nearest to the radius.
static size_t nearest_candidate(const gram_t* gram, double radius, size_t first, size_t last)
{
    size_t best = first;
    for (size_t i = first + 1; i <= last; ++i) {
        if (fabs(gram->radius[i] - radius) < fabs(gram->radius[best] - radius)) {
            best = i;
        }
    }
    return best;
}

/// The candidates nearest to the groups' centroids.
static void start_from_partition(const gram_t* gram, const play_set_t* nodes, partition_cost_t cost,
                                 size_t count, size_t* chosen)
{
    partition_t partition = partition_find(nodes, count, cost);
    for (size_t k = 0; k < count; ++k) {
        const size_t first = partition.beta[k];
        const size_t last = partition.beta[k + 1] - 1;
        group_sums_t sums = group_sums_begin(nodes->radius[first]);
        for (size_t j = first; j <= last; ++j) {
            group_sums_add(&sums, nodes->radius[j], nodes->weight[j]);
        }
        chosen[k] = nearest_candidate(gram, group_centroid(&sums), first * gram->sub, last * gram->sub);
    }
    partition_free(&partition);
}

/// Better choices first; the same choice is kept once.
static void keep(choice_t* best, size_t* num_best, const choice_t* choice, size_t count)
{
    size_t place = 0;
    while (place < *num_best && best[place].error <= choice->error) {
        if (memcmp(best[place].chosen, choice->chosen, count * sizeof *choice->chosen) == 0) {
            return;
        }
        ++place;
    }
    *num_best += *num_best < NUM_POLISHED ? 1 : 0;
    if (place < *num_best) {
        memmove(&best[place + 1], &best[place], (*num_best - place - 1) * sizeof *best);
        best[place] = *choice;
    }
}

/// Puts random candidates in the place of two of the chosen ones; false when that repeats one.
static bool disturb(const search_t* search, unsigned short* random, choice_t* choice)
{
    const size_t count = search->count;
    for (int i = 0; i < 2; ++i) {
        const size_t k = (size_t)(erand48(random) * (double)count);
        choice->chosen[k] = (size_t)(erand48(random) * (double)search->gram->num_radii);
    }
    qsort(choice->chosen, count, sizeof *choice->chosen, compare_candidates);
    for (size_t k = 1; k < count; ++k) {
        if (choice->chosen[k] == choice->chosen[k - 1]) {
            return false;
        }
    }
    return true;
}

/// Descends again and again from the best choice with two of its candidates changed at random.
static void search_around(search_t* search, choice_t* best, size_t* num_best)
{
    unsigned short random[3] = {0x330E, 2, 0};
    const double most = most_operations / (double)(search->count * search->count);
    for (int i = 0; i < NUM_DISTURBANCES && (double)search->evaluations < most; ++i) {
        choice_t choice = best[0];
        if (disturb(search, random, &choice)) {
            descend(search, &choice);
            keep(best, num_best, &choice, search->count);
        }
    }
}

static const partition_cost_t start_costs[] = {COST_VARIANCE, COST_ENTROPY_SUM, COST_ENTROPY_MAX,
                                               COST_UNIFORM};

/// Fills best[NUM_POLISHED]; returns how many different choices there are.
static size_t search_grid(search_t* search, const play_set_t* nodes, choice_t* best)
{
    size_t num_best = 0;
    for (size_t start = 0; start <= sizeof start_costs / sizeof *start_costs; ++start) {
        choice_t choice = {0};
        if (start == 0) {
            start_least_squares(search->gram, nodes, search->count, choice.chosen);
        } else {
            start_from_partition(search->gram, nodes, start_costs[start - 1], search->count, choice.chosen);
        }
        descend(search, &choice);
        keep(best, &num_best, &choice, search->count);
    }
    search_around(search, best, &num_best);
    return num_best;
}

/// Moves each choice off the grid; the best result is `found`.
static outcome_t polish_best(const drive_t* drive, const double* output, double mean, const gram_t* gram,
                             const choice_t* best, size_t num_best, ensemble_plays_t* found)
{
    const size_t count = found->num_plays;
    outcome_t outcome = OUTCOME_NUMERICAL;
    size_t evaluations = found->evaluations;
    for (size_t i = 0; i < num_best; ++i) {
        ensemble_plays_t plays = ensemble_plays_new(count);
        for (size_t k = 0; k < count; ++k) {
            plays.radius[k] = gram->radius[best[i].chosen[k]];
        }
        const outcome_t polished =
            ensemble_polish(drive, output, mean, gram->radius[0], gram->radius[gram->num_radii - 1], &plays);
        evaluations += plays.evaluations;
        if (polished == OUTCOME_OK && (outcome != OUTCOME_OK || plays.rms < found->rms)) {
            ensemble_plays_free(found);
            *found = plays;
            outcome = OUTCOME_OK;
        } else {
            ensemble_plays_free(&plays);
        }
    }
    found->evaluations = evaluations;
    return outcome;
}

static ensemble_plays_t copy_of(const play_set_t* plays)
{
    ensemble_plays_t copy = ensemble_plays_new(plays->num_plays);
    memcpy(copy.radius, plays->radius, plays->num_plays * sizeof(double));
    memcpy(copy.weight, plays->weight, plays->num_plays * sizeof(double));
    return copy;
}

static double largest_weight(const play_set_t* plays)
{
    double largest = 0.0;
    for (size_t j = 0; j < plays->num_plays; ++j) {
        largest = fmax(largest, plays->weight[j]);
    }
    return largest > 0.0 ? largest : 1.0;
}

static void scale_plays(ensemble_plays_t* plays, double radius_factor, double weight_factor)
{
    for (size_t k = 0; k < plays->num_plays; ++k) {
        plays->radius[k] *= radius_factor;
        plays->weight[k] *= weight_factor;
    }
}

/// For scaled plays and the ensemble they are scaled for.
static outcome_t find_scaled(const drive_t* drive, const play_set_t* plays, ensemble_plays_t* found)
{
    double radius[MOST_NODES];
    double weight[MOST_NODES];
    const size_t num_nodes = plays->num_plays < MOST_NODES ? plays->num_plays : MOST_NODES;
    take_together(plays, num_nodes, radius, weight);
    const play_set_t nodes = {radius, weight, num_nodes};
    double* output = play_output(drive, plays);
    const double mean = centre(output, drive->num_samples);
    gram_t gram = gram_new(drive, &nodes, output);
    search_t search = {&gram, found->num_plays, 0};
    choice_t best[NUM_POLISHED];
    const size_t num_best = search_grid(&search, &nodes, best);
    found->evaluations = search.evaluations;
    const outcome_t outcome = polish_best(drive, output, mean, &gram, best, num_best, found);
    gram_free(&gram);
    free(output);
    return outcome;
}

outcome_t ensemble_find(const model_t* model, const play_set_t* plays, size_t num_plays,
                        ensemble_plays_t* found)
{
    if (num_plays >= plays->num_plays || num_plays > ENSEMBLE_MOST_PLAYS) {
        *found = copy_of(plays);
        return num_plays >= plays->num_plays ? OUTCOME_OK : OUTCOME_USAGE;
    }
    openblas_set_num_threads(1); // the same sums in the same order each run
    const double weight_unit = largest_weight(plays);
    drive_t drive = drive_new(model);
    ensemble_plays_t all = copy_of(plays);
    scale_plays(&all, 1.0 / drive.unit, 1.0 / weight_unit);
    const play_set_t scaled = {all.radius, all.weight, all.num_plays};
    *found = ensemble_plays_new(num_plays);
    const outcome_t outcome = find_scaled(&drive, &scaled, found);
    found->constant *= drive.unit * weight_unit;
    found->rms *= drive.unit * weight_unit;
    scale_plays(found, drive.unit, weight_unit);
    for (size_t k = 0; k < num_plays; ++k) {
        found->radius[k] =
            fmin(fmax(found->radius[k], plays->radius[0]), plays->radius[plays->num_plays - 1]);
    }
    if (outcome != OUTCOME_OK) {
        ensemble_plays_free(found);
        *found = copy_of(plays);
    }
    ensemble_plays_free(&all);
    drive_free(&drive);
    return outcome;
}

partition_t ensemble_partition(const play_set_t* plays, const ensemble_plays_t* found)
{
    partition_t partition = {.num_groups = found->num_plays,
                             .beta = xcalloc(found->num_plays + 1, sizeof(size_t)),
                             .cost = found->rms,
                             .evaluations = found->evaluations};
    size_t j = 0;
    for (size_t k = 0; k + 1 < found->num_plays; ++k) {
        while (j < plays->num_plays &&
               plays->radius[j] - found->radius[k] <= found->radius[k + 1] - plays->radius[j]) {
            ++j;
        }
        partition.beta[k + 1] = j;
    }
    partition.beta[found->num_plays] = plays->num_plays;
    return partition;
}
