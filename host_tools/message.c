#include "message.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool quiet;
static bool progress_shown;

/// Length of the well-formed, printable UTF-8 sequence at text, 0 when there is none. C1 control characters
/// (U+0080 ... U+009F) count as unprintable: terminals obey them.
static size_t printable_length(const unsigned char* text)
{
    if (text[0] < 0x80) {
        return text[0] >= 0x20 && text[0] != 0x7F ? 1 : 0;
    }
    const size_t length = text[0] >= 0xF0 ? 4 : text[0] >= 0xE0 ? 3 : 2;
    if (text[0] < 0xC2 || text[0] > 0xF4 || (text[0] == 0xC2 && text[1] < 0xA0)) {
        return 0;
    }
    for (size_t i = 1; i < length; ++i) {
        if ((text[i] & 0xC0U) != 0x80) {
            return 0;
        }
    }
    return length;
}

/// What is quoted from a file or an argument must not reach the terminal as a command.
static void print_safely(const char* text)
{
    const unsigned char* byte = (const unsigned char*)text;
    while (*byte != '\0') {
        const size_t length = printable_length(byte);
        if (length == 0) {
            fprintf(stderr, "\\x%02X", *byte);
            byte += 1;
        } else {
            fwrite(byte, 1, length, stderr);
            byte += length;
        }
    }
}

static void print_message(const char* kind, location_t location, const char* format, va_list arguments)
{
    message_progress_done();
    va_list again;
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    const size_t size = length < 0 ? 1 : (size_t)length + 1;
    // Not xmalloc: running out of memory is itself a message.
    char* text = malloc(size);
    if (text == NULL || length < 0 || vsnprintf(text, size, format, arguments) < 0) {
        free(text);
        text = NULL;
    }
    print_safely(location.file != NULL ? location.file : "hyst");
    if (location.file != NULL && location.line > 0) {
        fprintf(stderr, ":%zu", location.line);
        if (location.column > 0) {
            fprintf(stderr, ":%zu", location.column);
        }
    }
    fprintf(stderr, ": %s: ", kind);
    print_safely(text != NULL ? text : format);
    fputc('\n', stderr);
    free(text);
}

outcome_t message_error(outcome_t outcome, location_t location, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_message("error", location, format, arguments);
    va_end(arguments);
    return outcome;
}

void message_warning(location_t location, const char* format, ...)
{
    if (!quiet) {
        va_list arguments;
        va_start(arguments, format);
        print_message("warning", location, format, arguments);
        va_end(arguments);
    }
}

void message_note(location_t location, const char* format, ...)
{
    if (!quiet) {
        va_list arguments;
        va_start(arguments, format);
        print_message("note", location, format, arguments);
        va_end(arguments);
    }
}

void message_set_quiet(bool be_quiet)
{
    quiet = be_quiet;
}

void message_progress(const char* what, double fraction)
{
    if (quiet || !isatty(STDERR_FILENO)) {
        return;
    }
    const double percent = 100.0 * (fraction > 0.0 ? (fraction < 1.0 ? fraction : 1.0) : 0.0);
    enum { BAR_LENGTH = 30 };
    char bar[BAR_LENGTH + 1];
    for (int i = 0; i < BAR_LENGTH; ++i) {
        bar[i] = percent * BAR_LENGTH >= 100.0 * (i + 1) ? '#' : '.';
    }
    bar[BAR_LENGTH] = '\0';
    fprintf(stderr, "\r%s [%s] %3.0f %%", what, bar, percent);
    fflush(stderr);
    progress_shown = true;
}

void message_progress_done(void)
{
    if (progress_shown) {
        fputs("\r\033[K", stderr);
        progress_shown = false;
    }
}
