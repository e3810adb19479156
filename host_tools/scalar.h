/// The numbers that firmware computes in, as options name them.
#ifndef HYST_HOST_SCALAR_H
#define HYST_HOST_SCALAR_H

typedef enum { SCALAR_F32, SCALAR_Q31, SCALAR_Q15, NUM_SCALARS } scalar_t;

#define SCALAR_NAMES "f32, q31 or q15"

const char* scalar_name(scalar_t scalar);
/// NUM_SCALARS for a name that is none.
scalar_t scalar_find(const char* name);

#endif
