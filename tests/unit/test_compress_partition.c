#include "model.h"
#include "partition.h"
#include "random.h"
#include "unity.h"
#include <stdlib.h>

enum { PAPER_PLAYS = 30, PAPER_GROUPS = 6, MOST_PLAYS = 64 };

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

/// The paper's radii r_j = j/31, with no weight yet.
static void paper_radii(plays_t* plays)
{
    for (int j = 1; j <= PAPER_PLAYS; ++j) {
        plays->radius[j - 1] = j / 31.0;
        plays->weight[j - 1] = 0.0;
    }
    plays->set = (play_set_t){plays->radius, plays->weight, PAPER_PLAYS};
}

/// The paper's peaks (weights of Eqs. (23) and (24)): 5 / sqrt(2 pi) exp(-(j - middle)^2 / denominator), for
/// the plays first ... last.
static void add_peak(plays_t* plays, int first, int last, double middle, double denominator)
{
    const double height = 5.0 / sqrt(2.0 * acos(-1.0));
    for (int j = first; j <= last; ++j) {
        plays->weight[j - 1] += height * exp(-(j - middle) * (j - middle) / denominator);
    }
}

static void assert_partition(const plays_t* plays, partition_cost_t cost, const size_t* expected)
{
    partition_t partition = partition_find(&plays->set, PAPER_GROUPS, cost);
    TEST_ASSERT_EQUAL_UINT64_ARRAY(expected, partition.beta, PAPER_GROUPS + 1);
    // 30 * 31 / 2 groups exist; those from the start or the end that leave too few plays are not needed.
    TEST_ASSERT_LESS_OR_EQUAL_UINT64(PAPER_PLAYS * (PAPER_PLAYS + 1) / 2, partition.evaluations);
    partition_free(&partition);
}

static void assert_optimal(const plays_t* plays, partition_cost_t cost, const size_t* expected)
{
    partition_t partition = partition_find(&plays->set, PAPER_GROUPS, cost);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, partition.cost,
                              partition_cost(&plays->set, expected, PAPER_GROUPS, cost));
    partition_free(&partition);
}

static void table_2_uniform_weights(void)
{
    static const size_t expected[] = {0, 5, 10, 15, 20, 25, 30};
    plays_t plays;
    paper_radii(&plays);
    for (int j = 0; j < PAPER_PLAYS; ++j) {
        plays.weight[j] = 1.0;
    }
    assert_partition(&plays, COST_ENTROPY_SUM, expected);
    assert_partition(&plays, COST_ENTROPY_MAX, expected);
    assert_partition(&plays, COST_UNIFORM, expected);
}

/// A cost that is printed with five decimals.
static void assert_printed(const plays_t* plays, partition_cost_t cost, const size_t* beta, double printed)
{
    TEST_ASSERT_DOUBLE_WITHIN(0.5e-5, printed, partition_cost(&plays->set, beta, PAPER_GROUPS, cost));
}

/// Table 3: for the maximum the paper's partition ties with the sum's.
static void table_3_one_peak(void)
{
    static const size_t sum[] = {0, 11, 13, 14, 16, 18, 30};
    static const size_t tie[] = {0, 9, 12, 14, 16, 18, 30};
    plays_t plays;
    paper_radii(&plays);
    add_peak(&plays, 1, PAPER_PLAYS, 15.0, 15.0);
    assert_partition(&plays, COST_ENTROPY_SUM, sum);
    assert_optimal(&plays, COST_ENTROPY_MAX, sum);
    assert_optimal(&plays, COST_ENTROPY_MAX, tie);
    assert_printed(&plays, COST_ENTROPY_MAX, sum, 0.03046);
    assert_printed(&plays, COST_ENTROPY_MAX, tie, 0.03046);
}

/// The two peaks of Eq. (24), one for either half.
static void two_peaks(plays_t* plays, double first_denominator, double second_denominator)
{
    paper_radii(plays);
    add_peak(plays, 1, 16, 8.0, first_denominator);
    add_peak(plays, 17, PAPER_PLAYS, 23.0, second_denominator);
}

static const size_t printed_sum[] = {0, 7, 8, 14, 22, 23, 30};
static const size_t printed_max[] = {0, 6, 8, 11, 21, 23, 30};

/// Table 4: what is printed there is not optimal for the weights that are printed.
static void table_4_two_peaks(void)
{
    static const size_t sum[] = {0, 7, 9, 16, 22, 24, 30};
    static const size_t max[] = {0, 6, 8, 12, 21, 23, 30};
    plays_t plays;
    two_peaks(&plays, 8.0, 8.0);
    assert_partition(&plays, COST_ENTROPY_SUM, sum);
    assert_optimal(&plays, COST_ENTROPY_MAX, max);
    assert_printed(&plays, COST_ENTROPY_SUM, sum, 0.29094);
    assert_printed(&plays, COST_ENTROPY_MAX, max, 0.08131);
    assert_printed(&plays, COST_ENTROPY_SUM, printed_sum, 0.32471);
    assert_printed(&plays, COST_ENTROPY_MAX, printed_max, 0.14718);
}

