/// The generated C header: a model as constants, with its golden vectors and error bounds. The bytes depend
/// on the arguments and this program's version alone.
#ifndef HYST_HOST_EMIT_C_H
#define HYST_HOST_EMIT_C_H

#include "emit_text.h"
#include "golden.h"
#include "golden_q.h"
#include "quantize.h"
#include "tabulate.h"

void emit_f32(FILE* stream, const emission_t* emission, const tabulated_t* tabulated, const golden_t* golden);
/// In q31 or q15, as it was quantized to.
void emit_q(FILE* stream, const emission_t* emission, const quantized_t* quantized, const golden_q_t* golden);

#endif
