#include "loop_middle.h"

#include "extremes.h"
#include "output_range.h"
#include <math.h>
#include <stdlib.h>

enum { CELLS = LOOP_MIDDLE_CELLS };

struct loop_middle {
    double input_min, half_range;
    double half_span; ///< of the model's output between its saturations
    double node[CELLS + 1];
};

/// Both branches in closed form: from a saturation no play has turned, Eq. (6) is one maximum or minimum.
static double middle_of(const model_t* model, double v)
{
    const double bottom = curve_value(&model->descending, model->input_min);
    const double top = curve_value(&model->ascending, model->input_max);
    const double rising = curve_value(&model->ascending, v);
    const double falling = curve_value(&model->descending, v);
    double sum = curve_value(&model->nonhysteretic, v);
    for (size_t j = 0; j < model->num_plays; j++) {
        const double r = model->radius[j];
        const double lowest = bottom + r;
        const double highest = fmax(top - r, lowest);
        sum += model->weight[j] * 0.5 * (fmax(rising - r, lowest) + fmin(falling + r, highest));
    }
    return sum;
}

static loop_middle_t* over_range(const model_t* model)
{
    loop_middle_t* middle = xmalloc(sizeof *middle);
    middle->input_min = model->input_min;
    middle->half_range = 0.5 * (model->input_max - model->input_min);
    middle->half_span = 0.5 * (model_output_max(model) - model_output_min(model));
    return middle;
}

loop_middle_t* loop_middle_between(const model_t* model, const double* ascending, const double* descending)
{
    loop_middle_t* middle = over_range(model);
    for (size_t i = 0; i <= CELLS; i++) {
        middle->node[i] = 0.5 * (ascending[i] + descending[i]);
    }
    return middle;
}

loop_middle_t* loop_middle_new(const model_t* model)
{
    loop_middle_t* middle = over_range(model);
    for (size_t i = 0; i <= CELLS; i++) {
        const double v = model->input_min + 2 * middle->half_range * (double)i / CELLS;
        middle->node[i] = middle_of(model, v);
    }
    return middle;
}

void loop_middle_free(loop_middle_t* middle)
{
    free(middle);
}

static double at(const double* node, double place)
{
    const size_t cell = (size_t)smaller(larger(place, 0), CELLS - 1);
    return node[cell] + (place - (double)cell) * (node[cell + 1] - node[cell]);
}

static double place_of(const loop_middle_t* middle, double v)
{
    return (v - middle->input_min) / (2 * middle->half_range) * CELLS;
}

double loop_middle_at(const loop_middle_t* middle, double v)
{
    return at(middle->node, place_of(middle, v));
}

double loop_middle_remanence(const loop_middle_t* middle, double v, double y)
{
    if (!(middle->half_span > 0)) {
        return 0;
    }
    return smaller(larger((y - loop_middle_at(middle, v)) / middle->half_span, -1), 1);
}
