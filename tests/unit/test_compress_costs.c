#include "interval_table.h"
#include "partition.h"
#include "random.h"
#include "unity.h"
#include <stdbool.h>
#include <stdlib.h>

enum { MOST_PLAYS = 200 };

static const partition_cost_t searched[] = {COST_ENTROPY_SUM, COST_ENTROPY_MAX, COST_WASSERSTEIN,
                                            COST_VARIANCE};
enum { NUM_SEARCHED = sizeof searched / sizeof searched[0] };

typedef struct {
    double radius[MOST_PLAYS], weight[MOST_PLAYS];
    play_set_t set;
} plays_t;

void setUp(void)
{
}

void tearDown(void)
{
}

/// With ties: equal radii, weights of 0 and equal weights.
static void random_plays(random_t* random, plays_t* plays, size_t num_plays, bool ties)
{
    double radius = random_uniform(random, 0.0, 0.3);
    for (size_t j = 0; j < num_plays; ++j) {
        const bool again = ties && j > 0 && random_below(random, 4) == 0;
        radius += again ? 0.0 : random_uniform(random, 0.0, 0.3);
        plays->radius[j] = radius;
        plays->weight[j] = exp(random_uniform(random, -8.0, 2.0));
        if (ties && random_below(random, 3) == 0) {
            plays->weight[j] = (double)random_below(random, 3);
        }
    }
    plays->set = (play_set_t){plays->radius, plays->weight, num_plays};
}

static partition_t find(const play_set_t* plays, size_t num_groups, partition_terms_t terms, bool exhaustive)
{
    terms.exhaustive = exhaustive;
    partition_t* only = partition_find_all(plays, num_groups, num_groups, &terms);
    const partition_t partition = only[0];
    free(only);
    return partition;
}

static void assert_valid(const play_set_t* plays, const partition_t* partition,
                         const partition_terms_t* terms)
{
    const size_t* beta = partition->beta;
    TEST_ASSERT_TRUE(terms->zero_is_free || beta[0] == 0);
    TEST_ASSERT_TRUE(terms->limit_is_free || beta[partition->num_groups] == plays->num_plays);
    TEST_ASSERT_TRUE(beta[partition->num_groups] <= plays->num_plays);
    for (size_t k = 0; k < partition->num_groups; ++k) {
        TEST_ASSERT_TRUE(beta[k] < beta[k + 1]);
    }
    TEST_ASSERT_EQUAL_DOUBLE(partition->cost, partition_cost_on(plays, beta, partition->num_groups, terms));
}

static void compare_methods(random_t* random, bool ties)
{
    plays_t plays;
    const size_t num_plays = 1 + random_below(random, 12);
    random_plays(random, &plays, num_plays, ties);
    for (size_t c = 0; c < NUM_SEARCHED; ++c) {
        const size_t num_groups = 1 + random_below(random, num_plays);
        partition_terms_t terms = {.cost = searched[c]};
        if (terms.cost == COST_WASSERSTEIN) {
            terms.zero_is_free = random_below(random, 2) == 0;
            terms.limit_is_free = random_below(random, 2) == 0;
            terms.limit = plays.radius[num_plays - 1] + random_uniform(random, 0.0, 0.5);
        }
        partition_t dp = find(&plays.set, num_groups, terms, false);
        partition_t all = find(&plays.set, num_groups, terms, true);
        assert_valid(&plays.set, &dp, &terms);
        assert_valid(&plays.set, &all, &terms);
        // Each of the num_groups choices may be off by the 1e-12 within which costs count as equal.
        TEST_ASSERT_DOUBLE_WITHIN(1.5e-11 * all.cost, all.cost, dp.cost);
        // Without ties the best partition of a sum is unique.
        if (!ties && terms.cost != COST_ENTROPY_MAX) {
            TEST_ASSERT_EQUAL_UINT64_ARRAY(all.beta, dp.beta, num_groups + 1);
        }
        partition_free(&dp);
        partition_free(&all);
    }
}

static void dynamic_programme_equals_exhaustive_search(void)
{
    random_t random = random_new(11);
    for (int trial = 0; trial < 1000; ++trial) {
        compare_methods(&random, trial % 2 == 0);
    }
}

/// The least cost by the plain dynamic programme over all starts, for an additive cost.
static double least_sum(const play_set_t* plays, size_t num_groups, partition_cost_t cost)
{
    static double least[MOST_PLAYS + 1];
    static double next[MOST_PLAYS + 1];
    for (size_t end = 0; end <= plays->num_plays; ++end) {
        least[end] = end == 0 ? 0.0 : (double)INFINITY;
    }
    for (size_t k = 1; k <= num_groups; ++k) {
        for (size_t end = 0; end <= plays->num_plays; ++end) {
            next[end] = (double)INFINITY;
            for (size_t start = k - 1; start < end; ++start) {
                const play_set_t own = {plays->radius + start, plays->weight + start, end - start};
                const size_t whole[] = {0, end - start};
                next[end] = fmin(next[end], least[start] + partition_cost(&own, whole, 1, cost));
            }
        }
        for (size_t end = 0; end <= plays->num_plays; ++end) {
            least[end] = next[end];
        }
    }
    return least[plays->num_plays];
}

