/// Records: CSV files of time, input, output and auxiliary columns (CONTRACT, "Record").
#ifndef HYST_HOST_RECORD_H
#define HYST_HOST_RECORD_H

#include "message.h"
#include <stdbool.h>
#include <stddef.h>

typedef struct {
    char* name;
    double* value; ///< [num_samples]
} column_t;

typedef struct {
    char* path; ///< for messages: as given, stdin's is <stdin>
    size_t num_samples;
    double* time;   ///< [s], strictly increasing; NULL when the record has none and no sample rate was given
    double* input;  ///< NULL only when not required
    double* output; ///< NULL only when not required
    size_t num_auxiliary;
    column_t* auxiliary; ///< numeric columns beyond those three, in file order
    bool* carried; ///< [num_samples] true: only there for the memory, not to be judged by; NULL: none is
} record_t;

typedef struct {
    const char* columns; ///< --columns "time=t,input=volts,output=um", or NULL
    double sample_rate;  ///< --sample-rate [Hz], 0: not given
    bool needs_input;    ///< a missing column is an error only when needed
    bool needs_output;
    bool may_lack_output; ///< also where `columns` names one
} record_options_t;

/// Reads a record; "-" is stdin. Errors carry line and column and OUTCOME_BAD_INPUT; *record is then empty.
outcome_t record_read(const char* path, const record_options_t* options, record_t* record);
void record_free(record_t* record);
bool record_is_carried(const record_t* record, size_t sample);
/// The auxiliary column of that name, or NULL.
const column_t* record_find_auxiliary(const record_t* record, const char* name);

/// A column to write; integer: written as 0/1 rather than a real.
typedef struct {
    const char* name;
    const double* value;
    bool integer;
} record_column_t;
/// Writes columns side by side as CSV, numbers as short as they read back the same (%.9g suffices for
/// measured data; %.17g is never needed). Whole or not at all; "-" is stdout.
outcome_t record_write(const char* path, const record_column_t* columns, size_t num_columns,
                       size_t num_samples);

#endif
