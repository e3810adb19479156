#include "compress.h"
#include "ensemble.h"
#include "replace_plays.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char compress_cost_names[] = "entropy-sum, entropy-max, wasserstein, variance, ensemble, uniform";

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
    case COST_ENSEMBLE:
        return "ensemble";
    case COST_UNIFORM:
        break;
    }
    return "uniform";
}

bool compress_cost_from_name(const char* name, partition_cost_t* cost)
{
    for (partition_cost_t known = COST_ENTROPY_SUM; known <= COST_ENSEMBLE; ++known) {
        if (strcmp(name, compress_cost_name(known)) == 0) {
            *cost = known;
            return true;
        }
    }
    return false;
}

/// A model whose moving plays are to be divided.
typedef struct {
    const model_t* model;
    const compress_options_t* options;
    partition_terms_t terms;
    play_set_t moving;
    double* counted; ///< [moving.num_plays] the weights that the partition counts
    double travel;   ///< model_largest_moving_radius
} task_t;

bool compress_is_scaled(const compress_options_t* options)
{
    const bool own_weights =
        options->cost == COST_WASSERSTEIN || options->cost == COST_VARIANCE || options->cost == COST_ENSEMBLE;
    return !own_weights && !options->unscaled;
}

static task_t task_new(const model_t* model, const compress_options_t* options)
{
    task_t task = {.model = model, .options = options, .travel = model_largest_moving_radius(model)};
    task.moving = (play_set_t){model->radius, model->weight, model_count_moving(model)};
    task.terms = (partition_terms_t){.cost = options->cost, .exhaustive = options->exhaustive};
    if (options->cost == COST_WASSERSTEIN) {
        task.terms.zero_is_free = model_takes_envelope(model);
        task.terms.limit_is_free = true;
        task.terms.limit = task.travel;
    }
    // Eq. (19): a play counts by half the distance its state can travel on the range.
    task.counted = xcalloc(task.moving.num_plays, sizeof(double));
    for (size_t j = 0; j < task.moving.num_plays; ++j) {
        task.counted[j] =
            model->weight[j] * (compress_is_scaled(options) ? task.travel - model->radius[j] : 1.0);
    }
    return task;
}

/// The plays that the partition counts.
static play_set_t counted_plays(const task_t* task)
{
    return (play_set_t){task->model->radius, task->counted, task->moving.num_plays};
}

static double total_weight(const double* weight, size_t first, size_t end)
{
    long double total = 0.0L;
    for (size_t j = first; j < end; ++j) {
        total += (long double)weight[j];
    }
    return (double)total;
}

/// Within the group: rounding must not put the radii out of order.
static double centroid(const play_set_t* plays, size_t first, size_t end)
{
    moments_t moments = {0};
    double distance = 0.0;
    for (size_t j = first; j < end; ++j) {
        moments_add(&moments, plays->radius[j], plays->weight[j]);
        distance += plays->radius[j] - plays->radius[first];
    }
    const double mean = plays->radius[first] + distance / (double)(end - first);
    return fmin(fmax(moments.weight > 0.0 ? moments.centroid : mean, plays->radius[first]),
                plays->radius[end - 1]);
}

static void merge_group(const task_t* task, size_t first, size_t end, double* radius, double* weight)
{
    const play_set_t counted = counted_plays(task);
    *radius = task->options->cost == COST_WASSERSTEIN ? counted.radius[group_median(&counted, first, end)]
                                                      : centroid(&counted, first, end);
    // Plays of one radius need no scaling back.
    const bool one_radius = !(counted.radius[first] < counted.radius[end - 1]);
    if (compress_is_scaled(task->options) && !one_radius) {
        *weight = total_weight(task->counted, first, end) / (task->travel - *radius);
    } else {
        *weight = total_weight(task->model->weight, first, end);
    }
}

