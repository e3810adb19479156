/// The interface of one fixed-point type under names that a test of both uses: HYST_Q_BITS, 32 or 16, says
/// which.
#ifndef HYST_TESTS_Q_SCALAR_H
#define HYST_TESTS_Q_SCALAR_H

#include "q_model.h"

#if HYST_Q_BITS == 32
#define SCALAR(name) hyst_q31_##name
#define BITS         QUANTIZED_Q31
#define OWNED(q)     ((q)->quantized)
#define STATE(q)     ((q)->state31)
#define VALUE_MIN    INT32_MIN
#define VALUE_MAX    INT32_MAX
typedef int32_t value_t;
typedef uint32_t word_t;
#else
#define SCALAR(name) hyst_q15_##name
#define BITS         QUANTIZED_Q15
#define OWNED(q)     ((q)->narrowed)
#define STATE(q)     ((q)->state15)
#define VALUE_MIN    INT16_MIN
#define VALUE_MAX    INT16_MAX
typedef int16_t value_t;
typedef uint16_t word_t;
#endif

#endif
