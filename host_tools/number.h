/// Decimal numbers of records: strict reading, short and fast writing.
#ifndef HYST_HOST_NUMBER_H
#define HYST_HOST_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

typedef enum {
    NUMBER_OK,
    NUMBER_NOT_FINITE, ///< nan, inf or infinity
    NUMBER_OVERFLOW,   ///< a decimal number beyond the range of double
    NUMBER_NOT_A_NUMBER,
} number_status_t;

/// The whole of text[length] (NUL-terminated there) as a decimal or scientific number: no hexadecimal, no
/// blanks.
number_status_t number_parse(const char* text, size_t length, double* value);

enum { NUMBER_SIZE = 32 };
/// Writes `value` with 15 significant digits, trailing zeros dropped, so that any decimal of up to 15 digits
/// that was read comes out as it went in. Returns the length. text: at least NUMBER_SIZE bytes.
size_t number_format(double value, char* text);

#endif
