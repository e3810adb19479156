#include "board.h"

/// SysTick (Armv7-M, B3.3): a 24-bit counter down.
#define SYSTICK_CONTROL (*(volatile uint32_t*)0xE000E010u)
#define SYSTICK_RELOAD  (*(volatile uint32_t*)0xE000E014u)
#define SYSTICK_CURRENT (*(volatile uint32_t*)0xE000E018u)
/// Counts, with an interrupt at 0, on the processor's clock.
#define SYSTICK_RUN 7u

void systick_handler(void);

void systick_handler(void)
{
    timer_interrupt();
}

void board_start_timer(const uint32_t period_us)
{
    SYSTICK_RELOAD = period_us * TICKS_PER_MICROSECOND - 1u;
    SYSTICK_CURRENT = 0;
    SYSTICK_CONTROL = SYSTICK_RUN;
}

void board_wait(void)
{
    __asm__ volatile("wfi" ::: "memory");
}

void board_mask_interrupts(void)
{
    __asm__ volatile("cpsid i" ::: "memory");
}

void board_unmask_interrupts(void)
{
    __asm__ volatile("cpsie i" ::: "memory");
}
