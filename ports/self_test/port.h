/// What the self-test firmware needs of the machine it runs on.
#ifndef HYST_PORT_H
#define HYST_PORT_H

#include <stdint.h>

void port_print(const char* text);

/// Starts counting executed instructions.
void port_count_start(void);
/// Instructions since port_count_start, to within one tick of the counter; 0 where they cannot be counted,
/// UINT32_MAX when there were more than the counter holds (500 million on a Cortex-M).
uint32_t port_count_instructions(void);

#endif
