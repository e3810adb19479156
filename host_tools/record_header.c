#include "record_header.h"
#include "model.h"
#include <stdlib.h>
#include <string.h>

static const char* const role_name[NUM_NAMED_ROLES] = {
    [ROLE_TIME] = "time", [ROLE_INPUT] = "input", [ROLE_OUTPUT] = "output"};

/// One ROLE=NAME of --columns.
static outcome_t parse_mapping(char* mapping, column_names_t* names)
{
    char* equals = strchr(mapping, '=');
    if (equals == NULL || equals[1] == '\0') {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "--columns: \"%s\" is no mapping, expected time=NAME, input=NAME or output=NAME",
                             mapping);
    }
    *equals = '\0';
    for (size_t role = 0; role < NUM_NAMED_ROLES; ++role) {
        if (strcmp(mapping, role_name[role]) != 0) {
            continue;
        }
        if (names->given[role]) {
            return message_error(OUTCOME_USAGE, NOWHERE, "--columns: \"%s\" is given twice", mapping);
        }
        names->given[role] = true;
        free(names->name[role]);
        names->name[role] = xstrdup(equals + 1);
        return OUTCOME_OK;
    }
    return message_error(OUTCOME_USAGE, NOWHERE,
                         "--columns: \"%s\" is unknown, expected time, input or output", mapping);
}

static outcome_t check_distinct(const column_names_t* names)
{
    for (size_t i = 0; i < NUM_NAMED_ROLES; ++i) {
        for (size_t j = 0; j < i; ++j) {
            if (names->given[i] && names->given[j] && strcmp(names->name[i], names->name[j]) == 0) {
                return message_error(OUTCOME_USAGE, NOWHERE, "--columns: %s and %s are both \"%s\"",
                                     role_name[j], role_name[i], names->name[i]);
            }
        }
    }
    return OUTCOME_OK;
}

outcome_t column_names_parse(const char* columns, column_names_t* names)
{
    for (size_t role = 0; role < NUM_NAMED_ROLES; ++role) {
        names->name[role] = xstrdup(role_name[role]);
        names->given[role] = false;
    }
    outcome_t outcome = OUTCOME_OK;
    char* const text = columns != NULL ? xstrdup(columns) : NULL;
    char* mapping = text;
    while (outcome == OUTCOME_OK && mapping != NULL) {
        char* comma = strchr(mapping, ',');
        if (comma != NULL) {
            *comma = '\0';
        }
        outcome = parse_mapping(mapping, names);
        mapping = comma != NULL ? comma + 1 : NULL;
    }
    free(text);
    return outcome == OUTCOME_OK ? check_distinct(names) : outcome;
}

void column_names_free(column_names_t* names)
{
    for (size_t role = 0; role < NUM_NAMED_ROLES; ++role) {
        free(names->name[role]);
        names->name[role] = NULL;
    }
}

/// num_fields when there is none of that name.
static size_t find_field(const field_t* fields, size_t num_fields, const char* name)
{
    size_t i = 0;
    while (i < num_fields && strcmp(fields[i].name, name) != 0) {
        i += 1;
    }
    return i;
}

static outcome_t missing_column(location_t header, size_t role, const char* name, const field_t* fields,
                                size_t num_fields)
{
    char list[400] = "";
    for (size_t i = 0; i < num_fields; ++i) {
        const size_t used = strlen(list);
        if (used + strlen(fields[i].name) + 8 > sizeof list) {
            strcpy(list + used, ", ...");
            break;
        }
        strcat(list, i > 0 ? ", " : "");
        strcat(list, fields[i].name);
    }
    message_error(OUTCOME_BAD_INPUT, header, "no column \"%s\", the columns are: %s", name, list);
    message_note(header, "--columns %s=NAME tells which column is the %s", role_name[role], role_name[role]);
    return OUTCOME_BAD_INPUT;
}

static outcome_t check_duplicates(location_t header, const field_t* fields, size_t num_fields)
{
    for (size_t i = 0; i < num_fields; ++i) {
        for (size_t j = 0; j < i && fields[i].name[0] != '\0'; ++j) {
            if (strcmp(fields[i].name, fields[j].name) == 0) {
                return message_error(OUTCOME_BAD_INPUT, header, "two columns are called \"%s\"",
                                     fields[i].name);
            }
        }
    }
    return OUTCOME_OK;
}

/// Columns without a name cannot be asked for, and one called "input" beside the mapped input would be
/// written twice.
static role_t role_of(location_t header, const column_names_t* names, const char* name)
{
    for (size_t role = 0; role < NUM_NAMED_ROLES; ++role) {
        if (strcmp(name, names->name[role]) == 0) {
            return (role_t)role;
        }
    }
    for (size_t role = 0; role < NUM_NAMED_ROLES; ++role) {
        if (strcmp(name, role_name[role]) == 0) {
            message_note(header, "column \"%s\" is left out: --columns names another one", name);
            return ROLE_LEFT_OUT;
        }
    }
    return name[0] == '\0' ? ROLE_LEFT_OUT : ROLE_AUXILIARY;
}

outcome_t record_assign_roles(location_t header, const record_options_t* options, const column_names_t* names,
                              field_t* fields, size_t num_fields)
{
    const bool needed[NUM_NAMED_ROLES] = {
        [ROLE_TIME] = false, [ROLE_INPUT] = options->needs_input, [ROLE_OUTPUT] = options->needs_output};
    const outcome_t outcome = check_duplicates(header, fields, num_fields);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    for (size_t role = 0; role < NUM_NAMED_ROLES; ++role) {
        const bool there = find_field(fields, num_fields, names->name[role]) < num_fields;
        const bool may_lack = role == ROLE_OUTPUT && options->may_lack_output;
        if (!there && (needed[role] || (names->given[role] && !may_lack))) {
            return missing_column(header, role, names->name[role], fields, num_fields);
        }
    }
    for (size_t i = 0; i < num_fields; ++i) {
        fields[i].role = role_of(header, names, fields[i].name);
    }
    return OUTCOME_OK;
}
