/// From a record's header row and --columns to what each column is.
#ifndef HYST_HOST_RECORD_HEADER_H
#define HYST_HOST_RECORD_HEADER_H

#include "record.h"

typedef enum { ROLE_TIME, ROLE_INPUT, ROLE_OUTPUT, ROLE_AUXILIARY, ROLE_LEFT_OUT } role_t;
enum { NUM_NAMED_ROLES = 3 };

typedef struct {
    char* name; ///< owned
    role_t role;
    double* value; ///< [num_samples] owned; NULL when left out
} field_t;

/// What the time, input and output columns are called in a record.
typedef struct {
    char* name[NUM_NAMED_ROLES]; ///< owned
    bool given[NUM_NAMED_ROLES]; ///< by --columns, and then a column that must be there
} column_names_t;

/// columns: the argument of --columns, or NULL for the names of the contract. A fault is a usage error.
outcome_t column_names_parse(const char* columns, column_names_t* names);
void column_names_free(column_names_t* names);

/// Gives each of fields[num_fields] its role. header: where the header row stands.
outcome_t record_assign_roles(location_t header, const record_options_t* options, const column_names_t* names,
                              field_t* fields, size_t num_fields);

#endif
