#include "interval_table.h"
#include <math.h>

/// Fields of the entropy loss. Centroids are counted from the split's play outward, so that two of them are
/// apart by a sum.
enum { WEIGHT, LOG_WEIGHT, ENTROPY, CENTROID, SQUARE, LAG, SQUARE_INERTIA, NUM_ENTROPY_FIELDS };

static void store_entropy(const group_sums_t* sums, double origin, double* field, size_t stride)
{
    const moments_t* plain = &sums->plain;
    const moments_t* square = &sums->square;
    field[WEIGHT * stride] = plain->weight;
    field[LOG_WEIGHT * stride] = plain->weight > 0.0 ? log(plain->weight) : 0.0;
    field[ENTROPY * stride] = sums->entropy;
    field[CENTROID * stride] = plain->weight > 0.0 ? (plain->centroid - origin) + plain->centroid_rest : 0.0;
    field[SQUARE * stride] = square->weight;
    field[LAG * stride] = sums->lag;
    field[SQUARE_INERTIA * stride] = square->inertia;
}

static void gather_entropy(const play_set_t* plays, size_t split, size_t begin, size_t end, double* field)
{
    const double origin = plays->radius[split];
    group_sums_t sums = group_sums_begin(origin);
    for (size_t i = split; i < end; ++i) {
        group_sums_add(&sums, plays->radius[i], plays->weight[i]);
        store_entropy(&sums, origin, field + i, plays->num_plays);
    }
    sums = group_sums_begin(origin);
    for (size_t i = split; i-- > begin;) {
        group_sums_add(&sums, plays->radius[i], plays->weight[i]);
        store_entropy(&sums, origin, field + i, plays->num_plays);
    }
}

const interval_kind_t interval_entropy = {NUM_ENTROPY_FIELDS, gather_entropy};

/// part / whole, 0 where there is nothing.
static double share_of(double part, double whole)
{
    return whole > 0.0 ? part / whole : 0.0;
}

/// One field at all places of the joint's level.
static const double* field_of(const interval_joint_t* joint, size_t f)
{
    return joint->field + f * joint->plays->num_plays;
}

void join_entropy_loss(const interval_joint_t* joint, size_t first, size_t end, double* value)
{
    const size_t last = joint->last;
    const double* restrict weight = field_of(joint, WEIGHT);
    const double* restrict log_weight = field_of(joint, LOG_WEIGHT);
    const double* restrict own_entropy = field_of(joint, ENTROPY);
    const double* restrict centroid = field_of(joint, CENTROID);
    const double* restrict square = field_of(joint, SQUARE);
    const double* restrict own_lag = field_of(joint, LAG);
    const double* restrict own_inertia = field_of(joint, SQUARE_INERTIA);
    const lag_part_t end_part = {weight[last], square[last], own_lag[last]};
    for (size_t i = first; i < end; ++i) {
        const double total = weight[i] + weight[last];
        const double entropy = own_entropy[i] + own_entropy[last] +
                               entropy_of_mixing(weight[i], log_weight[i], weight[last], log_weight[last]);
        const double apart = centroid[last] - centroid[i];
        const double square_apart = apart + (own_lag[last] - own_lag[i]);
        const double lag = lag_of_both((lag_part_t){weight[i], square[i], own_lag[i]}, end_part, apart);
        const double reduced = square[i] * share_of(square[last], square[i] + square[last]);
        const double inertia = own_inertia[i] + own_inertia[last] + reduced * square_apart * square_apart +
                               (square[i] + square[last]) * lag * lag;
        value[i - first] = share_of(entropy, total) * sqrt(inertia);
    }
}

enum { MASS, CENTRE, INERTIA, NUM_INERTIA_FIELDS };

static void store_inertia(const moments_t* moments, double origin, double* field, size_t stride)
{
    field[MASS * stride] = moments->weight;
    field[CENTRE * stride] =
        moments->weight > 0.0 ? (moments->centroid - origin) + moments->centroid_rest : 0.0;
    field[INERTIA * stride] = moments->inertia;
}

