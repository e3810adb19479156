/// paper_study [DIR]: sections 4 and 5 of Zhang et al. 2015 again, as Markdown on stdout; the data of the
/// plots as tables in DIR.
#include "output_range.h"
#include "paper_study_methods.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { NUM_INPUTS = 50, SMALL = 6, MOST_KEPT = 10, NUM_DRAWS = 10, INPUT_SEED = 20 };

static FILE* open_data(const char* directory, const char* name)
{
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/%s", directory, name);
    FILE* file = length > 0 && (size_t)length < sizeof path ? fopen(path, "w") : NULL;
    if (file == NULL) {
        message_error(OUTCOME_IO, (location_t){.file = path}, "cannot be written: %s", strerror(errno));
        exit(OUTCOME_IO);
    }
    return file;
}

static void close_data(FILE* file)
{
    if (fclose(file) != 0) {
        message_error(OUTCOME_IO, NOWHERE, "a table of a plot could not be written: %s", strerror(errno));
        exit(OUTCOME_IO);
    }
}

static void print_partition(const size_t* beta, size_t num_groups)
{
    printf("(");
    for (size_t k = 0; k <= num_groups; ++k) {
        printf(k == 0 ? "%zu" : ",%zu", beta[k]);
    }
    printf(")");
}

/// A partition that the paper prints.
typedef struct {
    study_case_t which;
    partition_cost_t cost;
    size_t beta[SMALL + 1];
} printed_t;

static const printed_t printed[] = {
    {CASE_UNIFORM, COST_ENTROPY_SUM, {0, 5, 10, 15, 20, 25, 30}},
    {CASE_UNIFORM, COST_ENTROPY_MAX, {0, 5, 10, 15, 20, 25, 30}},
    {CASE_ONE_PEAK, COST_ENTROPY_SUM, {0, 11, 13, 14, 16, 18, 30}},
    {CASE_ONE_PEAK, COST_ENTROPY_MAX, {0, 9, 12, 14, 16, 18, 30}},
    {CASE_TWO_PEAKS, COST_ENTROPY_SUM, {0, 7, 8, 14, 22, 23, 30}},
    {CASE_TWO_PEAKS, COST_ENTROPY_MAX, {0, 6, 8, 11, 21, 23, 30}},
};

static void print_printed_tables(void)
{
    printf("## Tables 2 to 4: the partitions, theirs and ours\n\n"
           "N = 30, M = 6, weights unscaled. J is Eqs. (17), (18) of either partition with the weights as "
           "printed. In "
           "Table 4 the printed\n"
           "partitions are not optimal for the printed weights.\n\n"
           "| weights | cost | theirs | J | ours | J |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof printed / sizeof *printed; ++i) {
        model_t model = study_model(printed[i].which, 1);
        const play_set_t plays = {model.radius, model.weight, model.num_plays};
        partition_t ours = partition_find(&plays, SMALL, printed[i].cost);
        printf("| %s | %s | ", study_case_name(printed[i].which), compress_cost_name(printed[i].cost));
        print_partition(printed[i].beta, SMALL);
        printf(" | %.5f | ", partition_cost(&plays, printed[i].beta, SMALL, printed[i].cost));
        print_partition(ours.beta, SMALL);
        printf(" | %.5f |\n", ours.cost);
        partition_free(&ours);
        model_free(&model);
    }
}

static void print_errors(const model_t* model, const compressed_t* compressed)
{
    const double percent = 100.0 / (model_output_max(model) - model_output_min(model));
    study_input_t training = study_training_input(model);
    const study_error_t on_training = study_error(model, &compressed->model, &training);
    const study_errors_t errors = study_random_errors(model, &compressed->model, INPUT_SEED, NUM_INPUTS);
    printf(" | %.3f | %.3f | %.3f | %.3f | %.3f |\n", percent * on_training.rmse, percent * errors.mean,
           percent * errors.worst, percent * errors.refitted, percent * compressed->compression.error_bound);
    study_input_free(&training);
}

static void print_case(study_case_t which)
{
    model_t model = study_model(which, 1);
    printf(
        "\n### %s\n\n"
        "| cost | partition | training-like | random, mean | random, worst | constant re-fitted | bound |\n"
        "|---|---|---|---|---|---|---|\n",
        study_case_name(which));
    for (int method = 0; method < NUM_METHODS; ++method) {
        compressed_t compressed = method_run(method, &model, SMALL);
        printf("| %s | ", method_name(method));
        if (method != METHOD_RIVAL) {
            print_partition(compressed.compression.partition.beta,
                            compressed.compression.partition.num_groups);
        }
        print_errors(&model, &compressed);
        compressed_free(&compressed);
    }
    model_free(&model);
}

