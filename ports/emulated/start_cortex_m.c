#include "start.h"
#include <stdint.h>

/// From the linker script; only its address means something.
extern uint32_t linker_stack_top[];

noreturn void reset_handler(void);
void systick_handler(void);

noreturn void reset_handler(void)
{
#ifdef __ARM_FP
    // Full access to the floating-point unit, coprocessors 10 and 11 (Armv7-M, B3.2.20).
    volatile uint32_t* const cpacr = (volatile uint32_t*)0xE000ED88u;
    *cpacr |= 0xFu << 20;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
#endif
    start_program();
}

/// A program that uses the timer's interrupt brings its own.
__attribute__((weak)) void systick_handler(void)
{
    fault_handler();
}

typedef union {
    uint32_t* stack;
    void (*handler)(void);
} vector_t;

/// Initial stack, reset, the other system exceptions, none of which is expected, and the timer's.
__attribute__((section(".vectors"), used)) static const vector_t vectors[16] = {
    {.stack = linker_stack_top},  {.handler = reset_handler}, {.handler = fault_handler},
    {.handler = fault_handler},   {.handler = fault_handler}, {.handler = fault_handler},
    {.handler = fault_handler},   {.handler = fault_handler}, {.handler = fault_handler},
    {.handler = fault_handler},   {.handler = fault_handler}, {.handler = fault_handler},
    {.handler = fault_handler},   {.handler = fault_handler}, {.handler = fault_handler},
    {.handler = systick_handler},
};