static void gather_inertia(const play_set_t* plays, size_t split, size_t begin, size_t end, double* field)
{
    const double origin = plays->radius[split];
    moments_t moments = {0};
    for (size_t i = split; i < end; ++i) {
        moments_add(&moments, plays->radius[i], plays->weight[i]);
        store_inertia(&moments, origin, field + i, plays->num_plays);
    }
    moments = (moments_t){0};
    for (size_t i = split; i-- > begin;) {
        moments_add(&moments, plays->radius[i], plays->weight[i]);
        store_inertia(&moments, origin, field + i, plays->num_plays);
    }
}

const interval_kind_t interval_inertia = {NUM_INERTIA_FIELDS, gather_inertia};

void join_inertia(const interval_joint_t* joint, size_t first, size_t end, double* value)
{
    const double* restrict mass = field_of(joint, MASS);
    const double* restrict centre = field_of(joint, CENTRE);
    const double* restrict inertia = field_of(joint, INERTIA);
    const double last_mass = mass[joint->last];
    const double last_centre = centre[joint->last];
    const double last_inertia = inertia[joint->last];
    // Where either part has no weight the product is 0, whatever the divisor.
    const double least = 0x1p-1022;
    for (size_t i = first; i < end; ++i) {
        const double total = mass[i] + last_mass + least;
        const double apart = last_centre - centre[i];
        value[i - first] = inertia[i] + last_inertia + mass[i] * (last_mass / total) * apart * apart;
    }
}

/// LEVER: sum p |r - r_split|. OUTER: sum p |r - r_i|.
enum { LOAD, LEVER, OUTER, NUM_DISTANCE_FIELDS };

static void gather_distance(const play_set_t* plays, size_t split, size_t begin, size_t end, double* field)
{
    const double* radius = plays->radius;
    const double* weight = plays->weight;
    double* load = field + LOAD * plays->num_plays;
    double* lever = field + LEVER * plays->num_plays;
    double* outer = field + OUTER * plays->num_plays;
    load[split] = weight[split];
    lever[split] = 0.0;
    outer[split] = 0.0;
    for (size_t i = split + 1; i < end; ++i) {
        load[i] = load[i - 1] + weight[i];
        lever[i] = lever[i - 1] + weight[i] * (radius[i] - radius[split]);
        outer[i] = outer[i - 1] + load[i - 1] * (radius[i] - radius[i - 1]);
    }
    load[split - 1] = weight[split - 1];
    lever[split - 1] = weight[split - 1] * (radius[split] - radius[split - 1]);
    outer[split - 1] = 0.0;
    for (size_t i = split - 1; i-- > begin;) {
        load[i] = load[i + 1] + weight[i];
        lever[i] = lever[i + 1] + weight[i] * (radius[split] - radius[i]);
        outer[i] = outer[i + 1] + load[i + 1] * (radius[i + 1] - radius[i]);
    }
}

const interval_kind_t interval_distance = {NUM_DISTANCE_FIELDS, gather_distance};

void join_distance_to_last(const interval_joint_t* joint, size_t first, size_t end, double* value)
{
    const double* restrict load = field_of(joint, LOAD);
    const double* restrict lever = field_of(joint, LEVER);
    const double beyond = joint->plays->radius[joint->last] - joint->plays->radius[joint->split];
    const double own = field_of(joint, OUTER)[joint->last];
    for (size_t i = first; i < end; ++i) {
        value[i - first] = lever[i] + load[i] * beyond + own;
    }
}

void join_distance_to_first(const interval_joint_t* joint, size_t first, size_t end, double* value)
{
    const double* restrict outer = field_of(joint, OUTER);
    const double* restrict radius = joint->plays->radius;
    const double origin = radius[joint->split];
    const double load = field_of(joint, LOAD)[joint->last];
    const double lever = field_of(joint, LEVER)[joint->last];
    for (size_t i = first; i < end; ++i) {
        value[i - first] = outer[i] + lever + load * (origin - radius[i]);
    }
}
