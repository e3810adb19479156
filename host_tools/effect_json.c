#include "effect.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char unknown_name[] = "unknown";

static model_fault_t fault(size_t index, const char* member, const char* format, ...)
    __attribute__((format(printf, 3, 4)));

static model_fault_t fault(size_t index, const char* member, const char* format, ...)
{
    model_fault_t result = {.key = "effects", .subkey = member, .index = (long)index};
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(result.text, sizeof result.text, format, arguments);
    va_end(arguments);
    return result;
}

static const model_fault_t no_fault = {.key = NULL, .subkey = NULL, .index = -1};

static const char* text_of(const json_t* entry, const char* member)
{
    return json_string_value(json_object_get(entry, member));
}

/// The names of a name's mechanisms, for a message.
static void list_mechanisms(const char* name, char* text, size_t size)
{
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0; i < effect_count() && length < size; ++i) {
        const effect_t* effect = effect_at(i);
        if (strcmp(effect->name, name) == 0 && effect->mechanism != NULL) {
            const int written = snprintf(text + length, size - length, "%s\"%s\"", length > 0 ? " or " : "",
                                         effect->mechanism);
            length += written > 0 ? (size_t)written : 0;
        }
    }
}

/// The entry's effect: by name and mechanism; without a mechanism the first of its name.
static model_fault_t find_effect(const json_t* entry, size_t index, const effect_t** found)
{
    const char* name = text_of(entry, "type");
    const json_t* mechanism = json_object_get(entry, "mechanism");
    if (name == NULL || !effect_is_known(name)) {
        return fault(index, "type", "unknown effect \"%s\"", name != NULL ? name : "");
    }
    for (size_t i = 0; i < effect_count(); ++i) {
        const effect_t* effect = effect_at(i);
        if (strcmp(effect->name, name) != 0) {
            continue;
        }
        const char* wanted = json_string_value(mechanism);
        if (mechanism == NULL ||
            (wanted != NULL && effect->mechanism != NULL && strcmp(wanted, effect->mechanism) == 0)) {
            *found = effect;
            return no_fault;
        }
    }
    char mechanisms[120];
    list_mechanisms(name, mechanisms, sizeof mechanisms);
    return fault(index, "mechanism", "unknown mechanism of \"%s\", expected %s", name,
                 mechanisms[0] != '\0' ? mechanisms : "none: it has one alone");
}

static model_fault_t read_parameter(const json_t* entry, size_t index, const effect_t* effect, size_t p,
                                    double* value)
{
    const effect_parameter_t* parameter = &effect->parameter[p];
    const json_t* number = json_object_get(entry, parameter->name);
    *value = 0.0;
    if (number == NULL && parameter->optional) {
        return no_fault;
    }
    if (number == NULL) {
        return fault(index, NULL, "the effect \"%s\" needs \"%s\" [%s]", effect->name, parameter->name,
                     parameter->unit);
    }
    *value = json_number_value(number);
    if (!json_is_number(number) || !isfinite(*value)) {
        return fault(index, parameter->name, "\"%s\" is not a finite number", parameter->name);
    }
    if (*value < parameter->least) {
        return fault(index, parameter->name, "\"%s\" is %.9g, expected at least %.9g", parameter->name,
                     *value, parameter->least);
    }
    if (*value > parameter->most) {
        return fault(index, parameter->name, "\"%s\" is %.9g, expected at most %.9g", parameter->name, *value,
                     parameter->most);
    }
    return no_fault;
}

static model_fault_t read_column(const json_t* entry, size_t index, effect_use_t* use)
{
    const char* column = text_of(entry, "column");
    if (column == NULL || strlen(column) >= sizeof use->column) {
        return fault(
            index, "column",
            "the effect \"%s\" needs a \"column\" that names the record's column (%zu bytes at most)",
            use->effect->name, sizeof use->column - 1);
    }
    (void)snprintf(use->column, sizeof use->column, "%s", column);
    const json_t* reference = json_object_get(entry, "reference");
    if (reference != NULL && !json_is_number(reference)) {
        return fault(index, "reference", "\"reference\" is not a number");
    }
    use->has_reference = reference != NULL;
    use->reference = json_number_value(reference);
    return no_fault;
}

