#include "interval_table.h"
#include "model.h"
#include <stdlib.h>

/// The position of the highest set bit; x > 0.
static size_t highest_bit(size_t x)
{
    size_t bit = 0;
    for (size_t half = 32; half > 0; half /= 2) {
        const size_t shift = (x >> half) != 0 ? half : 0;
        bit += shift;
        x >>= shift;
    }
    return bit;
}

static void gather_level(const interval_table_t* table, size_t level)
{
    const size_t num_plays = table->plays.num_plays;
    const size_t half = (size_t)1 << level;
    double* field = table->field + level * table->kind.num_fields * num_plays;
    for (size_t split = half; split < num_plays; split += 2 * half) {
        const size_t end = split + half < num_plays ? split + half : num_plays;
        table->kind.gather(&table->plays, split, split - half, end, field);
    }
}

interval_table_t interval_table_new(const play_set_t* plays, interval_kind_t kind)
{
    interval_table_t table = {.plays = *plays, .kind = kind};
    table.num_levels = plays->num_plays > 1 ? highest_bit(plays->num_plays - 1) + 1 : 0;
    // Zeroed: positions that no split covers are never read, but belong to no one else either.
    table.field = xcalloc(table.num_levels * kind.num_fields * plays->num_plays + 1, sizeof(double));
    for (size_t level = 0; level < table.num_levels; ++level) {
        gather_level(&table, level);
    }
    return table;
}

void interval_table_free(interval_table_t* table)
{
    free(table->field);
    *table = (interval_table_t){0};
}

void interval_table_row(const interval_table_t* table, interval_join_t* join, size_t first, size_t end,
                        size_t last, double* value)
{
    const size_t num_plays = table->plays.num_plays;
    interval_joint_t joint = {.plays = &table->plays, .last = last};
    size_t i = first;
    while (i < end && i < last) {
        const size_t level = highest_bit(i ^ last);
        joint.split = (last >> level) << level;
        joint.field = table->field + level * table->kind.num_fields * num_plays;
        const size_t stop = joint.split < end ? joint.split : end;
        join(&joint, i, stop, value + (i - first));
        i = stop;
    }
    if (i < end) {
        value[i - first] = 0.0;
    }
}
