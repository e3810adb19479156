/// What the example needs of a board: a timer, a drive and, to judge by, a position sensor.
#ifndef HYST_EXAMPLE_BOARD_H
#define HYST_EXAMPLE_BOARD_H

#include <stdint.h>

/// Has timer_interrupt called once a period from now on.
void board_start_timer(uint32_t period_us);
/// The program's: the board calls it.
void timer_interrupt(void);
/// Sleeps until an interrupt was served.
void board_wait(void);

/// Between these two calls no interrupt is served.
void board_mask_interrupts(void);
void board_unmask_interrupts(void);

/// Drives the actuator, in the model's input units; reads where it went, in its output units.
void board_drive(float input);
float board_position(void);

#endif
