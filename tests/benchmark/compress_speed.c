/// compress_speed: how long partitions of many plays take, and the memory they need.
#include "partition.h"
#include "random.h"
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

/// Processor time of this process: other programs on the machine do not count.
static double seconds(void)
{
    return (double)clock() / (double)CLOCKS_PER_SEC;
}

/// The process's largest memory so far [MiB].
static double peak_memory(void)
{
    struct rusage usage;
    (void)getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_maxrss / 1024.0;
}

static void measure(const char* name, partition_cost_t cost, size_t num_plays, size_t num_groups,
                    double limit)
{
    double* radius = malloc(2 * num_plays * sizeof(double));
    if (radius == NULL) {
        fprintf(stderr, "compress_speed: out of memory\n");
        exit(EXIT_FAILURE);
    }
    double* weight = radius + num_plays;
    random_t random = random_new(num_plays);
    for (size_t j = 0; j < num_plays; ++j) {
        radius[j] = ((double)j + random_uniform(&random, 0.0, 1.0)) / (double)num_plays;
        weight[j] = exp(random_uniform(&random, -3.0, 3.0));
    }
    const play_set_t plays = {radius, weight, num_plays};
    const double start = seconds();
    partition_t partition = partition_find(&plays, num_groups, cost);
    const double taken = seconds() - start;
    printf("| %s | %zu | %zu | %.3f | %.1f | %zu | %.0f |\n", name, num_plays, num_groups, taken, limit,
           partition.evaluations, peak_memory());
    fflush(stdout);
    partition_free(&partition);
    free(radius);
}

int main(void)
{
    puts("| cost | plays | groups | time, s | limit, s | evaluations | peak memory so far, MiB |");
    puts("|---|---|---|---|---|---|---|");
    measure("entropy-sum", COST_ENTROPY_SUM, 10000, 16, 3.0);
    measure("entropy-max", COST_ENTROPY_MAX, 10000, 16, 3.0);
    measure("wasserstein", COST_WASSERSTEIN, 100000, 16, 0.2);
    measure("variance", COST_VARIANCE, 100000, 16, 0.2);
    measure("wasserstein", COST_WASSERSTEIN, 1000000, 16, 3.0);
    measure("variance", COST_VARIANCE, 1000000, 16, 3.0);
    return EXIT_SUCCESS;
}
