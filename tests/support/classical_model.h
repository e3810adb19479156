/// The plant of the diagnosis's tests: a classical PI model.
#ifndef HYST_TESTS_CLASSICAL_MODEL_H
#define HYST_TESTS_CLASSICAL_MODEL_H

#include "model.h"

/// Over 0 ... 10: 1 + 0.5 v and plays of radius 0.5, 1, 1.5 ... and weight 0.3 each.
static inline model_t classical_model(size_t num_plays)
{
    model_t model = model_new("plant");
    model.input_min = 0;
    model.input_max = 10;
    curve_free(&model.nonhysteretic);
    model.nonhysteretic = curve_linear(0.5, 1);
    model_set_num_plays(&model, num_plays);
    for (size_t j = 0; j < num_plays; j++) {
        model.radius[j] = 0.5 * (double)(j + 1);
        model.weight[j] = 0.3;
    }
    return model;
}

/// The same with weights 0.3, 0.3 / 2, 0.3 / 3 ...
static inline model_t classical_model_of_falling_weights(size_t num_plays)
{
    model_t model = classical_model(num_plays);
    for (size_t j = 0; j < num_plays; j++) {
        model.weight[j] /= (double)(j + 1);
    }
    return model;
}

#endif
