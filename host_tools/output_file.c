#include "output_file.h"
#include "model.h"
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/// The temporary files of an interrupted run are removed from a signal handler, which may look at nothing but
/// plain memory.
enum { MAX_PENDING = 8 };
static char* volatile pending[MAX_PENDING];

static void remove_pending(void)
{
    for (size_t i = 0; i < MAX_PENDING; ++i) {
        if (pending[i] != NULL) {
            unlink(pending[i]);
        }
    }
}

static void remove_pending_and_die(int signal_number)
{
    remove_pending();
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

/// A signal that the caller chose to ignore (nohup) stays ignored.
static void catch_signal(int signal_number)
{
    if (signal(signal_number, remove_pending_and_die) == SIG_IGN) {
        signal(signal_number, SIG_IGN);
    }
}

static void set_pending(const char* old, char* new)
{
    static bool installed = false;
    if (!installed) {
        installed = true;
        atexit(remove_pending);
        catch_signal(SIGINT);
        catch_signal(SIGTERM);
        catch_signal(SIGHUP);
    }
    for (size_t i = 0; i < MAX_PENDING; ++i) {
        if (pending[i] == old) {
            pending[i] = new;
            return;
        }
    }
}

static const char* output_name(const output_file_t* file)
{
    return file->path != NULL ? file->path : "<stdout>";
}

static outcome_t cannot_write(const char* path, int error)
{
    return message_error(OUTCOME_IO, (location_t){.file = path}, "cannot be written: %s",
                         error != 0 ? strerror(error) : "writing failed");
}

bool output_is_stdout(const char* path)
{
    if (path == NULL || strcmp(path, "-") == 0) {
        return true;
    }
    struct stat named;
    struct stat own;
    return stat(path, &named) == 0 && fstat(STDOUT_FILENO, &own) == 0 && own.st_dev == named.st_dev &&
           own.st_ino == named.st_ino;
}

static outcome_t open_temporary(output_file_t* file)
{
    const size_t length = strlen(file->path);
    static const char suffix[] = ".XXXXXX";
    file->temporary_path = xmalloc(length + sizeof suffix);
    memcpy(file->temporary_path, file->path, length);
    memcpy(file->temporary_path + length, suffix, sizeof suffix);
    const int descriptor = mkstemp(file->temporary_path);
    if (descriptor < 0) {
        const int error = errno;
        free(file->temporary_path);
        file->temporary_path = NULL;
        return cannot_write(file->path, error);
    }
    set_pending(NULL, file->temporary_path);
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor, 0666 & ~mask);
    file->stream = fdopen(descriptor, "wb");
    return file->stream != NULL ? OUTCOME_OK : cannot_write(file->path, errno);
}

/// A device, a pipe or the like cannot be replaced, only written to.
static outcome_t open_directly(output_file_t* file)
{
    file->stream = fopen(file->path, "wb");
    return file->stream != NULL ? OUTCOME_OK : cannot_write(file->path, errno);
}

outcome_t output_open(output_file_t* file, const char* path)
{
    *file = (output_file_t){.stream = stdout};
    if (output_is_stdout(path)) {
        return OUTCOME_OK;
    }
    struct stat status;
    const bool exists = stat(path, &status) == 0;
    file->stream = NULL;
    // The file behind a symbolic link is replaced, not the link.
    char* target = exists ? realpath(path, NULL) : NULL;
    file->path = target != NULL ? target : xstrdup(path);
    outcome_t outcome;
    if (exists && S_ISDIR(status.st_mode)) {
        outcome = cannot_write(path, EISDIR);
    } else if (exists && access(path, W_OK) != 0) {
        outcome = cannot_write(path, errno);
    } else {
        outcome = exists && !S_ISREG(status.st_mode) ? open_directly(file) : open_temporary(file);
    }
    if (outcome != OUTCOME_OK) {
        output_abandon(file);
    }
    return outcome;
}

outcome_t output_commit(output_file_t* file)
{
    errno = 0;
    bool failed = ferror(file->stream) != 0;
    failed = fflush(file->stream) != 0 || failed;
    int error = errno;
    if (file->path != NULL) {
        failed = fclose(file->stream) != 0 || failed;
        error = error != 0 ? error : errno;
        file->stream = NULL;
    }
    if (!failed && file->temporary_path != NULL && rename(file->temporary_path, file->path) != 0) {
        failed = true;
        error = errno;
    }
    if (failed) {
        cannot_write(output_name(file), error);
    } else if (file->temporary_path != NULL) {
        set_pending(file->temporary_path, NULL);
        free(file->temporary_path);
        file->temporary_path = NULL;
    }
    output_abandon(file);
    return failed ? OUTCOME_IO : OUTCOME_OK;
}

void output_abandon(output_file_t* file)
{
    if (file->stream != NULL && file->path != NULL) {
        fclose(file->stream);
    }
    if (file->temporary_path != NULL) {
        unlink(file->temporary_path);
        set_pending(file->temporary_path, NULL);
    }
    free(file->temporary_path);
    free(file->path);
    *file = (output_file_t){0};
}