/// Lengths about powers of two, where the interval table's splits lie.
static void divide_and_conquer_equals_the_plain_programme(void)
{
    static const size_t lengths[] = {31, 32, 33, 64, 71};
    random_t random = random_new(12);
    for (size_t i = 0; i < 10; ++i) {
        plays_t plays;
        random_plays(&random, &plays, lengths[i % 5], i < 5);
        const size_t num_groups = 2 + random_below(&random, 6);
        for (int which = 0; which < 2; ++which) {
            const partition_cost_t cost = which == 0 ? COST_WASSERSTEIN : COST_VARIANCE;
            partition_t partition = partition_find(&plays.set, num_groups, cost);
            const double least = least_sum(&plays.set, num_groups, cost);
            // Sums of at most 71 terms >= 0 and merged moments: some hundred roundings.
            TEST_ASSERT_DOUBLE_WITHIN(1e-13 * least, least, partition.cost);
            partition_free(&partition);
        }
    }
}

/// Every number of groups in one go gives what one at a time gives.
static void all_numbers_of_groups_at_once(void)
{
    random_t random = random_new(13);
    plays_t plays;
    random_plays(&random, &plays, 40, true);
    for (size_t c = 0; c < NUM_SEARCHED; ++c) {
        const partition_terms_t terms = {.cost = searched[c]};
        partition_t* all = partition_find_all(&plays.set, 1, 40, &terms);
        for (size_t k = 1; k <= 40; ++k) {
            partition_t one = partition_find(&plays.set, k, searched[c]);
            TEST_ASSERT_DOUBLE_WITHIN(4e-11 * one.cost, one.cost, all[k - 1].cost);
            TEST_ASSERT_EQUAL_UINT64(k, all[k - 1].num_groups);
            partition_free(&one);
            partition_free(&all[k - 1]);
        }
        free(all);
    }
}

/// Weights from 1e-12 to 1e6; clusters 0.3 apart on average and 1e-7 wide.
static void ill_scaled_plays(random_t* random, plays_t* plays, size_t num_plays)
{
    double radius = 0.1;
    for (size_t j = 0; j < num_plays; ++j) {
        const bool apart = random_below(random, 8) == 0;
        radius += apart ? random_uniform(random, 0.1, 0.5) : random_uniform(random, 0.0, 1e-7);
        plays->radius[j] = radius;
        plays->weight[j] = pow(10.0, random_uniform(random, -12.0, 6.0));
    }
    plays->set = (play_set_t){plays->radius, plays->weight, num_plays};
}

typedef struct {
    double loss, inertia, to_last, to_first;
} direct_t;

/// From the definitions, differences of radii and sums of other plays alone, so that nothing but long
/// double's own rounding is lost.
static direct_t direct_sums(const play_set_t* plays, size_t first, size_t last)
{
    long double total = 0.0L;
    for (size_t j = first; j <= last; ++j) {
        total += (long double)plays->weight[j];
    }
    long double entropy = 0.0L;
    long double sums[4] = {0.0L, 0.0L, 0.0L, 0.0L};
    for (size_t j = first; j <= last; ++j) {
        const long double p = (long double)plays->weight[j];
        const long double r = (long double)plays->radius[j];
        long double others = 0.0L;
        long double moment = 0.0L;
        for (size_t i = first; i <= last; ++i) {
            others += i == j ? 0.0L : (long double)plays->weight[i];
            moment += (long double)plays->weight[i] * (r - (long double)plays->radius[i]);
        }
        const long double from_centroid = moment / total;
        entropy += p * log1pl(others / p);
        sums[0] += p * p * from_centroid * from_centroid;
        sums[1] += p * from_centroid * from_centroid;
        sums[2] += p * ((long double)plays->radius[last] - r);
        sums[3] += p * (r - (long double)plays->radius[first]);
    }
    return (direct_t){(double)(entropy / total * sqrtl(sums[0])), (double)sums[1], (double)sums[2],
                      (double)sums[3]};
}

