/// Samples that a logger lost, put back: the plant saw inputs that the record does not show.
#ifndef HYST_HOST_RECORD_FILL_H
#define HYST_HOST_RECORD_FILL_H

#include "record.h"

/// Adds the lost samples of a record with times (sample_steps.h): times, columns and output on a straight
/// line between their neighbours, and the input, too, but where it turned in the gap: there it is where the
/// courses before and behind, each continued as a parabola, lead to. What is added is carried: its output was
/// never measured.
void record_fill(record_t* record);

#endif
