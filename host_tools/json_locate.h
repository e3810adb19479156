/// Where in a JSON text a value stands: jansson keeps no positions.
#ifndef HYST_HOST_JSON_LOCATE_H
#define HYST_HOST_JSON_LOCATE_H

#include "message.h"

/// Line and column of the byte at `offset` (at most the text's length).
location_t text_location(const char* file, const char* text, size_t length, size_t offset);

/// The place of text[key][subkey][index], or [index][subkey] where the key's value is an array. subkey NULL
/// and index -1 leave a step out; key NULL is the whole text. What does not exist is placed at what encloses
/// it. text: NUL-terminated, accepted by jansson.
location_t json_locate(const char* file, const char* text, size_t length, const char* key, const char* subkey,
                       long index);

#endif
