#include "port.h"
#include "semihosting.h"

static uint32_t count_at_start;

static uint32_t instructions_retired(void)
{
    uint32_t count;
    __asm__ volatile(".option arch, +zicsr\n\tcsrr %0, minstret" : "=r"(count));
    return count;
}

void port_print(const char* text)
{
    semihosting_print(text);
}

void port_count_start(void)
{
    count_at_start = instructions_retired();
}

uint32_t port_count_instructions(void)
{
    return instructions_retired() - count_at_start;
}
