#include "semihosting.h"
#include <stdint.h>

enum { SYS_WRITE0 = 0x04, SYS_EXIT_EXTENDED = 0x20, APPLICATION_EXIT = 0x20026 };

static void semihosting_call(const uint32_t operation, const void* argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register const void* r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void semihosting_print(const char* text)
{
    semihosting_call(SYS_WRITE0, text);
}

noreturn void semihosting_exit(const int code)
{
    const uint32_t reason[2] = {APPLICATION_EXIT, (uint32_t)code};
    for (;;) {
        semihosting_call(SYS_EXIT_EXTENDED, reason);
    }
}
