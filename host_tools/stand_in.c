#include "stand_in.h"

void stand_in_run(const stand_in_t* body, const model_t* model, start_t start, double shift,
                  const double* input, size_t num_samples, double* output)
{
    if (body->is_element) {
        element_run(&body->element, shift, input, num_samples, output);
    } else {
        duhem_run(&body->duhem, model, start, shift, input, num_samples, output);
    }
}

double stand_in_nonhysteretic(const stand_in_t* body, const model_t* model, double input)
{
    return body->is_element ? element_nonhysteretic(&body->element, input)
                            : curve_value(&model->nonhysteretic, input);
}
