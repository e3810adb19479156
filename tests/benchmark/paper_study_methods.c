#include "paper_study_methods.h"
#include "paper_study_rival.h"

typedef struct {
    const char* name;
    partition_cost_t cost;
    bool unscaled;
} method_t;

static const method_t methods[METHOD_RIVAL] = {
    {"entropy-sum", COST_ENTROPY_SUM, false}, {"entropy-sum, unscaled", COST_ENTROPY_SUM, true},
    {"entropy-max", COST_ENTROPY_MAX, false}, {"entropy-max, unscaled", COST_ENTROPY_MAX, true},
    {"uniform", COST_UNIFORM, false},         {"uniform, unscaled", COST_UNIFORM, true},
    {"wasserstein", COST_WASSERSTEIN, false}, {"variance", COST_VARIANCE, false},
    {"ensemble", COST_ENSEMBLE, false},
};

const char* method_name(int method)
{
    return method < METHOD_RIVAL ? methods[method].name : "fit to one input";
}

compressed_t method_run(int method, const model_t* model, size_t num_plays)
{
    compressed_t result = {0};
    if (method == METHOD_RIVAL) {
        study_input_t input = study_third_order_input(model);
        result.model = study_rival(model, &input, num_plays, 1, &result.compression.error_bound);
        study_input_free(&input);
    } else {
        const compress_options_t options = {
            .num_plays = num_plays, .cost = methods[method].cost, .unscaled = methods[method].unscaled};
        result.model = compress_model(model, &options, &result.compression);
    }
    return result;
}

void compressed_free(compressed_t* compressed)
{
    model_free(&compressed->model);
    compression_free(&compressed->compression);
}
