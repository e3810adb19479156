#include "model_crc.h"
#include <stdlib.h>
#include <string.h>

uint32_t crc32_update(uint32_t crc, const void* data, size_t length)
{
    const unsigned char* byte = data;
    crc = ~crc;
    for (size_t i = 0; i < length; ++i) {
        crc ^= byte[i];
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1) ^ ((crc & 1U) != 0 ? UINT32_C(0xEDB88320) : 0U);
        }
    }
    return ~crc;
}

/// With its closing 0, so that neighbouring texts cannot be divided otherwise.
static uint32_t add_text(uint32_t crc, const char* text)
{
    return crc32_update(crc, text, strlen(text) + 1);
}

/// Least significant byte first, whatever the machine's order.
static uint32_t add_integer(uint32_t crc, uint64_t value)
{
    unsigned char byte[8];
    for (int i = 0; i < 8; ++i) {
        byte[i] = (unsigned char)(value >> (8 * i));
    }
    return crc32_update(crc, byte, sizeof byte);
}

static uint32_t add_numbers(uint32_t crc, const double* number, size_t count)
{
    crc = add_integer(crc, count);
    for (size_t i = 0; i < count; ++i) {
        uint64_t bits;
        memcpy(&bits, &number[i], sizeof bits);
        crc = add_integer(crc, bits);
    }
    return crc;
}

static uint32_t add_curve(uint32_t crc, const curve_t* curve)
{
    crc = add_integer(crc, (uint64_t)curve->type);
    if (curve->type == CURVE_TABLE) {
        return add_numbers(add_numbers(crc, curve->x, curve->num_knots), curve->y, curve->num_knots);
    }
    const double parameters[] = {curve->slope, curve->shift, curve->gain, curve->offset};
    return add_numbers(crc, parameters, 4);
}

static uint32_t add_json(uint32_t crc, const json_t* json)
{
    char* text = json_dumps(json, JSON_COMPACT | JSON_SORT_KEYS | JSON_ENCODE_ANY | JSON_REAL_PRECISION(15));
    crc = add_text(crc, text != NULL ? text : "");
    free(text);
    return crc;
}

uint32_t model_crc(const model_t* model)
{
    const double range[] = {model->input_min, model->input_max};
    uint32_t crc = add_text(0, model->name);
    crc = add_text(crc, model->input_unit);
    crc = add_text(crc, model->output_unit);
    crc = add_numbers(crc, range, 2);
    crc = add_curve(crc, &model->ascending);
    crc = add_curve(crc, &model->descending);
    crc = add_curve(crc, &model->nonhysteretic);
    crc = add_numbers(crc, model->radius, model->num_plays);
    crc = add_numbers(crc, model->weight, model->num_plays);
    crc = add_numbers(crc, model->initial, model->initial != NULL ? model->num_plays : 0);
    crc = add_json(crc, model->effects);
    return add_json(crc, model->identification);
}
