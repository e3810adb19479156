/// In place of the JSON library on a target: as much of it as models need that carry no JSON.
#ifndef HYST_TESTS_TARGET_JANSSON_H
#define HYST_TESTS_TARGET_JANSSON_H

#include <stdlib.h>

typedef struct json_t json_t;

static inline json_t* json_deep_copy(const json_t* json)
{
    return json == NULL ? NULL : (abort(), NULL);
}

static inline void json_decref(const json_t* json)
{
    if (json != NULL) {
        abort();
    }
}

#endif
