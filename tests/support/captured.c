#include "captured.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[4096];
static int real_stderr = -1;
static FILE* capture;

static void must(int condition)
{
    if (!condition) {
        perror("test support");
        abort();
    }
}

void folder_new(void)
{
    const char* base = getenv("TMPDIR");
    must(snprintf(folder, sizeof folder, "%s/hyst_test_XXXXXX", base != NULL ? base : P_tmpdir) <
         (int)sizeof folder);
    must(mkdtemp(folder) != NULL);
}

/// Calls `use` for every file of the folder.
static size_t each_file(void (*use)(const char*))
{
    size_t count = 0;
    DIR* directory = opendir(folder);
    must(directory != NULL);
    for (const struct dirent* entry = readdir(directory); entry != NULL; entry = readdir(directory)) {
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
            count += 1;
            if (use != NULL) {
                use(entry->d_name);
            }
        }
    }
    closedir(directory);
    return count;
}

static void remove_file(const char* name)
{
    must(unlink(folder_path(name)) == 0);
}

void folder_remove(void)
{
    each_file(remove_file);
    must(rmdir(folder) == 0);
}

size_t folder_count(void)
{
    return each_file(NULL);
}

const char* folder_path(const char* name)
{
    static char paths[4][400];
    static size_t next;
    char* path = paths[next++ % 4];
    must(snprintf(path, sizeof paths[0], "%s/%s", folder, name) < (int)sizeof paths[0]);
    return path;
}

void folder_write(const char* name, const void* bytes, size_t length)
{
    FILE* stream = fopen(folder_path(name), "wb");
    must(stream != NULL);
    must(fwrite(bytes, 1, length, stream) == length);
    must(fclose(stream) == 0);
}

static const char* read_stream(FILE* stream)
{
    static char text[1 << 16];
    const size_t length = fread(text, 1, sizeof text - 1, stream);
    text[length] = '\0';
    return text;
}

const char* folder_read(const char* name)
{
    FILE* stream = fopen(folder_path(name), "rb");
    if (stream == NULL) {
        return NULL;
    }
    const char* text = read_stream(stream);
    fclose(stream);
    return text;
}

void stderr_capture(void)
{
    fflush(stderr);
    capture = tmpfile();
    must(capture != NULL);
    real_stderr = dup(STDERR_FILENO);
    must(real_stderr >= 0 && dup2(fileno(capture), STDERR_FILENO) >= 0);
}

const char* stderr_captured(void)
{
    fflush(stderr);
    must(dup2(real_stderr, STDERR_FILENO) >= 0);
    close(real_stderr);
    rewind(capture);
    const char* text = read_stream(capture);
    fclose(capture);
    return text;
}
