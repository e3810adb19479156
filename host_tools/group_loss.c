#include "group_loss.h"
#include <math.h>

void moments_add(moments_t* moments, double radius, double weight)
{
    if (!(weight > 0.0)) {
        return;
    }
    if (!(moments->weight > 0.0)) {
        *moments = (moments_t){weight, radius, 0.0, 0.0};
        return;
    }
    const double before = moments->weight;
    const double distance = (radius - moments->centroid) - moments->centroid_rest;
    moments->weight = before + weight;
    const double share = weight / moments->weight;
    moments->inertia += before * share * distance * distance;
    // The centroid's sum and what rounding takes from it (Knuth's two-sum).
    const double step = moments->centroid_rest + distance * share;
    const double sum = moments->centroid + step;
    const double kept = sum - moments->centroid;
    moments->centroid_rest = (moments->centroid - (sum - kept)) + (step - kept);
    moments->centroid = sum;
}

double entropy_of_mixing(double weight, double log_weight, double other, double log_other)
{
    const int heavier = weight >= other;
    const double large = heavier ? weight : other;
    const double small = heavier ? other : weight;
    const double log_ratio = heavier ? log_other - log_weight : log_weight - log_other;
    if (!(small > 0.0)) {
        return 0.0;
    }
    // log(1 + ratio) without the loss of 1 + ratio's last digits.
    const double ratio = small / large;
    const double sum = 1.0 + ratio;
    const double log_sum = log(sum) + (ratio - (sum - 1.0)) / sum;
    return (large + small) * log_sum - small * log_ratio;
}

double lag_of_both(lag_part_t part, lag_part_t other, double apart)
{
    const double weight = part.weight + other.weight;
    const double square = part.square + other.square;
    if (!(square > 0.0)) {
        return 0.0;
    }
    const double share = part.square / square;
    const double other_share = other.square / square;
    // The same difference, from the smaller shares.
    const double difference =
        other.weight < part.weight ? other_share - other.weight / weight : part.weight / weight - share;
    return share * part.lag + other_share * other.lag + difference * apart;
}

group_sums_t group_sums_begin(double origin)
{
    return (group_sums_t){.origin = origin};
}

static double logarithm(double weight)
{
    return weight > 0.0 ? log(weight) : 0.0;
}

void group_sums_add(group_sums_t* sums, double radius, double weight)
{
    const double before = sums->plain.weight;
    const double apart = (radius - sums->plain.centroid) - sums->plain.centroid_rest;
    const lag_part_t part = {before, sums->square.weight, sums->lag};
    const lag_part_t play = {weight, weight * weight, 0.0};
    sums->lag = lag_of_both(part, play, apart);
    sums->num_plays += 1;
    sums->distance += radius - sums->origin;
    sums->entropy += entropy_of_mixing(before, logarithm(before), weight, logarithm(weight));
    moments_add(&sums->plain, radius, weight);
    moments_add(&sums->square, radius, weight * weight);
}

double group_centroid(const group_sums_t* sums)
{
    return sums->plain.weight > 0.0 ? sums->plain.centroid
                                    : sums->origin + sums->distance / (double)sums->num_plays;
}

double group_loss(const group_sums_t* sums)
{
    if (!(sums->plain.weight > 0.0)) {
        return 0.0;
    }
    const double inertia = sums->square.inertia + sums->square.weight * sums->lag * sums->lag;
    return sums->entropy / sums->plain.weight * sqrt(inertia);
}

size_t group_median(const play_set_t* plays, size_t first, size_t end)
{
    long double above = 0.0L;
    for (size_t j = first; j < end; ++j) {
        above += (long double)plays->weight[j];
    }
    long double below = 0.0L;
    size_t median = first;
    for (size_t j = first; j < end; ++j) {
        below += (long double)plays->weight[j];
        if (2.0L * below >= above) {
            median = j;
            break;
        }
    }
    return median;
}

double group_distance(const play_set_t* plays, size_t first, size_t end, double centre)
{
    long double sum = 0.0L;
    for (size_t j = first; j < end; ++j) {
        sum += (long double)plays->weight[j] * fabsl((long double)plays->radius[j] - (long double)centre);
    }
    return (double)sum;
}

double group_inertia(const play_set_t* plays, size_t first, size_t end)
{
    moments_t moments = {0};
    for (size_t j = first; j < end; ++j) {
        moments_add(&moments, plays->radius[j], plays->weight[j]);
    }
    return moments.inertia;
}
