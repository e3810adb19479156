/// A diagnosis in words.
#ifndef HYST_HOST_DIAGNOSE_TEXT_H
#define HYST_HOST_DIAGNOSE_TEXT_H

#include "diagnose.h"

/// "creep + exogenous:temperature", or "nothing beside noise".
void text_names(const hypothesis_t* hypothesis, char* text, size_t size);
/// The verdict's name or names, "unknown: ..." included.
void text_verdict(const diagnosis_t* diagnosis, char* text, size_t size);
/// The verdict in two sentences.
void text_summary(const diagnosis_t* diagnosis, const char* output_unit, char* text, size_t size);

#endif
