#include "semihosting.h"
#include <stdint.h>

enum { SYS_WRITE0 = 0x04, SYS_EXIT_EXTENDED = 0x20, APPLICATION_EXIT = 0x20026 };

#ifdef __riscv
/// RISC-V Semihosting 1.0: three instructions of 32 bits each that mean it only together.
#define TRAP                                                                                                 \
    ".option push\n\t.option norvc\n\t.balign 16\n\tslli x0, x0, 0x1f\n\tebreak\n\tsrai x0, x0, 7\n\t"       \
    ".option pop"
#define OPERATION "a0"
#define ARGUMENT  "a1"
#else
/// Semihosting for AArch32 and AArch64, M profile.
#define TRAP      "bkpt 0xab"
#define OPERATION "r0"
#define ARGUMENT  "r1"
#endif

static void semihosting_call(const uint32_t operation, const void* argument)
{
    register uint32_t first __asm__(OPERATION) = operation;
    register const void* second __asm__(ARGUMENT) = argument;
    __asm__ volatile(TRAP : "+r"(first) : "r"(second) : "memory");
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
