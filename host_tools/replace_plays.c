#include "replace_plays.h"
#include "curve_sum.h"
#include <stdlib.h>

size_t model_count_moving(const model_t* model)
{
    const double largest = model_largest_moving_radius(model);
    size_t count = 0;
    while (count < model->num_plays && model->radius[count] < largest) {
        ++count;
    }
    return count;
}

bool model_takes_envelope(const model_t* model)
{
    curve_t sum = curve_copy(&model->nonhysteretic);
    const bool takes =
        curve_equal(&model->ascending, &model->descending) && curve_add_curve(&sum, &model->ascending, 1.0);
    curve_free(&sum);
    return takes;
}

/// The plays with the one at r = 0 that the non-hysteretic part took in; *values is to be freed.
static play_set_t with_envelope(const replacement_t* replacement, double** values)
{
    const size_t num_plays = replacement->plays.num_plays;
    double* radius = xcalloc(2 * (num_plays + 1), sizeof(double));
    double* weight = radius + num_plays + 1;
    *values = radius;
    weight[0] = replacement->envelope_weight;
    for (size_t k = 0; k < num_plays; ++k) {
        radius[k + 1] = replacement->plays.radius[k];
        weight[k + 1] = replacement->plays.weight[k];
    }
    return (play_set_t){radius, weight, num_plays + 1};
}

transport_t replacement_transport(const model_t* model, const replacement_t* replacement)
{
    const play_set_t before = {model->radius, model->weight, model_count_moving(model)};
    double* values;
    const play_set_t after = with_envelope(replacement, &values);
    const transport_t transport = transport_between(&before, &after, model_largest_moving_radius(model));
    free(values);
    return transport;
}

void replacement_pieces(const model_t* model, const replacement_t* replacement, transport_piece_t* piece,
                        void* context)
{
    const play_set_t before = {model->radius, model->weight, model_count_moving(model)};
    double* values;
    const play_set_t after = with_envelope(replacement, &values);
    transport_pieces(&before, &after, model_largest_moving_radius(model), piece, context);
    free(values);
}

/// What plays put on the output in negative saturation, sum p_j (descending(input_min) + r_j).
static long double saturated_sum(const model_t* model, const play_set_t* plays)
{
    const long double level = (long double)curve_value(&model->descending, model->input_min);
    long double sum = 0.0L;
    for (size_t j = 0; j < plays->num_plays; ++j) {
        sum += (long double)plays->weight[j] * (level + (long double)plays->radius[j]);
    }
    return sum;
}

/// The initial state of a play with this radius, linear between its neighbours: it stays in its strip, whose
/// sides are linear in the radius too.
static double initial_at(const model_t* model, double radius)
{
    size_t low = 0;
    size_t high = model->num_plays - 1;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (model->radius[middle] < radius) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    if (low == 0 || !(model->radius[low] > model->radius[low - 1])) {
        return model->initial[low];
    }
    const double part = (radius - model->radius[low - 1]) / (model->radius[low] - model->radius[low - 1]);
    return model->initial[low - 1] + part * (model->initial[low] - model->initial[low - 1]);
}

static void put_plays(const model_t* model, const play_set_t* plays, model_t* replaced)
{
    model_set_num_plays(replaced, plays->num_plays > 0 ? plays->num_plays : 1);
    replaced->radius[0] = model->radius[0];
    for (size_t k = 0; k < plays->num_plays; ++k) {
        replaced->radius[k] = plays->radius[k];
        replaced->weight[k] = plays->weight[k];
    }
    if (model->initial != NULL) {
        replaced->initial = xcalloc(replaced->num_plays, sizeof(double));
        for (size_t k = 0; k < replaced->num_plays; ++k) {
            replaced->initial[k] = initial_at(model, replaced->radius[k]);
        }
    }
}

model_t replace_plays(const model_t* model, const replacement_t* replacement)
{
    model_t replaced = model_copy(model);
    put_plays(model, &replacement->plays, &replaced);
    const double envelope_weight = replacement->envelope_weight;
    if (envelope_weight > 0.0) {
        (void)curve_add_curve(&replaced.nonhysteretic, &model->ascending, envelope_weight);
    }
    const play_set_t before = {model->radius, model->weight, model->num_plays};
    const long double level = (long double)curve_value(&model->descending, model->input_min);
    const long double change = saturated_sum(model, &before) - saturated_sum(model, &replacement->plays) -
                               (long double)envelope_weight * level;
    curve_add(&replaced.nonhysteretic, (double)(change - (long double)replacement->constant));
    return replaced;
}
