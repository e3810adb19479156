#include "start.h"

/// Machine mode at reset: a stack, and one handler for every trap, none of which is expected. The trap
/// vector's two lowest bits are its mode, so the handler is aligned.
__asm__(".section .vectors, \"ax\"\n"
        ".globl reset_handler\n"
        "reset_handler:\n"
        "    la sp, linker_stack_top\n"
        "    la t0, trap_entry\n"
        "    .option arch, +zicsr\n"
        "    csrw mtvec, t0\n"
        "    j start_program\n"
        ".balign 4\n"
        "trap_entry:\n"
        "    la sp, linker_stack_top\n"
        "    j fault_handler\n"
        ".text\n");
