#include "model_file.h"
#include "output_file.h"
#include <string.h>

static json_t* numbers_json(const double* numbers, size_t count)
{
    json_t* array = json_array();
    for (size_t i = 0; i < count; ++i) {
        json_array_append_new(array, json_real(numbers[i]));
    }
    return array;
}

static json_t* curve_json(const curve_t* curve)
{
    if (curve->type == CURVE_TABLE) {
        return json_pack("{s:s, s:o, s:o}", "type", "table", "x", numbers_json(curve->x, curve->num_knots),
                         "y", numbers_json(curve->y, curve->num_knots));
    }
    return json_pack("{s:s, s:f, s:f, s:f, s:f}", "type", curve->type == CURVE_TANH ? "tanh" : "linear",
                     "slope", curve->slope, "shift", curve->shift, "gain", curve->gain, "offset",
                     curve->offset);
}

/// The members in the order in which they are written.
static json_t* model_json(const model_t* model)
{
    json_t* root = json_pack(
        "{s:s, s:i, s:s, s:{s:s, s:f, s:f}, s:{s:s}, s:o, s:o, s:o, s:o, s:o}", "format", "hyst-model",
        "version", 1, "name", model->name, "input", "unit", model->input_unit, "min", model->input_min, "max",
        model->input_max, "output", "unit", model->output_unit, "ascending", curve_json(&model->ascending),
        "descending", curve_json(&model->descending), "nonhysteretic", curve_json(&model->nonhysteretic),
        "radii", numbers_json(model->radius, model->num_plays), "weights",
        numbers_json(model->weight, model->num_plays));
    if (model->initial != NULL) {
        json_object_set_new(root, "initial", numbers_json(model->initial, model->num_plays));
    }
    if (model->effects != NULL) {
        json_object_set(root, "effects", model->effects);
    }
    if (model->identification != NULL) {
        json_object_set(root, "identification", model->identification);
    }
    return root;
}

/// One member a line: arrays stay on one line, so that two models can be compared line by line.
static void write_members(FILE* stream, json_t* root)
{
    const char* separator = "{";
    const char* key;
    json_t* value;
    json_object_foreach(root, key, value)
    {
        fprintf(stream, "%s\"%s\": ", separator, key);
        json_dumpf(value, stream, JSON_ENCODE_ANY | JSON_REAL_PRECISION(15));
        separator = ",\n ";
    }
    fputs("}\n", stream);
}

outcome_t model_write(const char* path, const model_t* model)
{
    const model_fault_t fault = model_check(model);
    if (fault.key != NULL) {
        return message_error(OUTCOME_NUMERICAL, NOWHERE, "the resulting model is not valid: %s%s%s: %s",
                             fault.key, fault.subkey != NULL ? "." : "",
                             fault.subkey != NULL ? fault.subkey : "", fault.text);
    }
    output_file_t file;
    outcome_t outcome = output_open(&file, path);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    json_t* root = model_json(model);
    if (root == NULL) {
        output_abandon(&file);
        return message_error(OUTCOME_BAD_INPUT, NOWHERE, "the model's name or units are not valid UTF-8");
    }
    write_members(file.stream, root);
    json_decref(root);
    return output_commit(&file);
}
