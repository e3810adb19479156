#include "start.h"
#include "semihosting.h"
#include <stdint.h>

enum { EXIT_FAULT = 70 };

/// From the linker script; only their addresses mean something.
extern const uint32_t linker_data_load[];
extern uint32_t linker_data_start[];
extern uint32_t linker_data_end[];
extern uint32_t linker_bss_start[];
extern uint32_t linker_bss_end[];

int main(void);

noreturn void start_program(void)
{
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
