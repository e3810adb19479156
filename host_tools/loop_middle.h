/// The middle of a model's major loop, by which a remanent output is told from what the input gives at once.
#ifndef HYST_HOST_LOOP_MIDDLE_H
#define HYST_HOST_LOOP_MIDDLE_H

#include "model.h"

typedef struct loop_middle loop_middle_t;

/// Tabulated in cells of 1 / LOOP_MIDDLE_CELLS of the model's range.
enum { LOOP_MIDDLE_CELLS = 1024 };
loop_middle_t* loop_middle_new(const model_t* model);
/// Of another body over the model's range: its branches at the cells' ends, [LOOP_MIDDLE_CELLS + 1] each, in
/// the input's order.
loop_middle_t* loop_middle_between(const model_t* model, const double* ascending, const double* descending);
void loop_middle_free(loop_middle_t* middle);
/// The mean of the ascending and the descending branch at v; beyond the range straight on.
double loop_middle_at(const loop_middle_t* middle, double v);
/// The remanent part of an output y at v, y - middle(v), over half of what the model's output spans, -1
/// ... 1.
double loop_middle_remanence(const loop_middle_t* middle, double v, double y);

#endif
