/// Semihosting, as far as a test needs it.
#ifndef HYST_PORT_SEMIHOSTING_H
#define HYST_PORT_SEMIHOSTING_H

#include <stdnoreturn.h>

void semihosting_print(const char* text);
noreturn void semihosting_exit(int code);

#endif
