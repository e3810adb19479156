/// Files a test makes, and what it prints on stderr.
#ifndef HYST_TESTS_CAPTURED_H
#define HYST_TESTS_CAPTURED_H

#include <stddef.h>

/// A fresh folder for the test's files, and its removal with everything in it.
void folder_new(void);
void folder_remove(void);
/// The path of `name` in the folder; valid until the next call but three.
const char* folder_path(const char* name);
void folder_write(const char* name, const void* bytes, size_t length);
/// The file's text, NUL-terminated, valid until the next call; NULL when it cannot be read.
const char* folder_read(const char* name);
size_t folder_count(void);

/// Between them stderr goes to a file; the second returns what it got, valid until the next call.
void stderr_capture(void);
const char* stderr_captured(void);

#endif
