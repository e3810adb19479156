#include "print.h"
#include "float_bits.h"
#include "port.h"

void print_unsigned(uint32_t value)
{
    char text[11];
    char* p = &text[10];
    *p = '\0';
    do {
        *--p = (char)('0' + (char)(value % 10));
        value /= 10;
    } while (value != 0);
    port_print(p);
}

void print_hex(const uint32_t value)
{
    char text[11];
    text[0] = '0';
    text[1] = 'x';
    for (uint32_t i = 0; i < 8; ++i) {
        text[2 + i] = "0123456789abcdef"[(value >> (28 - 4 * i)) & 15u];
    }
    text[10] = '\0';
    port_print(text);
}

void print_error(const float value)
{
    print_hex(float_bits(value));
    port_print(", ");
    if (!(value < 4.0f)) {
        port_print("4 units or more");
        return;
    }
    const uint32_t thousandths = (uint32_t)(value * 1e9f);
    const uint32_t rest = thousandths % 1000;
    print_unsigned(thousandths / 1000);
    port_print(rest < 10 ? ".00" : rest < 100 ? ".0" : ".");
    print_unsigned(rest);
    port_print(" micro-units");
}
