/// How deep a call goes, measured by painting the memory below the stack. Inlined, so that the stack pointer
/// is that of the function that makes the call. A callee's lowest words count only where it wrote them.
#ifndef HYST_COST_STACK_H
#define HYST_COST_STACK_H

#include <stdint.h>

#define STACK_PAINT UINT32_C(0x5AC35AC3)

enum { STACK_PAINTED_WORDS = 1024 };

static inline __attribute__((always_inline)) volatile uint32_t* stack_pointer(void)
{
    volatile uint32_t* pointer;
#ifdef __riscv
    __asm__ volatile("mv %0, sp" : "=r"(pointer));
#else
    __asm__ volatile("mov %0, sp" : "=r"(pointer));
#endif
    return pointer;
}

static inline __attribute__((always_inline)) void stack_paint(void)
{
    volatile uint32_t* const top = stack_pointer();
    for (uint32_t depth = 1; depth <= STACK_PAINTED_WORDS; ++depth) {
        top[-(int32_t)depth] = STACK_PAINT;
    }
}

/// Bytes below the stack pointer that no longer hold the paint.
static inline __attribute__((always_inline)) uint32_t stack_used(void)
{
    volatile uint32_t* const top = stack_pointer();
    uint32_t depth = STACK_PAINTED_WORDS;
    while (depth > 0 && top[-(int32_t)depth] == STACK_PAINT) {
        --depth;
    }
    return depth * (uint32_t)sizeof(uint32_t);
}

#endif
