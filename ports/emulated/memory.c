/// The compiler may call these in any program, also a freestanding one: struct assignments become memcpy.
#include <stddef.h>

void* memcpy(void* restrict to, const void* restrict from, size_t count);
void* memset(void* to, int value, size_t count);

void* memcpy(void* restrict to, const void* restrict from, const size_t count)
{
    unsigned char* const bytes = to;
    const unsigned char* const source = from;
    for (size_t i = 0; i < count; ++i) {
        bytes[i] = source[i];
    }
    return to;
}

void* memset(void* to, const int value, const size_t count)
{
    unsigned char* const bytes = to;
    for (size_t i = 0; i < count; ++i) {
        bytes[i] = (unsigned char)value;
    }
    return to;
}
