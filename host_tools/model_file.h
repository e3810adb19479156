/// Reading and writing the JSON model file.
#ifndef HYST_HOST_MODEL_FILE_H
#define HYST_HOST_MODEL_FILE_H

#include "message.h"
#include "model.h"

/// Reads and checks a model; "-" is stdin. Every fault is reported with line and column; *model is then
/// empty.
outcome_t model_read(const char* path, model_t* model);
/// Writes it whole or not at all; "-" is stdout. The bytes depend on the model alone.
outcome_t model_write(const char* path, const model_t* model);

#endif
