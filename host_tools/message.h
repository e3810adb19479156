/// The one place that formats messages and owns the exit codes.
#ifndef HYST_HOST_MESSAGE_H
#define HYST_HOST_MESSAGE_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

/// CONTRACT exit codes; also what every host function that can fail returns.
typedef enum {
    OUTCOME_OK = 0,
    OUTCOME_NO = 1,        ///< ran, and the answer is no
    OUTCOME_USAGE = 2,     ///< command line
    OUTCOME_BAD_INPUT = 3, ///< bad input data
    OUTCOME_NUMERICAL = 4, ///< numerical failure
    OUTCOME_IO = 5,        ///< input/output
} outcome_t;

/// Where in an input a message points. line and column are 1-based, column in bytes; 0: not known, left out.
typedef struct {
    const char* file;
    size_t line;
    size_t column;
} location_t;

/// `FILE:LINE:COLUMN: error: what, what was expected` on stderr; returns `outcome` so that callers can
/// `return message_error(...)`. Without a file (NULL) it starts with `hyst: error:`.
outcome_t message_error(outcome_t outcome, location_t location, const char* format, ...)
    __attribute__((format(printf, 3, 4)));
/// Likewise `warning:` and `note:`; silenced by message_set_quiet(true). Errors never are.
void message_warning(location_t location, const char* format, ...) __attribute__((format(printf, 2, 3)));
void message_note(location_t location, const char* format, ...) __attribute__((format(printf, 2, 3)));
void message_set_quiet(bool quiet);

/// A progress bar on stderr, only when it is a terminal and not quiet. fraction in [0, 1]; done erases it.
void message_progress(const char* what, double fraction);
void message_progress_done(void);

/// No place in a file.
#define NOWHERE ((location_t){0})

#endif