static double refitted(int method, study_case_t which, uint64_t seed)
{
    model_t model = study_model(which, seed);
    compressed_t compressed = method_run(method, &model, SMALL);
    const double error = study_random_errors(&model, &compressed.model, INPUT_SEED, NUM_INPUTS).refitted;
    compressed_free(&compressed);
    model_free(&model);
    return error;
}

enum { METHOD_ENTROPY_SUM = 0, METHOD_ENTROPY_SUM_UNSCALED = 1, METHOD_ENSEMBLE = METHOD_RIVAL - 1 };

static void print_specification(void)
{
    printf("\n## `ensemble` against `entropy-sum`\n\n"
           "RMSE over the random inputs, constant re-fitted for both; random weights: mean over %d draws "
           "(least to "
           "largest).\n\n"
           "| weights | / entropy-sum | / entropy-sum, unscaled | asked for |\n|---|---|---|---|\n",
           NUM_DRAWS);
    for (int which = 0; which < NUM_CASES; ++which) {
        double sums[3] = {0.0, 0.0, 0.0};
        double least = (double)INFINITY;
        double largest = 0.0;
        for (uint64_t seed = 1; seed <= (which == CASE_RANDOM ? NUM_DRAWS : 1U); ++seed) {
            const double ensemble = refitted(METHOD_ENSEMBLE, (study_case_t)which, seed);
            const double scaled = refitted(METHOD_ENTROPY_SUM, (study_case_t)which, seed);
            sums[0] += ensemble;
            sums[1] += scaled;
            sums[2] += refitted(METHOD_ENTROPY_SUM_UNSCALED, (study_case_t)which, seed);
            least = fmin(least, ensemble / scaled);
            largest = fmax(largest, ensemble / scaled);
        }
        printf("| %s | %.3f", study_case_name((study_case_t)which), sums[0] / sums[1]);
        if (which == CASE_RANDOM) {
            printf(" (%.3f to %.3f)", least, largest);
        }
        const bool peaked = which == CASE_ONE_PEAK || which == CASE_TWO_PEAKS;
        printf(" | %.3f | %s |\n", sums[0] / sums[2], which == CASE_VO2 ? "" : peaked ? "0.85" : "0.6");
    }
}

/// The error over the number of plays, on the case of Fig. 12's kind: many random inputs.
static void print_numbers_of_plays(study_case_t which, const char* directory)
{
    model_t model = study_model(which, 1);
    const double percent = 100.0 / (model_output_max(&model) - model_output_min(&model));
    FILE* data = directory != NULL ? open_data(directory, "error.dat") : NULL;
    printf("\n### %s\n\n| cost |", study_case_name(which));
    for (size_t kept = 1; kept <= MOST_KEPT; ++kept) {
        printf(" %zu |", kept);
    }
    printf("\n|---|");
    for (size_t kept = 1; kept <= MOST_KEPT; ++kept) {
        printf("---|");
    }
    for (int method = 0; method < NUM_METHODS; ++method) {
        printf("\n| %s |", method_name(method));
        for (size_t kept = 1; kept <= MOST_KEPT; ++kept) {
            compressed_t compressed = method_run(method, &model, kept);
            const double mean =
                percent * study_random_errors(&model, &compressed.model, INPUT_SEED, NUM_INPUTS).mean;
            printf(" %.3f |", mean);
            if (data != NULL) {
                fprintf(data, "%zu %.6g %.6g\n", kept, mean, percent * compressed.compression.error_bound);
            }
            compressed_free(&compressed);
        }
        if (data != NULL) {
            fprintf(data, "\n\n");
        }
    }
    printf("\n");
    if (data != NULL) {
        close_data(data);
    }
    model_free(&model);
}

