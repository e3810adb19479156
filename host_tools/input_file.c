#include "input_file.h"
#include "model.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

const char* input_name(const char* path)
{
    return strcmp(path, "-") == 0 ? "<stdin>" : path;
}

static location_t whole_file(const char* path)
{
    return (location_t){.file = input_name(path)};
}

outcome_t input_open(const char* path, FILE** stream)
{
    *stream = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
    if (*stream == NULL) {
        return message_error(OUTCOME_IO, whole_file(path), "cannot be read: %s", strerror(errno));
    }
    struct stat status;
    if (fstat(fileno(*stream), &status) == 0 && S_ISDIR(status.st_mode)) {
        if (*stream != stdin) {
            fclose(*stream);
        }
        *stream = NULL;
        return message_error(OUTCOME_IO, whole_file(path), "is a directory, expected a file");
    }
    return OUTCOME_OK;
}

outcome_t input_close(const char* path, FILE* stream)
{
    const bool failed = ferror(stream) != 0;
    if (stream != stdin) {
        fclose(stream);
    }
    return failed ? message_error(OUTCOME_IO, whole_file(path), "reading failed") : OUTCOME_OK;
}

outcome_t input_read_all(const char* path, char** text, size_t* length)
{
    *text = NULL;
    *length = 0;
    FILE* stream;
    const outcome_t opened = input_open(path, &stream);
    if (opened != OUTCOME_OK) {
        return opened;
    }
    size_t capacity = 0;
    size_t got;
    do {
        if (capacity - *length < 2) {
            capacity = capacity < 4096 ? 8192 : 2 * capacity;
            *text = xrealloc(*text, capacity);
        }
        got = fread(*text + *length, 1, capacity - *length - 1, stream);
        *length += got;
    } while (got > 0);
    (*text)[*length] = '\0';
    const outcome_t closed = input_close(path, stream);
    if (closed != OUTCOME_OK) {
        free(*text);
        *text = NULL;
    }
    return closed;
}
