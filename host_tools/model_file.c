#include "model_file.h"
#include "effect.h"
#include "input_file.h"
#include "json_locate.h"
#include <stdlib.h>
#include <string.h>

#define MODEL_FORMAT_NAME "hyst-model"
enum { MODEL_VERSION = 1 };

/// The text beside what jansson made of it.
typedef struct {
    const char* file;
    char* text;
    size_t length;
    json_t* root;
} source_t;

static location_t place(const source_t* source, const char* key, const char* subkey, long index)
{
    return json_locate(source->file, source->text, source->length, key, subkey, index);
}

static outcome_t missing(const source_t* source, const char* key, const char* subkey)
{
    return message_error(OUTCOME_BAD_INPUT, place(source, key, subkey, -1), "\"%s\" is missing%s%s",
                         subkey != NULL ? subkey : key, subkey != NULL ? " in " : "",
                         subkey != NULL ? key : "");
}

static outcome_t wrong_type(const source_t* source, const char* key, const char* subkey, long index,
                            const char* expected)
{
    return message_error(OUTCOME_BAD_INPUT, place(source, key, subkey, index), "\"%s\" is not %s",
                         subkey != NULL ? subkey : key, expected);
}

static outcome_t read_number(const source_t* source, const char* key, const char* subkey, bool required,
                             double* number)
{
    const json_t* value = json_object_get(json_object_get(source->root, key), subkey);
    if (value == NULL) {
        return required ? missing(source, key, subkey) : OUTCOME_OK;
    }
    if (!json_is_number(value)) {
        return wrong_type(source, key, subkey, -1, "a number");
    }
    *number = json_number_value(value);
    return OUTCOME_OK;
}

/// An optional string; *text keeps its default when there is none.
static outcome_t read_string(const source_t* source, const char* key, const char* subkey, char** text)
{
    const json_t* value = json_object_get(source->root, key);
    value = subkey != NULL ? json_object_get(value, subkey) : value;
    if (value == NULL) {
        return OUTCOME_OK;
    }
    if (!json_is_string(value)) {
        return wrong_type(source, key, subkey, -1, "a string");
    }
    free(*text);
    *text = xstrdup(json_string_value(value));
    return OUTCOME_OK;
}

/// An array of numbers; *numbers stays NULL when it is not there and not required.
static outcome_t read_numbers(const source_t* source, const char* key, const char* subkey, bool required,
                              double** numbers, size_t* count)
{
    const json_t* array = json_object_get(source->root, key);
    array = subkey != NULL ? json_object_get(array, subkey) : array;
    if (array == NULL) {
        return required ? missing(source, key, subkey) : OUTCOME_OK;
    }
    if (!json_is_array(array)) {
        return wrong_type(source, key, subkey, -1, "an array of numbers");
    }
    *count = json_array_size(array);
    *numbers = xcalloc(*count, sizeof(double));
    for (size_t i = 0; i < *count; ++i) {
        const json_t* value = json_array_get(array, i);
        if (!json_is_number(value)) {
            return message_error(OUTCOME_BAD_INPUT, place(source, key, subkey, (long)i),
                                 "an element of \"%s\" is not a number", subkey != NULL ? subkey : key);
        }
        (*numbers)[i] = json_number_value(value);
    }
    return OUTCOME_OK;
}

static outcome_t wrong_count(const source_t* source, const char* key, const char* subkey, size_t count,
                             const char* other, size_t expected)
{
    return message_error(OUTCOME_BAD_INPUT, place(source, key, subkey, -1),
                         "\"%s\" has %zu elements, expected %zu, as many as \"%s\"",
                         subkey != NULL ? subkey : key, count, expected, other);
}

static outcome_t read_table(const source_t* source, const char* key, curve_t* curve)
{
    size_t num_y = 0;
    outcome_t outcome = read_numbers(source, key, "x", true, &curve->x, &curve->num_knots);
    if (outcome == OUTCOME_OK) {
        outcome = read_numbers(source, key, "y", true, &curve->y, &num_y);
    }
    if (outcome == OUTCOME_OK && num_y != curve->num_knots) {
        outcome = wrong_count(source, key, "y", num_y, "x", curve->num_knots);
    }
    return outcome;
}

static outcome_t read_formula(const source_t* source, const char* key, curve_t* curve)
{
    outcome_t outcome = read_number(source, key, "slope", true, &curve->slope);
    if (outcome == OUTCOME_OK) {
        outcome = read_number(source, key, "shift", true, &curve->shift);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_number(source, key, "gain", false, &curve->gain);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_number(source, key, "offset", false, &curve->offset);
    }
    return outcome;
}