static void write_weights(const char* directory)
{
    static const int shown[] = {METHOD_ENTROPY_SUM_UNSCALED, 6, METHOD_ENSEMBLE};
    for (int which = 0; which < NUM_CASES; ++which) {
        char name[32];
        (void)snprintf(name, sizeof name, "weights_%d.dat", which);
        FILE* data = open_data(directory, name);
        model_t model = study_model((study_case_t)which, 1);
        for (size_t j = 0; j < model.num_plays; ++j) {
            fprintf(data, "%.6g %.6g\n", model.radius[j], model.weight[j]);
        }
        for (size_t i = 0; i < sizeof shown / sizeof *shown; ++i) {
            compressed_t compressed = method_run(shown[i], &model, SMALL);
            fprintf(data, "\n\n");
            for (size_t k = 0; k < compressed.model.num_plays; ++k) {
                fprintf(data, "%.6g %.6g\n", compressed.model.radius[k], compressed.model.weight[k]);
            }
            compressed_free(&compressed);
        }
        close_data(data);
        model_free(&model);
    }
}

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/// Figs. 9 and 10: what finding the partition costs.
static void print_search(const char* directory)
{
    FILE* data = directory != NULL ? open_data(directory, "search.dat") : NULL;
    model_t model = study_model(CASE_TWO_PEAKS, 1);
    const play_set_t plays = {model.radius, model.weight, model.num_plays};
    printf("\n## Figs. 9 and 10: dynamic programming and exhaustive search\n\n"
           "N = 30, two peaks, cost entropy-sum: groups whose loss was evaluated, and milliseconds. The "
           "paper's section "
           "3.2 counts\n"
           "M (2N - M + 1) / 2 evaluations, one a state; a loss depends on a group, of which there are at "
           "most N "
           "(N + 1) / 2.\n\n"
           "| M | DP evaluations | ms | exhaustive evaluations | ms | partitions | same cost |\n"
           "|---|---|---|---|---|---|---|\n");
    for (size_t num_groups = 2; num_groups <= 7; ++num_groups) {
        partition_t* found[2];
        double elapsed[2];
        double count = 0.0;
        for (int exhaustive = 0; exhaustive < 2; ++exhaustive) {
            const partition_terms_t terms = {.cost = COST_ENTROPY_SUM, .exhaustive = exhaustive != 0};
            const double begin = seconds_now();
            found[exhaustive] = partition_find_all(&plays, num_groups, num_groups, &terms);
            elapsed[exhaustive] = 1e3 * (seconds_now() - begin);
            count = partition_count(plays.num_plays, num_groups, &terms);
        }
        const bool same = fabs(found[0]->cost - found[1]->cost) <= 1e-11 * found[1]->cost;
        printf("| %zu | %zu | %.3f | %zu | %.3f | %.0f | %s |\n", num_groups, found[0]->evaluations,
               elapsed[0], found[1]->evaluations, elapsed[1], count, same ? "yes" : "NO");
        if (data != NULL) {
            fprintf(data, "%zu %zu %.6g %zu %.6g\n", num_groups, found[0]->evaluations, elapsed[0],
                    found[1]->evaluations, elapsed[1]);
        }
        for (int i = 0; i < 2; ++i) {
            partition_free(found[i]);
            free(found[i]);
        }
    }
    if (data != NULL) {
        close_data(data);
    }
    model_free(&model);
}

int main(int argc, char** argv)
{
    if (argc > 2) {
        fprintf(stderr, "usage: paper_study [DIR]\n");
        return OUTCOME_USAGE;
    }
    const char* directory = argc == 2 ? argv[1] : NULL;
    printf(
        "# Sections 4 and 5 of Zhang et al. 2015 again\n\n"
        "Made, with plots, by `sh tests/benchmark/paper_study.sh build/release/tests/paper_study DIR`.\n\n");
    print_printed_tables();
    printf("\n## All costs: 30 plays to 6\n\n"
           "In %% of the output's range. Training-like: alternations that decay from the whole range to a "
           "tenth. Random: "
           "%d inputs of 30\n"
           "reversals, seed %d, the RMSE's mean and worst, and over all of them with one constant re-fitted. "
           "Bound: over "
           "every input.\n"
           "The last row has radii, weights and constant fitted to one third-order reversal input (section "
           "4.6): best of "
           "20 starts.\n",
           NUM_INPUTS, INPUT_SEED);
    for (int which = 0; which < NUM_CASES; ++which) {
        print_case((study_case_t)which);
    }
    print_specification();
    printf("\n## Error over the number of plays (the study of Fig. 12)\n\n"
           "Mean RMSE over the random inputs in %% of range.\n");
    print_numbers_of_plays(CASE_RANDOM, directory);
    print_numbers_of_plays(CASE_VO2, NULL);
    print_search(directory);
    printf(
        "\n## What cannot be compared digit by digit\n\n"
        "Table 1 (the envelopes of section 4) and the inputs of Figs. 5, 11 and 12 are not in the text, and "
        "Fig. 15's "
        "weights are only\n"
        "plotted: envelopes (tanh(v -+ 0.2) on [-4, 4]), inputs and the VO2-like weights are ours, so error "
        "percentages (Tables 5 and 7,\n"
        "Fig. 12) compare in kind.\n");
    if (directory != NULL) {
        write_weights(directory);
    }
    return OUTCOME_OK;
}
