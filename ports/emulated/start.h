/// What every core's entry leads to.
#ifndef HYST_PORT_START_H
#define HYST_PORT_START_H

#include <stdnoreturn.h>

/// Fills .data and .bss, runs main and ends the emulation with what it returns. Needs a stack.
noreturn void start_program(void);

/// Ends the emulation with exit code 70: an exception that nobody handles.
noreturn void fault_handler(void);

#endif
