#include "semihosting.h"
#include <stdint.h>

/// Full access to the floating-point unit, coprocessors 10 and 11 (Armv7-M, B3.2.20).
#define CPACR                 (*(volatile uint32_t*)0xE000ED88u)
#define CPACR_FPU_FULL_ACCESS (0xFu << 20)

enum { EXIT_FAULT = 70 };

/// From the linker script; only their addresses mean something.
extern uint32_t linker_stack_top[];
extern const uint32_t linker_data_load[];
extern uint32_t linker_data_start[];
extern uint32_t linker_data_end[];
extern uint32_t linker_bss_start[];
extern uint32_t linker_bss_end[];

int main(void);
noreturn void reset_handler(void);
noreturn void fault_handler(void);

noreturn void reset_handler(void)
{
    CPACR |= CPACR_FPU_FULL_ACCESS;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
    const uint32_t* load = linker_data_load;
    for (uint32_t* p = linker_data_start; p < linker_data_end; ++p) {
        *p = *load++;
    }
    for (uint32_t* p = linker_bss_start; p < linker_bss_end; ++p) {
        *p = 0;
    }
    semihosting_exit(main());
}

noreturn void fault_handler(void)
{
    semihosting_print("fault\n");
    semihosting_exit(EXIT_FAULT);
}

typedef union {
    uint32_t* stack;
    void (*handler)(void);
} vector_t;

/// Initial stack, reset, and the 14 system exceptions, none of which is expected.
__attribute__((section(".vectors"), used)) static const vector_t vectors[16] = {
    {.stack = linker_stack_top}, {.handler = reset_handler}, {.handler = fault_handler},
    {.handler = fault_handler},  {.handler = fault_handler}, {.handler = fault_handler},
    {.handler = fault_handler},  {.handler = fault_handler}, {.handler = fault_handler},
    {.handler = fault_handler},  {.handler = fault_handler}, {.handler = fault_handler},
    {.handler = fault_handler},  {.handler = fault_handler}, {.handler = fault_handler},
    {.handler = fault_handler},
};
