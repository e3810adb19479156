/// Numbers as text, without a C library.
#ifndef HYST_PORT_PRINT_H
#define HYST_PORT_PRINT_H

#include <stdint.h>

void print_unsigned(uint32_t value);
/// 0x and 8 digits.
void print_hex(uint32_t value);
/// A float >= 0 as its bits and in millionths, cut off: "0x35800000, 0.953 micro-units".
void print_error(float value);

#endif
