/// Output that appears whole or not at all: a temporary file beside the target, renamed when complete.
#ifndef HYST_HOST_OUTPUT_FILE_H
#define HYST_HOST_OUTPUT_FILE_H

#include "message.h"
#include <stdio.h>

typedef struct {
    FILE* stream;         ///< write here
    char* path;           ///< the target; NULL for stdout
    char* temporary_path; ///< NULL for stdout
} output_file_t;

/// Whether path means stdout: "-", NULL, or another name for the same file or device (/dev/stdout).
bool output_is_stdout(const char* path);
/// path "-" or NULL: stdout. Reports and returns OUTCOME_IO when it cannot be opened.
outcome_t output_open(output_file_t* file, const char* path);
/// Flushes, checks for errors, renames over the target (keeping the mode a new file would get).
/// Reports and returns OUTCOME_IO on failure, with the temporary file removed and the old target untouched.
outcome_t output_commit(output_file_t* file);
/// Removes the temporary file; the old target stays.
void output_abandon(output_file_t* file);

#endif