/// The specification's 1e-10, on every run of ill-scaled plays.
static void tables_agree_with_direct_summation(void)
{
    enum { NUM_PLAYS = 50 };
    random_t random = random_new(14);
    for (int trial = 0; trial < 5; ++trial) {
        plays_t plays;
        ill_scaled_plays(&random, &plays, NUM_PLAYS);
        interval_table_t entropy = interval_table_new(&plays.set, interval_entropy);
        interval_table_t inertia = interval_table_new(&plays.set, interval_inertia);
        interval_table_t distance = interval_table_new(&plays.set, interval_distance);
        for (size_t last = 0; last < NUM_PLAYS; ++last) {
            double value[4][NUM_PLAYS];
            interval_table_row(&entropy, join_entropy_loss, 0, last + 1, last, value[0]);
            interval_table_row(&inertia, join_inertia, 0, last + 1, last, value[1]);
            interval_table_row(&distance, join_distance_to_last, 0, last + 1, last, value[2]);
            interval_table_row(&distance, join_distance_to_first, 0, last + 1, last, value[3]);
            for (size_t first = 0; first <= last; ++first) {
                const direct_t direct = direct_sums(&plays.set, first, last);
                TEST_ASSERT_DOUBLE_WITHIN(1e-10 * direct.loss, direct.loss, value[0][first]);
                TEST_ASSERT_DOUBLE_WITHIN(1e-10 * direct.inertia, direct.inertia, value[1][first]);
                TEST_ASSERT_DOUBLE_WITHIN(1e-10 * direct.to_last, direct.to_last, value[2][first]);
                TEST_ASSERT_DOUBLE_WITHIN(1e-10 * direct.to_first, direct.to_first, value[3][first]);
            }
        }
        interval_table_free(&entropy);
        interval_table_free(&inertia);
        interval_table_free(&distance);
    }
}

/// A power of two more in radii or weights changes no partition, and the cost by that power, however far.
static void scale_does_not_matter(void)
{
    random_t random = random_new(15);
    plays_t plays;
    random_plays(&random, &plays, 20, false);
    for (size_t c = 0; c < NUM_SEARCHED; ++c) {
        partition_t near = partition_find(&plays.set, 4, searched[c]);
        plays_t far = plays;
        for (size_t j = 0; j < 20; ++j) {
            far.radius[j] = ldexp(plays.radius[j], -300);
            far.weight[j] = ldexp(plays.weight[j], 600);
        }
        far.set = (play_set_t){far.radius, far.weight, 20};
        partition_t scaled = partition_find(&far.set, 4, searched[c]);
        TEST_ASSERT_EQUAL_UINT64_ARRAY(near.beta, scaled.beta, 5);
        const int exponent = searched[c] == COST_VARIANCE ? 0 : 300;
        TEST_ASSERT_TRUE(ldexp(near.cost, exponent) == scaled.cost);
        partition_free(&near);
        partition_free(&scaled);
    }
}

static void assert_costs_nothing(const play_set_t* plays, size_t num_groups)
{
    for (size_t c = 0; c < NUM_SEARCHED; ++c) {
        for (int exhaustive = 0; exhaustive < 2; ++exhaustive) {
            const partition_terms_t terms = {.cost = searched[c]};
            partition_t partition = find(plays, num_groups, terms, exhaustive != 0);
            assert_valid(plays, &partition, &terms);
            TEST_ASSERT_TRUE(partition.cost == 0.0);
            partition_free(&partition);
        }
    }
}

static void equal_radii_zero_weights_and_single_plays_cost_nothing(void)
{
    const double equal[] = {0.3, 0.3, 0.3, 0.3, 0.3};
    const double radius[] = {0.1, 0.2, 0.2, 0.7, 0.7};
    const double weight[] = {1.0, 0.0, 2.0, 1e-9, 3.0};
    const double none[] = {0.0, 0.0, 0.0, 0.0, 0.0};
    for (size_t num_groups = 1; num_groups <= 5; ++num_groups) {
        assert_costs_nothing(&(play_set_t){equal, weight, 5}, num_groups);
        assert_costs_nothing(&(play_set_t){radius, none, 5}, num_groups);
    }
    // As many groups as different radii, more, and one for each play.
    for (size_t num_groups = 3; num_groups <= 5; ++num_groups) {
        assert_costs_nothing(&(play_set_t){radius, weight, 5}, num_groups);
    }
    assert_costs_nothing(&(play_set_t){radius, weight, 1}, 1);
}

static void counts_of_partitions(void)
{
    const partition_terms_t plain = {.cost = COST_WASSERSTEIN};
    const partition_terms_t free_ends = {
        .cost = COST_WASSERSTEIN, .zero_is_free = true, .limit_is_free = true, .limit = 1.0};
    TEST_ASSERT_EQUAL_DOUBLE(118755.0, partition_count(30, 6, &plain));      // 29 over 5
    TEST_ASSERT_EQUAL_DOUBLE(2629575.0, partition_count(30, 6, &free_ends)); // 31 over 7
    TEST_ASSERT_EQUAL_DOUBLE(1.0, partition_count(1, 1, &plain));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(dynamic_programme_equals_exhaustive_search);
    RUN_TEST(divide_and_conquer_equals_the_plain_programme);
    RUN_TEST(all_numbers_of_groups_at_once);
    RUN_TEST(tables_agree_with_direct_summation);
    RUN_TEST(scale_does_not_matter);
    RUN_TEST(equal_radii_zero_weights_and_single_plays_cost_nothing);
    RUN_TEST(counts_of_partitions);
    return UNITY_END();
}