/// A misspelt parameter must not fall back to a default in silence.
static outcome_t check_members(const source_t* source, const char* key, json_t* object, bool table)
{
    static const char* const table_members[] = {"type", "x", "y", NULL};
    static const char* const formula_members[] = {"type", "slope", "shift", "gain", "offset", NULL};
    const char* name;
    json_t* value;
    json_object_foreach(object, name, value)
    {
        const char* const* allowed = table ? table_members : formula_members;
        while (*allowed != NULL && strcmp(*allowed, name) != 0) {
            allowed += 1;
        }
        if (*allowed == NULL) {
            return message_error(OUTCOME_BAD_INPUT, place(source, key, name, -1),
                                 "unknown member \"%s\" of a curve, expected %s", name,
                                 table ? "type, x, y" : "type, slope, shift, gain, offset");
        }
    }
    return OUTCOME_OK;
}

static outcome_t read_curve(const source_t* source, const char* key, curve_t* curve)
{
    json_t* object = json_object_get(source->root, key);
    if (object == NULL) {
        return missing(source, key, NULL);
    }
    if (!json_is_object(object)) {
        return wrong_type(source, key, NULL, -1, "an object that describes a curve");
    }
    const json_t* type = json_object_get(object, "type");
    if (type == NULL) {
        return missing(source, key, "type");
    }
    const char* name = json_is_string(type) ? json_string_value(type) : "";
    *curve = (curve_t){.gain = 1.0};
    if (strcmp(name, "table") == 0) {
        curve->type = CURVE_TABLE;
    } else if (strcmp(name, "tanh") == 0) {
        curve->type = CURVE_TANH;
    } else if (strcmp(name, "linear") != 0) {
        return message_error(OUTCOME_BAD_INPUT, place(source, key, "type", -1),
                             "unknown curve type \"%s\", expected \"linear\", \"tanh\" or \"table\"", name);
    }
    const outcome_t outcome = check_members(source, key, object, curve->type == CURVE_TABLE);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    return curve->type == CURVE_TABLE ? read_table(source, key, curve) : read_formula(source, key, curve);
}

static outcome_t read_plays(const source_t* source, model_t* model)
{
    size_t num_weights = 0;
    size_t num_states = 0;
    outcome_t outcome = read_numbers(source, "radii", NULL, true, &model->radius, &model->num_plays);
    if (outcome == OUTCOME_OK) {
        outcome = read_numbers(source, "weights", NULL, true, &model->weight, &num_weights);
    }
    if (outcome == OUTCOME_OK && num_weights != model->num_plays) {
        outcome = wrong_count(source, "weights", NULL, num_weights, "radii", model->num_plays);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_numbers(source, "initial", NULL, false, &model->initial, &num_states);
    }
    if (outcome == OUTCOME_OK && model->initial != NULL && num_states != model->num_plays) {
        outcome = wrong_count(source, "initial", NULL, num_states, "radii", model->num_plays);
    }
    return outcome;
}

static outcome_t read_effect(const source_t* source, const json_t* effect, long index)
{
    const json_t* type = json_object_get(effect, "type");
    if (!json_is_object(effect) || !json_is_string(type)) {
        return message_error(OUTCOME_BAD_INPUT, place(source, "effects", NULL, index),
                             "an effect is not an object with a \"type\" that names it");
    }
    const char* name = json_string_value(type);
    if (!effect_is_known(name)) {
        return message_error(OUTCOME_BAD_INPUT, place(source, "effects", "type", index),
                             "unknown effect \"%s\"", name);
    }
    if (strcmp(name, "exogenous") == 0 && !json_is_string(json_object_get(effect, "column"))) {
        return message_error(OUTCOME_BAD_INPUT, place(source, "effects", "column", index),
                             "an exogenous effect needs a \"column\" that names the record's column");
    }
    return OUTCOME_OK;
}

static outcome_t read_effects(const source_t* source, model_t* model)
{
    json_t* effects = json_object_get(source->root, "effects");
    if (effects == NULL) {
        return OUTCOME_OK;
    }
    if (!json_is_array(effects)) {
        return wrong_type(source, "effects", NULL, -1, "an array of effects");
    }
    for (size_t i = 0; i < json_array_size(effects); ++i) {
        const outcome_t outcome = read_effect(source, json_array_get(effects, i), (long)i);
        if (outcome != OUTCOME_OK) {
            return outcome;
        }
    }
    model->effects = json_incref(effects);
    return OUTCOME_OK;
}

