#include "output_range.h"
#include <math.h>

double model_output_min(const model_t* model)
{
    const double level = curve_value(&model->descending, model->input_min);
    double sum = curve_value(&model->nonhysteretic, model->input_min);
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j] * (level + model->radius[j]);
    }
    return sum;
}

double model_output_max(const model_t* model)
{
    const double low = curve_value(&model->descending, model->input_min);
    const double high = curve_value(&model->ascending, model->input_max);
    double sum = curve_value(&model->nonhysteretic, model->input_max);
    for (size_t j = 0; j < model->num_plays; ++j) {
        sum += model->weight[j] * fmax(low + model->radius[j], high - model->radius[j]);
    }
    return sum;
}
