#include "json_locate.h"
#include <string.h>

location_t text_location(const char* file, const char* text, size_t length, size_t offset)
{
    location_t location = {.file = file, .line = 1, .column = 1};
    for (size_t i = 0; i < offset && i < length; ++i) {
        if (text[i] == '\n') {
            location.line += 1;
            location.column = 1;
        } else {
            location.column += 1;
        }
    }
    return location;
}

static size_t skip_blank(const char* text, size_t at)
{
    return at + strspn(text + at, " \t\r\n");
}

/// From a string's opening quote to behind its closing one.
static size_t skip_string(const char* text, size_t at)
{
    for (at += 1; text[at] != '\0' && text[at] != '"'; ++at) {
        if (text[at] == '\\' && text[at + 1] != '\0') {
            at += 1;
        }
    }
    return text[at] == '"' ? at + 1 : at;
}

/// Behind the value that begins at `at`, however deep it nests.
static size_t skip_value(const char* text, size_t at)
{
    size_t depth = 0;
    do {
        if (text[at] == '"') {
            at = skip_string(text, at);
        } else if (text[at] == '{' || text[at] == '[') {
            depth += 1;
            at += 1;
        } else if (text[at] == '}' || text[at] == ']') {
            depth -= depth > 0 ? 1 : 0;
            at += 1;
        } else {
            const size_t plain = strcspn(text + at, "\"{}[],: \t\r\n");
            at += plain > 0 ? plain : 1;
        }
        at = depth > 0 ? skip_blank(text, at) : at;
    } while (depth > 0 && text[at] != '\0');
    return at;
}

/// Behind the comma after the value that begins at `at`; false at the container's end.
static bool next_element(const char* text, size_t* at)
{
    *at = skip_blank(text, skip_value(text, *at));
    if (text[*at] != ',') {
        return false;
    }
    *at = skip_blank(text, *at + 1);
    return true;
}

static bool enter_array(const char* text, size_t* at, long index)
{
    size_t element = skip_blank(text, *at + 1);
    for (long i = 0; i < index; ++i) {
        if (!next_element(text, &element)) {
            return false;
        }
    }
    if (text[element] == ']' || text[element] == '\0') {
        return false;
    }
    *at = element;
    return true;
}

static bool enter_object(const char* text, size_t* at, const char* key)
{
    const size_t key_length = strlen(key);
    size_t member = skip_blank(text, *at + 1);
    while (text[member] == '"') {
        const size_t name_end = skip_string(text, member);
        const bool matches =
            name_end - member == key_length + 2 && memcmp(text + member + 1, key, key_length) == 0;
        member = skip_blank(text, skip_blank(text, name_end) + 1);
        if (matches) {
            *at = member;
            return true;
        }
        if (!next_element(text, &member)) {
            return false;
        }
    }
    return false;
}

location_t json_locate(const char* file, const char* text, size_t length, const char* key, const char* subkey,
                       long index)
{
    size_t at = skip_blank(text, 0);
    bool found = key != NULL && text[at] == '{' && enter_object(text, &at, key);
    while (found) {
        if (text[at] == '{' && subkey != NULL) {
            found = enter_object(text, &at, subkey);
            subkey = NULL;
        } else if (text[at] == '[' && index >= 0) {
            found = enter_array(text, &at, index);
            index = -1;
        } else {
            found = false;
        }
    }
    return text_location(file, text, length, at);
}
