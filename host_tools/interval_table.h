/// Values of runs of neighbouring plays, each from two stored parts.
#ifndef HYST_HOST_INTERVAL_TABLE_H
#define HYST_HOST_INTERVAL_TABLE_H

#include "group_loss.h"

/// Fields of the runs that begin or end at a split: field[f][i] belongs to the plays split ... i, or i ...
/// split - 1 where i < split.
typedef struct {
    size_t num_fields;
    /// Fills the fields of begin ... end - 1, begin < split < end.
    void (*gather)(const play_set_t* plays, size_t split, size_t begin, size_t end, double* field);
} interval_kind_t;

/// Where two parts meet: the plays i ... split - 1 and split ... last.
typedef struct {
    const play_set_t* plays;
    const double* field;
    size_t split, last;
} interval_joint_t;
/// value[i - first] for the runs i ... last, first <= i < end <= split.
typedef void interval_join_t(const interval_joint_t* joint, size_t first, size_t end, double* value);

/// For every power of two the plays are split at its odd multiples; any run crosses exactly one split of the
/// highest power in which its ends differ. Prefix sums would be smaller, but a run's value as the difference
/// of two of them has the rounding of all plays before it: here nothing is subtracted.
typedef struct {
    play_set_t plays;
    interval_kind_t kind;
    size_t num_levels;
    double* field; ///< [num_levels][num_fields][num_plays], owned
} interval_table_t;

/// O(num_plays log num_plays) time and memory. The plays are borrowed.
interval_table_t interval_table_new(const play_set_t* plays, interval_kind_t kind);
void interval_table_free(interval_table_t* table);
/// value[i - first] of the runs i ... last for first <= i < end <= last + 1; one play alone has the value 0.
void interval_table_row(const interval_table_t* table, interval_join_t* join, size_t first, size_t end,
                        size_t last, double* value);

/// A group's entropy loss (group_loss).
extern const interval_kind_t interval_entropy;
interval_join_t join_entropy_loss;
/// sum p (r - centroid)^2.
extern const interval_kind_t interval_inertia;
interval_join_t join_inertia;
/// sum p (r_last - r) and sum p (r - r_first).
extern const interval_kind_t interval_distance;
interval_join_t join_distance_to_last, join_distance_to_first;

#endif
