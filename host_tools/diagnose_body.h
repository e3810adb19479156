/// Which body a plant has, as its calibration shows, and what the calibration leaves open about it.
#ifndef HYST_HOST_DIAGNOSE_BODY_H
#define HYST_HOST_DIAGNOSE_BODY_H

#include "everett.h"
#include "nuisance.h"
#include "record.h"
#include "stand_in.h"

typedef struct {
    double misfit;  ///< RMS of what the body leaves of the calibration, noise included [output]
    double noise;   ///< the calibration's own, white part [output]
    bool stands_in; ///< `stand_in` does for the model's plays
    stand_in_t stand_in;
    double doubt; ///< mean square by which it may be off on the record, in parts of what it differs from the
                  ///< model by
    bool has_everett; ///< `everett` is added to what the model's plays give
    everett_t everett;
    nuisance_t nuisance; ///< on the record
} body_t;

/// An element where that leaves clearly less of the calibration than the model and what a Preisach body would
/// add to it, whatever the record looks like; an element that leaves a little less, or a Duhem body that
/// leaves far less, where it is also no further from the record; else the model's plays and what that body
/// adds. model_misfit: RMS of what the model leaves of the calibration; noise likewise. is_visited: whether
/// the calibration has loops like the record's; without them no tables are learned from it, only elements.
body_t body_find(const model_t* model, start_t start, const record_t* calibration, double model_misfit,
                 double noise, bool is_visited, const record_t* record);
void body_free(body_t* body);

#endif
