#include "port.h"
#include "semihosting.h"

/// SysTick (Armv6-M, B3.3): a 24-bit counter down, on the processor's clock.
#define SYSTICK_CONTROL                   (*(volatile uint32_t*)0xE000E010u)
#define SYSTICK_RELOAD                    (*(volatile uint32_t*)0xE000E014u)
#define SYSTICK_CURRENT                   (*(volatile uint32_t*)0xE000E018u)
#define SYSTICK_ENABLE_ON_PROCESSOR_CLOCK 5u
#define SYSTICK_COUNTED_OUT               0x00010000u
#define SYSTICK_MASK                      0x00FFFFFFu

/// With -icount shift=0 QEMU executes one instruction per nanosecond.
#define PICOSECONDS_PER_INSTRUCTION 1000u

void port_print(const char* text)
{
    semihosting_print(text);
}

void port_count_start(void)
{
    SYSTICK_RELOAD = SYSTICK_MASK;
    SYSTICK_CURRENT = 0;
    SYSTICK_CONTROL = SYSTICK_ENABLE_ON_PROCESSOR_CLOCK;
}

uint32_t port_count_instructions(void)
{
    const uint64_t ticks = (0u - SYSTICK_CURRENT) & SYSTICK_MASK;
    if ((SYSTICK_CONTROL & SYSTICK_COUNTED_OUT) != 0) {
        return UINT32_MAX;
    }
    return (uint32_t)(ticks * PICOSECONDS_PER_TICK / PICOSECONDS_PER_INSTRUCTION);
}
