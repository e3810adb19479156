/// Independent pieces of work on several threads.
#ifndef HYST_HOST_PARALLEL_H
#define HYST_HOST_PARALLEL_H

#include <stddef.h>

/// What message_progress says while a loop runs: from ... to, by pieces done.
typedef struct {
    const char* what;
    double from, to;
} parallel_progress_t;

/// Processors of this machine, at least 1.
size_t parallel_processors(void);
/// Calls piece(context, i) once for each i below count, on at most num_threads threads, this one among them.
/// Pieces that write only what is theirs give the same results whatever the number of threads.
void parallel_for(size_t count, size_t num_threads, void (*piece)(void* context, size_t index), void* context,
                  parallel_progress_t progress);

#endif