static outcome_t read_header(const source_t* source)
{
    if (!json_is_object(source->root)) {
        return message_error(OUTCOME_BAD_INPUT, place(source, NULL, NULL, -1),
                             "not a model: expected an object with \"format\": \"" MODEL_FORMAT_NAME "\"");
    }
    const json_t* format = json_object_get(source->root, "format");
    if (format == NULL) {
        return missing(source, "format", NULL);
    }
    if (!json_is_string(format) || strcmp(json_string_value(format), MODEL_FORMAT_NAME) != 0) {
        return message_error(OUTCOME_BAD_INPUT, place(source, "format", NULL, -1),
                             "not a model: the format is not \"" MODEL_FORMAT_NAME "\"");
    }
    const json_t* version = json_object_get(source->root, "version");
    if (version == NULL) {
        return missing(source, "version", NULL);
    }
    if (!json_is_integer(version) || json_integer_value(version) != MODEL_VERSION) {
        return message_error(OUTCOME_BAD_INPUT, place(source, "version", NULL, -1),
                             "unknown version of the model format, this hyst reads version %d",
                             MODEL_VERSION);
    }
    return OUTCOME_OK;
}

static outcome_t read_input(const source_t* source, model_t* model)
{
    const json_t* input = json_object_get(source->root, "input");
    if (input == NULL) {
        return missing(source, "input", NULL);
    }
    if (!json_is_object(input)) {
        return wrong_type(source, "input", NULL, -1, "an object with \"min\" and \"max\"");
    }
    const json_t* output = json_object_get(source->root, "output");
    if (output != NULL && !json_is_object(output)) {
        return wrong_type(source, "output", NULL, -1, "an object");
    }
    outcome_t outcome = read_number(source, "input", "min", true, &model->input_min);
    if (outcome == OUTCOME_OK) {
        outcome = read_number(source, "input", "max", true, &model->input_max);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_string(source, "input", "unit", &model->input_unit);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_string(source, "output", "unit", &model->output_unit);
    }
    return outcome;
}

static outcome_t read_identification(const source_t* source, model_t* model)
{
    json_t* identification = json_object_get(source->root, "identification");
    if (identification != NULL && !json_is_object(identification)) {
        return wrong_type(source, "identification", NULL, -1, "an object");
    }
    model->identification = json_incref(identification);
    return OUTCOME_OK;
}

static outcome_t read_members(const source_t* source, model_t* model)
{
    outcome_t outcome = read_header(source);
    if (outcome == OUTCOME_OK) {
        outcome = read_string(source, "name", NULL, &model->name);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_input(source, model);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_curve(source, "ascending", &model->ascending);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_curve(source, "descending", &model->descending);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_curve(source, "nonhysteretic", &model->nonhysteretic);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_plays(source, model);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_effects(source, model);
    }
    if (outcome == OUTCOME_OK) {
        outcome = read_identification(source, model);
    }
    return outcome;
}

static outcome_t parse(source_t* source, model_t* model)
{
    json_error_t error;
    source->root = json_loadb(source->text, source->length, JSON_REJECT_DUPLICATES, &error);
    if (source->root == NULL) {
        const size_t consumed = error.position > 0 ? (size_t)error.position : 1;
        return message_error(OUTCOME_BAD_INPUT,
                             text_location(source->file, source->text, source->length, consumed - 1),
                             "not valid JSON: %s", error.text);
    }
    const outcome_t outcome = read_members(source, model);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    const model_fault_t fault = model_check(model);
    if (fault.key != NULL) {
        return message_error(OUTCOME_BAD_INPUT, place(source, fault.key, fault.subkey, fault.index), "%s",
                             fault.text);
    }
    return OUTCOME_OK;
}

outcome_t model_read(const char* path, model_t* model)
{
    *model = (model_t){0};
    source_t source = {.file = input_name(path)};
    const outcome_t readable = input_read_all(path, &source.text, &source.length);
    if (readable != OUTCOME_OK) {
        return readable;
    }
    *model = model_new("model");
    const outcome_t outcome = parse(&source, model);
    if (outcome != OUTCOME_OK) {
        model_free(model);
    }
    json_decref(source.root);
    free(source.text);
    return outcome;
}
