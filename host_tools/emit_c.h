/// The generated C header: a model's float form as constants, with its golden vectors and error bounds.
#ifndef HYST_HOST_EMIT_C_H
#define HYST_HOST_EMIT_C_H

#include "golden.h"
#include "tabulate.h"
#include <stdio.h>

typedef struct {
    const model_t* model; ///< where it comes from
    const tabulated_t* tabulated;
    const golden_t* golden;
    const char* symbol;           ///< c_symbol_is_valid
    double requested_table_error; ///< output units
} emission_t;

/// Writes the header to `stream`: the bytes depend on *emission and this program's version alone.
void emit_c(FILE* stream, const emission_t* emission);

#endif
