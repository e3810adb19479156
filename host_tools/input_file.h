/// Opening what the user named for reading, with the messages that go with it.
#ifndef HYST_HOST_INPUT_FILE_H
#define HYST_HOST_INPUT_FILE_H

#include "message.h"
#include <stdio.h>

/// What messages call the file: "-" is <stdin>.
const char* input_name(const char* path);
/// "-" is stdin. Reports and returns OUTCOME_IO when it cannot be opened or is a directory.
outcome_t input_open(const char* path, FILE** stream);
/// Reports what ferror found; closes unless it is stdin.
outcome_t input_close(const char* path, FILE* stream);
/// The whole file in *text [*length bytes, and a NUL after them], owned by the caller.
outcome_t input_read_all(const char* path, char** text, size_t* length);

#endif
