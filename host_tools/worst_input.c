#include "worst_input.h"
#include "reference.h"
#include <math.h>
#include <stdlib.h>

typedef struct {
    double from, to; ///< radii
    double excess;
} piece_t;

typedef struct {
    piece_t* piece;
    size_t count;
} pieces_t;

static void collect(void* context, double from, double to, double excess)
{
    pieces_t* pieces = context;
    pieces->piece[pieces->count++] = (piece_t){from, to, excess};
}

static pieces_t pieces_of(const model_t* model, const replacement_t* replacement)
{
    const size_t most = model->num_plays + replacement->plays.num_plays + 2;
    pieces_t pieces = {.piece = xcalloc(most, sizeof(piece_t))};
    replacement_pieces(model, replacement, collect, &pieces);
    return pieces;
}

/// What rounding alone leaves of G where weights cancel: no reason for a reversal.
static double rounding_of_excess(const model_t* model)
{
    double total = 0.0;
    for (size_t j = 0; j < model->num_plays; ++j) {
        total += model->weight[j];
    }
    return 0x1p-50 * total;
}

double* worst_input(const model_t* model, const replacement_t* replacement, size_t* num_samples)
{
    const transport_t transport = replacement_transport(model, replacement);
    const bool above =
        fabs(replacement->constant + transport.above) >= fabs(replacement->constant - transport.below);
    const double least = rounding_of_excess(model);
    const double low = model->input_min;
    const double high = model->input_max;
    pieces_t pieces = pieces_of(model, replacement);
    double* input = xcalloc(pieces.count + 2, sizeof(double));
    size_t count = 0;
    input[count++] = low;
    bool falling = false; // lambda's slope: -1, or +1 as in negative saturation
    double state = curve_value(&model->descending, low) + model_largest_moving_radius(model);
    for (size_t i = pieces.count; i-- > 0;) {
        const piece_t* piece = &pieces.piece[i];
        const bool wanted = (piece->excess > 0.0) == above;
        if (fabs(piece->excess) > least && wanted != falling) {
            input[count++] = wanted ? curve_inverse(&model->ascending, state + piece->to, low, high)
                                    : curve_inverse(&model->descending, state - piece->to, low, high);
            falling = wanted;
        }
        state += (falling ? 1.0 : -1.0) * (piece->to - piece->from);
    }
    free(pieces.piece);
    if (count == 1) {
        input[count++] = low; // a record has two samples
    }
    *num_samples = count;
    return input;
}

double largest_difference(const model_t* model, const model_t* other, const double* input, size_t num_samples)
{
    double* output = xcalloc(2 * num_samples, sizeof(double));
    reference_run(model, START_NEGATIVE_SATURATION, input, num_samples, output);
    reference_run(other, START_NEGATIVE_SATURATION, input, num_samples, output + num_samples);
    double largest = 0.0;
    for (size_t i = 0; i < num_samples; ++i) {
        largest = fmax(largest, fabs(output[i] - output[num_samples + i]));
    }
    free(output);
    return largest;
}
