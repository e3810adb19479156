/// Pieces of C source text, the same bytes whatever the locale.
#ifndef HYST_HOST_C_TEXT_H
#define HYST_HOST_C_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { C_NUMBER_SIZE = 40 };
/// A float as a C literal that reads back to the same bits: "-0.0f", "1.25e-07f"; a double likewise, without
/// suffix. value finite; text: at least C_NUMBER_SIZE bytes.
void c_float(float value, char* text);
void c_double(double value, char* text);

/// A string literal with its quotes: everything but plain ASCII as octal escapes, question marks escaped so
/// that no trigraph arises.
void c_string(FILE* stream, const char* text);
/// The text inside a block comment: it can neither end the comment nor begin another, and control characters
/// become question marks.
void c_comment(FILE* stream, const char* text);

/// Whether a symbol can be used for generated names: a C identifier that leaves the names of this library
/// alone.
bool c_symbol_is_valid(const char* symbol);
/// A valid symbol made of any text; owned by the caller.
char* c_symbol_from(const char* text);
/// The symbol in capitals; owned by the caller.
char* c_symbol_upper(const char* symbol);

#endif
