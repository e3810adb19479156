#include "number.h"
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

/// 10^0 ... 10^22 are exact in double.
static const double exact_power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                     1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/// digits [. digits] [e [sign] digits] behind an optional sign, with a digit before or behind the point.
static bool is_decimal(const char* text, size_t length)
{
    const char* const end = text + length;
    text += text < end && (*text == '-' || *text == '+') ? 1 : 0;
    size_t num_digits = 0;
    for (; text < end && is_digit(*text); ++text) {
        num_digits += 1;
    }
    if (text < end && *text == '.') {
        for (text += 1; text < end && is_digit(*text); ++text) {
            num_digits += 1;
        }
    }
    if (num_digits > 0 && text < end && (*text == 'e' || *text == 'E')) {
        text += 1;
        text += text < end && (*text == '-' || *text == '+') ? 1 : 0;
        for (num_digits = 0; text < end && is_digit(*text); ++text) {
            num_digits += 1;
        }
    }
    return num_digits > 0 && text == end;
}

static number_status_t not_decimal(const char* text, size_t length)
{
    const size_t sign = length > 0 && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    const char* const name = text + sign;
    const size_t rest = length - sign;
    const bool not_finite =
        (rest == 3 && (strncasecmp(name, "nan", 3) == 0 || strncasecmp(name, "inf", 3) == 0)) ||
        (rest == 8 && strncasecmp(name, "infinity", 8) == 0);
    return not_finite ? NUMBER_NOT_FINITE : NUMBER_NOT_A_NUMBER;
}

/// Plain decimals of up to 15 digits, most of any record: both operands are exact, so that the one division
/// rounds correctly (Clinger 1990).
static bool parse_short(const char* text, size_t length, double* value)
{
    if (length == 0 || length > 16) {
        return false;
    }
    const bool negative = text[0] == '-';
    int64_t mantissa = 0;
    size_t num_digits = 0;
    size_t num_decimals = 0;
    bool point = false;
    for (size_t i = negative ? 1 : 0; i < length; ++i) {
        if (text[i] == '.' && !point) {
            point = true;
        } else if (is_digit(text[i])) {
            mantissa = 10 * mantissa + (text[i] - '0');
            num_digits += 1;
            num_decimals += point ? 1 : 0;
        } else {
            return false;
        }
    }
    const double magnitude = (double)mantissa / exact_power[num_decimals];
    *value = negative ? -magnitude : magnitude;
    return num_digits > 0 && num_digits <= 15;
}

number_status_t number_parse(const char* text, size_t length, double* value)
{
    if (parse_short(text, length, value)) {
        return NUMBER_OK;
    }
    if (!is_decimal(text, length)) {
        return not_decimal(text, length);
    }
    *value = strtod(text, NULL);
    return isfinite(*value) ? NUMBER_OK : NUMBER_OVERFLOW;
}

/// The decimal digits of `number` and a point before the last num_decimals of them, trailing zeros dropped.
static size_t write_digits(uint64_t number, int num_decimals, bool negative, char* text)
{
    while (num_decimals > 0 && number % 10 == 0) {
        number /= 10;
        num_decimals -= 1;
    }
    char reversed[NUMBER_SIZE];
    size_t count = 0;
    for (int place = 0; number > 0 || place <= num_decimals; ++place) {
        if (place > 0 && place == num_decimals) {
            reversed[count++] = '.';
        }
        reversed[count++] = (char)('0' + number % 10);
        number /= 10;
    }
    size_t length = 0;
    if (negative) {
        text[length++] = '-';
    }
    while (count > 0) {
        text[length++] = reversed[--count];
    }
    text[length] = '\0';
    return length;
}

size_t number_format(double value, char* text)
{
    const double magnitude = fabs(value);
    if (fpclassify(value) == FP_ZERO) {
        return write_digits(0, 0, false, text);
    }
    if (!(magnitude >= 1e-4 && magnitude < 1e15)) {
        return (size_t)snprintf(text, NUMBER_SIZE, "%.15g", value);
    }
    // Digits before the point; for numbers below 1 minus the zeros behind it.
    int num_whole = 15;
    while (num_whole > -3 &&
           magnitude < (num_whole > 0 ? exact_power[num_whole - 1] : 0.1 / exact_power[-num_whole])) {
        num_whole -= 1;
    }
    const int num_decimals = 15 - num_whole;
    // Below 10^15, in 64 bits of mantissa: a decimal of 15 digits comes out within 1/8 of its integer.
    const long double scaled = (long double)magnitude * (long double)exact_power[num_decimals];
    return write_digits((uint64_t)(scaled + 0.5L), num_decimals, value < 0.0, text);
}
