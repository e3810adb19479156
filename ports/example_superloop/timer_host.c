#include "board.h"

void board_start_timer(const uint32_t period_us)
{
    (void)period_us;
}

/// Without interrupts time passes where the program waits for it.
void board_wait(void)
{
    timer_interrupt();
}

void board_mask_interrupts(void)
{
}

void board_unmask_interrupts(void)
{
}
