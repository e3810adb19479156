#include "compress.h"
#include "transport.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char compress_cost_names[] = "entropy-sum, entropy-max, wasserstein, variance, uniform";

const char* compress_cost_name(partition_cost_t cost)
{
    switch (cost) {
    case COST_ENTROPY_SUM:
        return "entropy-sum";
    case COST_ENTROPY_MAX:
        return "entropy-max";
    case COST_WASSERSTEIN:
        return "wasserstein";
    case COST_VARIANCE:
        return "variance";
    case COST_UNIFORM:
        break;
    }
    return "uniform";
}

bool compress_cost_from_name(const char* name, partition_cost_t* cost)
{
    for (partition_cost_t known = COST_ENTROPY_SUM; known <= COST_VARIANCE; ++known) {
        if (strcmp(name, compress_cost_name(known)) == 0) {
            *cost = known;
            return true;
        }
    }
    return false;
}

/// Radii do not decrease, so the plays that can move come first.
static size_t count_moving(const model_t* model)
{
    const double largest = model_largest_moving_radius(model);
    size_t count = 0;
    while (count < model->num_plays && model->radius[count] < largest) {
        ++count;
    }
    return count;
}

/// Eq. (19): a play counts by half the distance its state can travel on the range.
static double* counted_weights(const model_t* model, size_t num_moving, bool unscaled)
{
    const double largest = model_largest_moving_radius(model);
    double* counted = xcalloc(num_moving, sizeof(double));
    for (size_t j = 0; j < num_moving; ++j) {
        counted[j] = model->weight[j] * (unscaled ? 1.0 : largest - model->radius[j]);
    }
    return counted;
}

/// The group's total counted weight, turned back into a weight at the centroid: scaled by Eq. (19) the group
/// travels as far between the saturations as its plays did, unscaled it keeps their weight.
static void merge_group(const model_t* model, const double* counted, bool unscaled, size_t first, size_t end,
                        model_t* merged, size_t k)
{
    group_sums_t sums = group_sums_begin(model->radius[first]);
    long double total = 0.0L;
    for (size_t j = first; j < end; ++j) {
        group_sums_add(&sums, model->radius[j], counted[j]);
        total += (long double)counted[j];
    }
    // Rounding must not carry the centroid out of the group: the radii would no longer be in order.
    merged->radius[k] = fmin(fmax(group_centroid(&sums), model->radius[first]), model->radius[end - 1]);
    const double travel = unscaled ? 1.0 : model_largest_moving_radius(model) - merged->radius[k];
    merged->weight[k] = (double)total / travel;
}

/// sum p_j (descending(input_min) + r_j): what the plays put on the output in negative saturation.
static long double saturated_sum(const model_t* model)
{
    const long double level = (long double)curve_value(&model->descending, model->input_min);
    long double sum = 0.0L;
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += (long double)model->weight[j] * (level + (long double)model->radius[j]);
    }
    return sum;
}

/// The initial state of a play with this radius, linear between its neighbours: it stays in its strip, whose
/// sides are linear in the radius too.
static double initial_at(const model_t* model, double radius)
{
    size_t j = 0;
    while (j + 1 < model->num_plays && model->radius[j + 1] < radius) {
        ++j;
    }
    if (j + 1 == model->num_plays || !(model->radius[j + 1] > model->radius[j])) {
        return model->initial[j];
    }
    const double part = (radius - model->radius[j]) / (model->radius[j + 1] - model->radius[j]);
    return model->initial[j] + part * (model->initial[j + 1] - model->initial[j]);
}

static model_t merge(const model_t* model, const double* counted, bool unscaled, const partition_t* partition)
{
    model_t merged = model_copy(model);
    const size_t num_plays = partition->num_groups > 0 ? partition->num_groups : 1;
    model_set_num_plays(&merged, num_plays);
    merged.radius[0] = model->radius[0];
    for (size_t k = 0; k < partition->num_groups; ++k) {
        merge_group(model, counted, unscaled, partition->beta[k], partition->beta[k + 1], &merged, k);
    }
    if (model->initial != NULL) {
        merged.initial = xcalloc(num_plays, sizeof(double));
        for (size_t k = 0; k < num_plays; ++k) {
            merged.initial[k] = initial_at(model, merged.radius[k]);
        }
    }
    curve_add(&merged.nonhysteretic, (double)(saturated_sum(model) - saturated_sum(&merged)));
    return merged;
}

static void record(const model_t* model, const compression_t* compression, partition_cost_t cost,
                   bool unscaled, model_t* merged)
{
    if (merged->identification == NULL) {
        merged->identification = json_object();
    }
    const json_t* earlier = json_object_get(merged->identification, "compression");
    const double earlier_bound = json_number_value(json_object_get(earlier, "error_bound"));
    json_object_set_new(merged->identification, "compression",
                        json_pack("{s:s, s:b, s:I, s:I, s:f, s:f}", "cost_name", compress_cost_name(cost),
                                  "unscaled", unscaled ? 1 : 0, "plays_before", (json_int_t)model->num_plays,
                                  "plays", (json_int_t)merged->num_plays, "cost", compression->partition.cost,
                                  "error_bound", earlier_bound + compression->error_bound));
}

model_t compress_model(const model_t* model, const compress_options_t* options, compression_t* compression)
{
    const size_t num_moving = count_moving(model);
    double* counted = counted_weights(model, num_moving, options->unscaled);
    const play_set_t plays = {model->radius, counted, num_moving};
    *compression = (compression_t){.num_fixed = model->num_plays - num_moving};
    if (num_moving > 0) {
        const size_t num_groups = options->num_plays < num_moving ? options->num_plays : num_moving;
        compression->partition = partition_find(&plays, num_groups, options->cost);
    } else {
        compression->partition.beta = xcalloc(1, sizeof(size_t));
    }
    model_t merged = merge(model, counted, options->unscaled, &compression->partition);
    const play_set_t before = {model->radius, model->weight, num_moving};
    const play_set_t after = {merged.radius, merged.weight, compression->partition.num_groups};
    compression->error_bound =
        transport_bound(transport_between(&before, &after, model_largest_moving_radius(model)), 0.0);
    record(model, compression, options->cost, options->unscaled, &merged);
    free(counted);
    return merged;
}

model_t compress_to_tolerance(const model_t* model, const compress_options_t* options, double tolerance,
                              compression_t* compression)
{
    compress_options_t attempt = *options;
    attempt.num_plays = 1;
    // The bound need not fall with every further play, so the search goes up one by one. It ends: groups of
    // one play each have bound 0.
    model_t merged = compress_model(model, &attempt, compression);
    while (compression->error_bound > tolerance && attempt.num_plays < model->num_plays) {
        model_free(&merged);
        compression_free(compression);
        attempt.num_plays += 1;
        merged = compress_model(model, &attempt, compression);
    }
    return merged;
}

void compression_free(compression_t* compression)
{
    partition_free(&compression->partition);
    *compression = (compression_t){0};
}