/// radius, weight: [partition->num_groups].
static replacement_t merge(const task_t* task, const partition_t* partition, double* radius, double* weight)
{
    for (size_t k = 0; k < partition->num_groups; ++k) {
        merge_group(task, partition->beta[k], partition->beta[k + 1], &radius[k], &weight[k]);
    }
    replacement_t replacement = {.plays = {radius, weight, partition->num_groups}};
    replacement.envelope_weight = total_weight(task->model->weight, 0, partition->beta[0]);
    if (task->options->cost == COST_WASSERSTEIN) {
        replacement.constant = transport_centre(replacement_transport(task->model, &replacement));
    }
    return replacement;
}

static double error_bound(const task_t* task, const partition_t* partition)
{
    double* radius = xcalloc(2 * partition->num_groups, sizeof(double));
    const replacement_t replacement = merge(task, partition, radius, radius + partition->num_groups);
    const transport_t transport = replacement_transport(task->model, &replacement);
    free(radius);
    return transport_bound(transport, replacement.constant);
}

static void record(const model_t* model, const compress_options_t* options, const compression_t* compression,
                   model_t* merged)
{
    if (merged->identification == NULL) {
        merged->identification = json_object();
    }
    const json_t* earlier = json_object_get(merged->identification, "compression");
    const double earlier_bound = json_number_value(json_object_get(earlier, "error_bound"));
    json_object_set_new(
        merged->identification, "compression",
        json_pack("{s:s, s:b, s:I, s:I, s:f, s:f}", "cost_name", compress_cost_name(options->cost),
                  "unscaled", compress_is_scaled(options) ? 0 : 1, "plays_before",
                  (json_int_t)model->num_plays, "plays", (json_int_t)merged->num_plays, "cost",
                  compression->partition.cost, "error_bound", earlier_bound + compression->error_bound));
}

/// Takes the partition over.
static model_t put_in_place(const task_t* task, partition_t partition, const replacement_t* replacement,
                            compression_t* compression)
{
    *compression = (compression_t){.partition = partition,
                                   .num_fixed = task->model->num_plays - task->moving.num_plays,
                                   .envelope_weight = replacement->envelope_weight,
                                   .constant = replacement->constant};
    compression->error_bound =
        transport_bound(replacement_transport(task->model, replacement), replacement->constant);
    model_t merged = replace_plays(task->model, replacement);
    record(task->model, task->options, compression, &merged);
    return merged;
}

/// Takes the partition over.
static model_t finish(const task_t* task, partition_t partition, compression_t* compression)
{
    const size_t num_groups = partition.num_groups;
    double* radius = xcalloc(2 * num_groups, sizeof(double));
    const replacement_t replacement = merge(task, &partition, radius, radius + num_groups);
    model_t merged = put_in_place(task, partition, &replacement, compression);
    free(radius);
    return merged;
}

static model_t finish_by_ensemble(const task_t* task, size_t num_plays, compression_t* compression)
{
    ensemble_plays_t found;
    const outcome_t outcome = ensemble_find(task->model, &task->moving, num_plays, &found);
    const replacement_t replacement = {.plays = {found.radius, found.weight, found.num_plays},
                                       .constant = found.constant};
    model_t merged = put_in_place(task, ensemble_partition(&task->moving, &found), &replacement, compression);
    compression->outcome = outcome;
    ensemble_plays_free(&found);
    return merged;
}

static partition_t no_groups(void)
{
    return (partition_t){.beta = xcalloc(1, sizeof(size_t))};
}

static size_t groups_asked_for(const task_t* task)
{
    const size_t num_moving = task->moving.num_plays;
    return task->options->num_plays < num_moving ? task->options->num_plays : num_moving;
}

static partition_t find_partition(const task_t* task)
{
    if (task->moving.num_plays == 0) {
        return no_groups();
    }
    const size_t num_groups = groups_asked_for(task);
    const play_set_t counted = counted_plays(task);
    partition_t* only = partition_find_all(&counted, num_groups, num_groups, &task->terms);
    const partition_t partition = only[0];
    free(only);
    return partition;
}

