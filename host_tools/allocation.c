#include "message.h"
#include "model.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static void* checked(void* pointer, size_t size)
{
    if (pointer == NULL) {
        exit((int)message_error(OUTCOME_IO, NOWHERE, "out of memory: %zu bytes were asked for", size));
    }
    return pointer;
}

void* xmalloc(size_t size)
{
    const size_t at_least_one = size > 0 ? size : 1;
    return checked(malloc(at_least_one), size);
}

void* xcalloc(size_t count, size_t size)
{
    const bool empty = count == 0 || size == 0;
    return checked(empty ? calloc(1, 1) : calloc(count, size), count);
}

void* xrealloc(void* pointer, size_t size)
{
    const size_t at_least_one = size > 0 ? size : 1;
    return checked(realloc(pointer, at_least_one), size);
}

char* xstrdup(const char* text)
{
    const size_t size = strlen(text) + 1;
    return memcpy(xmalloc(size), text, size);
}
