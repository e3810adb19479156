#include "parallel.h"

#include "message.h"
#include "model.h"
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct {
    pthread_mutex_t lock; ///< of what is below, and of the messages
    size_t next, done;
    size_t count;
    void (*piece)(void* context, size_t index);
    void* context;
    parallel_progress_t progress;
} loop_t;

size_t parallel_processors(void)
{
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count > 1 ? (size_t)count : 1;
}

/// Takes the next piece's index; reports the piece that was done before it.
static bool take(loop_t* loop, bool has_done, size_t* index)
{
    pthread_mutex_lock(&loop->lock);
    if (has_done) {
        const double part = (double)++loop->done / (double)loop->count;
        message_progress(loop->progress.what,
                         loop->progress.from + part * (loop->progress.to - loop->progress.from));
    }
    *index = loop->next;
    const bool is_left = loop->next < loop->count;
    loop->next += is_left;
    pthread_mutex_unlock(&loop->lock);
    return is_left;
}

static void* work(void* argument)
{
    loop_t* loop = argument;
    size_t index;
    for (bool more = take(loop, false, &index); more; more = take(loop, true, &index)) {
        loop->piece(loop->context, index);
    }
    return NULL;
}

void parallel_for(size_t count, size_t num_threads, void (*piece)(void* context, size_t index), void* context,
                  parallel_progress_t progress)
{
    loop_t loop = {.count = count, .piece = piece, .context = context, .progress = progress};
    pthread_mutex_init(&loop.lock, NULL);
    const size_t wanted = num_threads < count ? num_threads : count;
    pthread_t* thread = xcalloc(wanted + 1, sizeof *thread);
    size_t started = 0;
    // Where no further thread can be had, those that run do all the work.
    while (started + 1 < wanted && pthread_create(&thread[started], NULL, work, &loop) == 0) {
        started++;
    }
    (void)work(&loop);
    for (size_t i = 0; i < started; i++) {
        pthread_join(thread[i], NULL);
    }
    free(thread);
    pthread_mutex_destroy(&loop.lock);
}