static bool is_parameter(const effect_t* effect, const char* member)
{
    for (size_t p = 0; p < effect->num_parameters; ++p) {
        if (strcmp(effect->parameter[p].name, member) == 0) {
            return true;
        }
    }
    return false;
}

/// A misspelt parameter must not fall back to a default in silence. What a diagnosis writes beside them is
/// let through.
static model_fault_t check_members(json_t* entry, size_t index, const effect_t* effect)
{
    static const char* const others[] = {"type", "mechanism", "transferable", "note"};
    const char* member;
    json_t* value;
    json_object_foreach(entry, member, value)
    {
        bool known = is_parameter(effect, member);
        for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i) {
            known = known || strcmp(others[i], member) == 0;
        }
        known = known ||
                (effect->needs_column && (strcmp(member, "column") == 0 || strcmp(member, "reference") == 0));
        if (!known) {
            return fault(index, member, "unknown member \"%s\" of the effect \"%s\"", member, effect->name);
        }
    }
    return no_fault;
}

static model_fault_t read_use(json_t* entry, size_t index, effect_use_t* use)
{
    *use = (effect_use_t){0};
    model_fault_t found = find_effect(entry, index, &use->effect);
    if (found.key == NULL) {
        found = check_members(entry, index, use->effect);
    }
    use->is_of_one_record = json_is_false(json_object_get(entry, "transferable"));
    for (size_t p = 0; found.key == NULL && p < use->effect->num_parameters; ++p) {
        found = read_parameter(entry, index, use->effect, p, &use->parameter[p]);
    }
    if (found.key == NULL && use->effect->needs_column) {
        found = read_column(entry, index, use);
    }
    if (found.key == NULL && use->effect->fault != NULL) {
        const char* wrong = use->effect->fault(use->parameter);
        found = wrong != NULL ? fault(index, NULL, "%s", wrong) : no_fault;
    }
    return found;
}

static bool is_unknown(const json_t* entry)
{
    const char* name = text_of(entry, "type");
    return name != NULL && strcmp(name, unknown_name) == 0;
}

model_fault_t effect_fault(const json_t* effects)
{
    for (size_t i = 0; i < json_array_size(effects); ++i) {
        json_t* entry = json_array_get(effects, i);
        effect_use_t use;
        const model_fault_t found = is_unknown(entry) ? no_fault : read_use(entry, i, &use);
        if (found.key != NULL) {
            return found;
        }
    }
    return no_fault;
}

outcome_t effect_uses_of_model(const model_t* model, const char* model_path, effect_use_t** uses,
                               size_t* num_uses)
{
    const size_t count = json_array_size(model->effects);
    *num_uses = 0;
    *uses = xcalloc(count, sizeof **uses);
    for (size_t i = 0; i < count; ++i) {
        json_t* entry = json_array_get(model->effects, i);
        const model_fault_t found =
            is_unknown(entry) ? fault(i, "type", "the effect \"unknown\" is a name alone: it cannot be run")
                              : read_use(entry, i, &(*uses)[i]);
        if (found.key != NULL) {
            free(*uses);
            *uses = NULL;
            return message_error(OUTCOME_BAD_INPUT, (location_t){.file = model_path}, "%s", found.text);
        }
    }
    *num_uses = count;
    return OUTCOME_OK;
}

void effect_use_normalise(effect_use_t* use)
{
    if (use->effect->normalise != NULL) {
        use->effect->normalise(use->parameter);
    }
}

json_t* effect_use_to_json(const effect_use_t* use)
{
    json_t* entry = json_pack("{s:s}", "type", use->effect->name);
    if (use->effect->mechanism != NULL) {
        json_object_set_new(entry, "mechanism", json_string(use->effect->mechanism));
    }
    if (use->effect->needs_column) {
        json_object_set_new(entry, "column", json_string(use->column));
    }
    if (use->has_reference) {
        json_object_set_new(entry, "reference", json_real(use->reference));
    }
    for (size_t p = 0; p < use->effect->num_parameters; ++p) {
        json_object_set_new(entry, use->effect->parameter[p].name, json_real(use->parameter[p]));
    }
    if (use->is_of_one_record || !use->effect->transferable) {
        json_object_set_new(entry, "transferable", json_false());
    }
    return entry;
}