model_t compress_model(const model_t* model, const compress_options_t* options, compression_t* compression)
{
    task_t task = task_new(model, options);
    model_t merged = options->cost == COST_ENSEMBLE && task.moving.num_plays > 0
                         ? finish_by_ensemble(&task, options->num_plays, compression)
                         : finish(&task, find_partition(&task), compression);
    free(task.counted);
    return merged;
}

double compress_partition_count(const model_t* model, const compress_options_t* options)
{
    task_t task = task_new(model, options);
    const size_t num_moving = task.moving.num_plays;
    const double count =
        num_moving > 0 ? partition_count(num_moving, groups_asked_for(&task), &task.terms) : 0.0;
    free(task.counted);
    return count;
}

/// No partition into fewer groups meets the tolerance, whatever the cost: wasserstein's bound is the least.
static size_t least_groups(const task_t* task, double tolerance)
{
    const partition_terms_t terms = {.cost = COST_WASSERSTEIN,
                                     .zero_is_free = model_takes_envelope(task->model),
                                     .limit_is_free = true,
                                     .limit = task->travel};
    // Sums in another order may round the other way.
    return partition_least_groups(&task->moving, &terms, tolerance * (1.0 + 1e-12));
}

/// The first of the partitions whose bound is met, or the last; the others are freed.
static partition_t first_within(const task_t* task, partition_t* partitions, size_t count, double tolerance,
                                bool* met)
{
    size_t chosen = 0;
    *met = error_bound(task, &partitions[0]) <= tolerance;
    while (!*met && chosen + 1 < count) {
        chosen += 1;
        *met = error_bound(task, &partitions[chosen]) <= tolerance;
    }
    const partition_t partition = partitions[chosen];
    for (size_t i = 0; i < count; ++i) {
        if (i != chosen) {
            partition_free(&partitions[i]);
        }
    }
    free(partitions);
    return partition;
}

/// The bound need not fall with every further play, so all numbers of groups are tried, from the least that
/// any partition could do with, in spans that double. It ends: groups of one play each change nothing.
static partition_t find_within(const task_t* task, double tolerance)
{
    const play_set_t counted = counted_plays(task);
    const size_t num_moving = counted.num_plays;
    if (num_moving == 0) {
        return no_groups();
    }
    size_t least = least_groups(task, tolerance);
    for (size_t span = 8 + least / 4;; span *= 2) {
        const size_t most = least + span - 1 < num_moving ? least + span - 1 : num_moving;
        partition_t* partitions = partition_find_all(&counted, least, most, &task->terms);
        bool met;
        partition_t partition = first_within(task, partitions, most - least + 1, tolerance, &met);
        if (met || most == num_moving) {
            return partition;
        }
        partition_free(&partition);
        least = most + 1;
    }
}

static model_t ensemble_within(const task_t* task, double tolerance, compression_t* compression)
{
    size_t num_plays = least_groups(task, tolerance);
    model_t merged = finish_by_ensemble(task, num_plays, compression);
    while (compression->error_bound > tolerance && num_plays < task->moving.num_plays) {
        model_free(&merged);
        compression_free(compression);
        num_plays += 1;
        merged = finish_by_ensemble(task, num_plays, compression);
    }
    return merged;
}

model_t compress_to_tolerance(const model_t* model, const compress_options_t* options, double tolerance,
                              compression_t* compression)
{
    task_t task = task_new(model, options);
    model_t merged = options->cost == COST_ENSEMBLE && task.moving.num_plays > 0
                         ? ensemble_within(&task, tolerance, compression)
                         : finish(&task, find_within(&task, tolerance), compression);
    free(task.counted);
    return merged;
}

void compression_free(compression_t* compression)
{
    partition_free(&compression->partition);
    *compression = (compression_t){0};
}
