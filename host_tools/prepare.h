/// A model rewritten, still in double precision, into the form whose numbers float holds best.
#ifndef HYST_HOST_PREPARE_H
#define HYST_HOST_PREPARE_H

#include "model.h"

typedef struct {
    model_t
        model; ///< the same outputs as the original's once `constant` is added; no names, effects, initial
    double constant; ///< output units
    bool classical;  ///< both envelopes are the identity and D(v) = slope v
} prepared_t;

/// Linear envelopes of equal slope s and shifts a, b with a linear D become the identity: the play
/// w = s w' + (a + b) / 2 has radius (r - (a - b) / 2) / s and weight s p. Any other envelopes are lowered to
/// lie about 0, and D to be 0 in the middle of the range; the constant makes up for it.
prepared_t prepare(const model_t* model);
void prepared_free(prepared_t* prepared);

#endif
