/// The parts of a generated header that do not depend on the firmware's scalar.
#ifndef HYST_HOST_EMIT_TEXT_H
#define HYST_HOST_EMIT_TEXT_H

#include "golden.h"
#include "model.h"
#include <stdio.h>

/// What a header is made from, whatever its scalar.
typedef struct {
    const model_t* model;         ///< where it comes from
    const char* symbol;           ///< c_symbol_is_valid
    double requested_table_error; ///< output units
} emission_t;

typedef struct {
    FILE* stream;
    const emission_t* from;
    const char* symbol;
    const char* macro;      ///< the symbol in capitals
    const char* scalar;     ///< "f32", "q31", "q15"
    const char* value_type; ///< the C type of inputs and outputs
} writer_t;

void put_banner(const writer_t* writer);
void put_opening(const writer_t* writer);
void put_closing(const writer_t* writer);

/// The names of the model and of its units.
void put_names(const writer_t* writer);
void put_count(const writer_t* writer, const char* name, size_t value, const char* comment);
void put_value(const writer_t* writer, const char* name, float value, const char* comment);
/// Rounded up, so that it stays a bound.
void put_bound(const writer_t* writer, const char* name, double bound, const char* comment);
/// What the model file tells about the errors of compression and identification.
void put_known_errors(const writer_t* writer);

void put_float(FILE* stream, float value);
void put_array_comment(const writer_t* writer, const char* what, const char* unit, const char* shape);

enum { GOLDEN_VECTORS = 4 };
/// The golden vectors of either kind of scalar: inputs, outputs, wanted outputs, the inverse's inputs.
typedef struct {
    const char* type;                                        ///< of an element, in C
    const char* form;                                        ///< in words
    const char* suffix;                                      ///< of the fields' names
    const void* vector[GOLDEN_VECTORS];                      ///< [GOLDEN_STEPS] each
    void (*put)(FILE* stream, const void* vector, size_t i); ///< element i
} golden_text_t;
void put_golden(const writer_t* writer, const golden_text_t* golden);

/// An array's name and the macro of its length, both without the symbol.
typedef struct {
    const char* name;
    const char* length;
} array_length_t;
/// Static assertions of these arrays' lengths and of the golden vectors'.
void put_assertions(const writer_t* writer, const array_length_t* arrays, size_t num_arrays);

#endif
