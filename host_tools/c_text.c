#include "c_text.h"
#include "model.h"
#include <string.h>
#include <strings.h>

/// What is no digit, sign or exponent is the locale's decimal point.
static void c_number(const char* format, double value, const char* suffix, char* text)
{
    char digits[C_NUMBER_SIZE];
    (void)snprintf(digits, sizeof digits, format, value);
    const size_t integer = strspn(digits, "-0123456789");
    const size_t skipped = integer + strcspn(digits + integer, "0123456789e");
    const bool has_fraction = digits[integer] != '\0' && digits[integer] != 'e';
    (void)snprintf(text, C_NUMBER_SIZE, "%.*s.%s%s%s", (int)integer, digits, has_fraction ? "" : "0",
                   digits + (has_fraction ? skipped : integer), suffix);
}

void c_float(float value, char* text)
{
    c_number("%.9g", (double)value, "f", text);
}

void c_double(double value, char* text)
{
    c_number("%.17g", value, "", text);
}

static bool is_plain(unsigned char c)
{
    return c >= 0x20 && c < 0x7F;
}

void c_string(FILE* stream, const char* text)
{
    fputc('"', stream);
    for (; *text != '\0'; ++text) {
        const unsigned char c = (unsigned char)*text;
        if (!is_plain(c)) {
            fprintf(stream, "\\%03o", (unsigned)c);
        } else {
            fputs(c == '"' || c == '\\' || c == '?' ? "\\" : "", stream);
            fputc(c, stream);
        }
    }
    fputc('"', stream);
}

/// The length of a UTF-8 sequence for U+00A0 ... U+03FF (Latin letters, degree sign, Greek), else 0: beyond
/// lie characters that turn the direction of writing.
static size_t letter_length(const unsigned char* c)
{
    const bool leads = (c[0] == 0xC2 && c[1] >= 0xA0) || (c[0] >= 0xC3 && c[0] <= 0xCF);
    return leads && c[1] >= 0x80 && c[1] <= 0xBF ? 2 : 0;
}

void c_comment(FILE* stream, const char* text)
{
    const unsigned char* c = (const unsigned char*)text;
    unsigned char last = ' ';
    while (*c != '\0') {
        const size_t length = letter_length(c);
        if (length > 0) {
            fwrite(c, 1, length, stream);
            last = c[length - 1];
            c += length;
            continue;
        }
        const bool is_border =
            (*c == '/' && last == '*') || (*c == '*' && last == '/') || (*c == '?' && last == '?');
        fputs(is_border ? " " : "", stream);
        // A backslash before the line's end would join the next line to it.
        last = is_plain(*c) && *c != '\\' ? *c : '.';
        fputc(last, stream);
        ++c;
    }
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

bool c_symbol_is_valid(const char* symbol)
{
    if (!is_letter(symbol[0]) || symbol[0] == '_' || strncasecmp(symbol, "hyst", 4) == 0 ||
        strlen(symbol) > 100) {
        return false;
    }
    for (const char* c = symbol; *c != '\0'; ++c) {
        if (!is_letter(*c) && !is_digit(*c)) {
            return false;
        }
    }
    return true;
}

char* c_symbol_from(const char* text)
{
    static const char prefix[] = "model_";
    enum { LONGEST = 60 };
    char* symbol = xcalloc(sizeof prefix + LONGEST, 1);
    size_t length = 0;
    for (; *text != '\0' && length < LONGEST; ++text) {
        const char c = is_letter(*text) || is_digit(*text) ? *text : '_';
        if (c != '_' || length == 0 || symbol[length - 1] != '_') {
            symbol[length++] = c;
        }
    }
    if (!c_symbol_is_valid(symbol)) {
        memmove(symbol + sizeof prefix - 1, symbol, length);
        memcpy(symbol, prefix, sizeof prefix - 1);
    }
    return symbol;
}

char* c_symbol_upper(const char* symbol)
{
    char* upper = xstrdup(symbol);
    for (char* c = upper; *c != '\0'; ++c) {
        *c = *c >= 'a' && *c <= 'z' ? (char)(*c - 'a' + 'A') : *c;
    }
    return upper;
}