/// ... but it is with the denominators 4.25 and 3.25: likely a misprint of the weights.
static void table_4_with_other_denominators(void)
{
    plays_t plays;
    two_peaks(&plays, 4.25, 3.25);
    assert_optimal(&plays, COST_ENTROPY_SUM, printed_sum);
    assert_optimal(&plays, COST_ENTROPY_MAX, printed_max);
}

static void random_plays(random_t* random, plays_t* plays, size_t num_plays)
{
    double radius = 0.0;
    for (size_t j = 0; j < num_plays; ++j) {
        radius += random_below(random, 4) == 0 ? 0.0 : random_uniform(random, 0.0, 0.3);
        plays->radius[j] = radius;
        plays->weight[j] = random_below(random, 4) == 0 ? 0.0 : exp(random_uniform(random, -8.0, 2.0));
    }
    plays->set = (play_set_t){plays->radius, plays->weight, num_plays};
}

/// The least cost over all partitions, by going through them like an odometer.
static double least_of_all(const play_set_t* plays, size_t num_groups, partition_cost_t cost)
{
    size_t beta[MOST_PLAYS + 1];
    for (size_t k = 0; k <= num_groups; ++k) {
        beta[k] = k;
    }
    beta[num_groups] = plays->num_plays;
    double least = partition_cost(plays, beta, num_groups, cost);
    for (;;) {
        size_t k = num_groups - 1;
        while (k > 0 && beta[k] == plays->num_plays - (num_groups - k)) {
            --k;
        }
        if (k == 0) {
            return least;
        }
        ++beta[k];
        for (size_t next = k + 1; next < num_groups; ++next) {
            beta[next] = beta[next - 1] + 1;
        }
        least = fmin(least, partition_cost(plays, beta, num_groups, cost));
    }
}

static void no_partition_is_better(void)
{
    random_t random = random_new(5);
    for (int trial = 0; trial < 200; ++trial) {
        plays_t plays;
        const size_t num_plays = 1 + random_below(&random, 12);
        random_plays(&random, &plays, num_plays);
        for (size_t num_groups = 1; num_groups <= num_plays; ++num_groups) {
            for (int which = 0; which < 2; ++which) {
                const partition_cost_t cost = which == 0 ? COST_ENTROPY_SUM : COST_ENTROPY_MAX;
                partition_t partition = partition_find(&plays.set, num_groups, cost);
                const double least = least_of_all(&plays.set, num_groups, cost);
                // Each of the num_groups choices may be off by the 1e-12 within which costs count as equal.
                TEST_ASSERT_DOUBLE_WITHIN(1e-11 * least, least, partition.cost);
                partition_free(&partition);
            }
        }
    }
}

/// The sums about the group's first radius against the definition, term by term.
static void loss_is_entropy_times_distance(void)
{
    random_t random = random_new(6);
    for (int trial = 0; trial < 200; ++trial) {
        plays_t plays;
        const size_t num_plays = 2 + random_below(&random, 20);
        random_plays(&random, &plays, num_plays);
        plays.weight[0] = 1.0;
        double weight = 0.0;
        double moment = 0.0;
        for (size_t j = 0; j < num_plays; ++j) {
            weight += plays.weight[j];
            moment += plays.weight[j] * plays.radius[j];
        }
        double entropy = 0.0;
        double squares = 0.0;
        for (size_t j = 0; j < num_plays; ++j) {
            const double q = plays.weight[j] / weight;
            const double distance = plays.weight[j] * (plays.radius[j] - moment / weight);
            entropy -= q > 0.0 ? q * log(q) : 0.0;
            squares += distance * distance;
        }
        const size_t whole[] = {0, num_plays};
        // Radii below 6 and weights below 8 in long double: what cancels is below 20 * 6^2 * 8^2 * 2^-63 in
        // the squares, so 2e-7 in their root at worst, where the root is as small as that.
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, entropy * sqrt(squares),
                                  partition_cost(&plays.set, whole, 1, COST_ENTROPY_SUM));
    }
}

static void uniform_groups_differ_by_one_play_at_most(void)
{
    plays_t plays;
    random_t random = random_new(7);
    random_plays(&random, &plays, MOST_PLAYS);
    for (size_t num_groups = 1; num_groups <= MOST_PLAYS; ++num_groups) {
        partition_t partition = partition_find(&plays.set, num_groups, COST_UNIFORM);
        TEST_ASSERT_EQUAL_UINT64(0, partition.beta[0]);
        TEST_ASSERT_EQUAL_UINT64(MOST_PLAYS, partition.beta[num_groups]);
        for (size_t k = 0; k < num_groups; ++k) {
            const size_t count = partition.beta[k + 1] - partition.beta[k];
            TEST_ASSERT_TRUE(count == MOST_PLAYS / num_groups || count == MOST_PLAYS / num_groups + 1);
        }
        partition_free(&partition);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(table_2_uniform_weights);
    RUN_TEST(table_3_one_peak);
    RUN_TEST(table_4_two_peaks);
    RUN_TEST(table_4_with_other_denominators);
    RUN_TEST(no_partition_is_better);
    RUN_TEST(loss_is_entropy_times_distance);
    RUN_TEST(uniform_groups_differ_by_one_play_at_most);
    return UNITY_END();
}
