#include "identify_samples.h"

#include "model.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A visit within this part of half the range of an end counts: only plays whose radius is within it of the
/// largest moving one can tell the difference, and those hardly move.
static const double end_tolerance = 0.02;

/// Of a record, on the scale of the model's input range.
typedef struct {
    const record_t* record;
    double centre, half_range;
} scaled_t;

static void append(samples_t* samples, const scaled_t* scaled, size_t t)
{
    const size_t i = samples->num_samples++;
    // Only a turning point that was put back can lie outside.
    samples->u[i] = fmin(fmax((scaled->record->input[t] - scaled->centre) / scaled->half_range, -1), 1);
    samples->y[i] = scaled->record->output[t];
    samples->measured[i] = !record_is_carried(scaled->record, t);
    samples->used[i] = samples->measured[i];
    samples->index[i] = t;
}

/// Of a block's samples that were measured or, otherwise, put back: the one of least and the one of largest
/// input; both `to` where there is none.
typedef struct {
    size_t least, largest;
} extremes_t;

static extremes_t extremes_of(const record_t* record, size_t from, size_t to, bool carried)
{
    extremes_t found = {to, to};
    for (size_t t = from; t < to; t++) {
        if (record_is_carried(record, t) == carried) {
            found.least =
                found.least == to || record->input[t] < record->input[found.least] ? t : found.least;
            found.largest =
                found.largest == to || record->input[t] >= record->input[found.largest] ? t : found.largest;
        }
    }
    return found;
}

/// Appends the block's measured samples of least and largest input in order of time, and those that were put
/// back as far as they go beyond.
static void append_extremes(samples_t* samples, const scaled_t* scaled, size_t from, size_t to)
{
    const double* input = scaled->record->input;
    const extremes_t measured = extremes_of(scaled->record, from, to, false);
    const extremes_t put_back = extremes_of(scaled->record, from, to, true);
    const bool is_below =
        put_back.least < to && (measured.least == to || input[put_back.least] < input[measured.least]);
    const bool is_above = put_back.largest < to &&
                          (measured.largest == to || input[put_back.largest] > input[measured.largest]);
    for (size_t t = from; t < to; t++) {
        if (t == measured.least || t == measured.largest || (is_below && t == put_back.least) ||
            (is_above && t == put_back.largest)) {
            append(samples, scaled, t);
        }
    }
}

static size_t first_wiped(const samples_t* samples)
{
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (size_t i = 0; i < samples->num_samples; i++) {
        low = fmin(low, samples->u[i]);
        high = fmax(high, samples->u[i]);
    }
    const double near = end_tolerance * 0.5 * (high - low);
    bool was_low = false;
    bool was_high = false;
    for (size_t i = 0; i < samples->num_samples; i++) {
        was_low = was_low || samples->u[i] <= low + near;
        was_high = was_high || samples->u[i] >= high - near;
        if (was_low && was_high) {
            return i;
        }
    }
    return 0;
}

samples_t samples_new(const record_t* record, double centre, double half_range, size_t max_samples)
{
    const scaled_t scaled = {record, centre, half_range};
    const size_t num_samples = record->num_samples;
    const size_t block = num_samples <= max_samples ? 1 : (2 * num_samples + max_samples - 1) / max_samples;
    const size_t most = block == 1 ? num_samples : 4 * (num_samples / block + 1);
    samples_t samples = {0};
    samples.u = xmalloc(most * sizeof *samples.u);
    samples.y = xmalloc(most * sizeof *samples.y);
    samples.measured = xmalloc(most * sizeof *samples.measured);
    samples.used = xmalloc(most * sizeof *samples.used);
    samples.index = xmalloc(most * sizeof *samples.index);
    for (size_t from = 0; from < num_samples; from += block) {
        const size_t to = from + block < num_samples ? from + block : num_samples;
        append_extremes(&samples, &scaled, from, to);
    }
    samples.wiped = first_wiped(&samples);
    return samples;
}

void samples_free(samples_t* samples)
{
    free(samples->u);
    free(samples->y);
    free(samples->measured);
    free(samples->used);
    free(samples->index);
    *samples = (samples_t){0};
}

void samples_use_from(samples_t* samples, size_t first)
{
    for (size_t i = 0; i < samples->num_samples; i++) {
        samples->used[i] = i >= first && samples->measured[i];
    }
}

/// Pools of the isotonic regression, a stack.
typedef struct {
    double sum;
    double count;
} pool_t;

/// Adds a value to the pools of a stretch that rises (sign 1) or falls (sign -1).
static size_t pool_value(pool_t* pool, size_t count, double value, double sign)
{
    pool[count++] = (pool_t){value, 1};
    while (count > 1 && sign * pool[count - 2].sum * pool[count - 1].count >
                            sign * pool[count - 1].sum * pool[count - 2].count) {
        pool[count - 2].sum += pool[count - 1].sum;
        pool[count - 2].count += pool[count - 1].count;
        count--;
    }
    return count;
}

/// Sum over pools of squared distances = sum of squares - sum of pools' squared sums over counts.
static double explained(const pool_t* pool, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += pool[i].sum * pool[i].sum / pool[i].count;
    }
    return sum;
}

double monotone_floor(const record_t* record, size_t first)
{
    pool_t* pool = xmalloc((record->num_samples + 1) * sizeof *pool);
    double sum = 0;
    double count = 0;
    for (size_t t = first; t < record->num_samples; t++) {
        sum += record_is_carried(record, t) ? 0 : record->output[t];
        count += record_is_carried(record, t) ? 0 : 1;
    }
    double left = 0;
    size_t pools = 0;
    double sign = 0;
    for (size_t t = first; t < record->num_samples; t++) {
        const double step = t > first ? record->input[t] - record->input[t - 1] : 0;
        const double direction = step > 0 ? 1 : step < 0 ? -1 : sign;
        if (direction * sign < 0) {
            left -= explained(pool, pools);
            pools = 0;
        }
        sign = direction;
        if (!record_is_carried(record, t)) {
            const double value = record->output[t] - sum / count;
            left += value * value;
            pools = pool_value(pool, pools, value, sign);
        }
    }
    left -= explained(pool, pools);
    free(pool);
    return sqrt(fmax(left, 0) / count);
}
