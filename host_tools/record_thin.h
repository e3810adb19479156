/// A long record as a short one on which effects run nearly as on the whole: full-rate stretches spread over
/// it, and between them what carries the memory over.
#ifndef HYST_HOST_RECORD_THIN_H
#define HYST_HOST_RECORD_THIN_H

#include "record.h"

/// record: with input and output. What a logger lost of it is put back (record_fill.h). One of at most `most`
/// samples (at least 1000) is else copied as it is. Of a longer one at most so many are kept, with times of
/// 1 s a sample where it has none:
/// - 12 stretches as they are, evenly spread, the first and the last sample among them. The first quarter of
///   each but the first is carried, so that what is fast has settled where the judging begins;
/// - before each of them cells, short ones next to it and longer ones further back, and of each cell the
///   samples of the least and the greatest input. So every turning point that a later move does not wipe out
///   is kept but for those within a cell, and a fading memory sees its recent past more finely.
/// Samples before the record's first_judged are carried, and what is carried in it stays so.
record_t record_thin(const record_t* record, size_t most, size_t first_judged);

#endif
