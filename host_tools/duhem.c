#include "duhem.h"

#include "output_range.h"
#include "reference.h"
#include <cblas.h>
#include <math.h>
#include <string.h>

/// Of the input's range, the largest move that is one step of the midpoint rule.
static const double longest_step = 0.01;

/// Where a point lies in the grid.
typedef struct {
    size_t node[4]; ///< corners of the cell: lower and upper row, then the same in the next column
    double weight[4];
    double per_output; ///< rows per output unit, 0 beyond the grid
    double along;      ///< from column to column
} place_t;

static place_t place_of(const duhem_t* d, double u, double y)
{
    const double column = fmin(fmax(u, 0), 1) * (DUHEM_COLUMNS - 1);
    const size_t i = column < DUHEM_COLUMNS - 2 ? (size_t)column : DUHEM_COLUMNS - 2;
    const double a = column - (double)i;
    const double middle = d->middle[i] + a * (d->middle[i + 1] - d->middle[i]);
    const double rows = 0.5 * (DUHEM_ROWS - 1) / (d->width[i] + a * (d->width[i + 1] - d->width[i]));
    const double wanted = (y - middle) * rows + 0.5 * (DUHEM_ROWS - 1);
    const double row = fmin(fmax(wanted, 0), DUHEM_ROWS - 1);
    const size_t k = row < DUHEM_ROWS - 2 ? (size_t)row : DUHEM_ROWS - 2;
    const double b = row - (double)k;
    const size_t corner = i * DUHEM_ROWS + k;
    return (place_t){.node = {corner, corner + 1, corner + DUHEM_ROWS, corner + DUHEM_ROWS + 1},
                     .weight = {(1 - a) * (1 - b), (1 - a) * b, a * (1 - b), a * b},
                     .per_output = wanted > 0 && wanted < DUHEM_ROWS - 1 ? rows : 0,
                     .along = a};
}

static double slope_at(const double* slope, const place_t* p)
{
    double sum = 0;
    for (size_t k = 0; k < 4; k++) {
        sum += p->weight[k] * slope[p->node[k]];
    }
    return sum;
}

/// d slope / d output.
static double slope_change(const double* slope, const place_t* p)
{
    return p->per_output * ((1 - p->along) * (slope[p->node[1]] - slope[p->node[0]]) +
                            p->along * (slope[p->node[3]] - slope[p->node[2]]));
}

/// A move by the midpoint rule; `half_way` is the output there.
static void move_by(duhem_state_t* s, double move, double half_way)
{
    const bool rising = move > 0;
    const double* slope = s->duhem->slope[rising];
    const place_t middle = place_of(s->duhem, s->input + 0.5 * move, half_way);
    if (s->derivative != NULL) {
        // The slope depends on the output, which depends on the free numbers; half a move's part of that is
        // second order and left out.
        const double feedback = s->guide != NULL ? 1 : 1 + move * slope_change(slope, &middle);
        cblas_dscal(DUHEM_FREE, feedback, s->derivative, 1);
        double* own = s->derivative + (rising ? DUHEM_NODES : 0);
        for (size_t k = 0; k < 4; k++) {
            own[middle.node[k]] += move * middle.weight[k];
        }
    }
    s->output += move * slope_at(slope, &middle);
    s->input += move;
}

double duhem_step(duhem_state_t* s, double input)
{
    const duhem_t* d = s->duhem;
    const double part = fmin(fmax((input - d->input_min) / (d->input_max - d->input_min), 0), 1);
    const double way = part - s->input;
    const size_t pieces = 1 + (size_t)(fabs(way) / longest_step);
    const double move = way / (double)pieces;
    for (size_t k = 0; (way > 0 || way < 0) && k < pieces; k++) {
        if (s->guide != NULL) {
            move_by(s, move, s->guide[0] + ((double)k + 0.5) / (double)pieces * (s->guide[1] - s->guide[0]));
        } else {
            const place_t here = place_of(d, s->input, s->output);
            move_by(s, move, s->output + 0.5 * move * slope_at(d->slope[move > 0], &here));
        }
    }
    s->input = part;
    return s->output;
}

duhem_state_t duhem_start(const duhem_t* duhem, const model_t* model, start_t start, double first,
                          double* derivative)
{
    duhem_state_t s = {.duhem = duhem, .derivative = derivative, .output = duhem->saturated};
    if (derivative != NULL) {
        memset(derivative, 0, DUHEM_FREE * sizeof *derivative);
        derivative[DUHEM_FREE - 1] = 1;
    }
    if (start != START_NEGATIVE_SATURATION && (start != START_MODEL || model->initial != NULL)) {
        reference_t reference = reference_new(model, start, first);
        s.input = fmin(fmax((first - duhem->input_min) / (duhem->input_max - duhem->input_min), 0), 1);
        // Where the fit found saturation off the model's, it found the whole output off by that.
        s.output = reference_output(&reference) + duhem->saturated - model_output_min(model);
        reference_free(&reference);
    }
    return s;
}

void duhem_run(const duhem_t* duhem, const model_t* model, start_t start, double shift, const double* input,
               size_t num_samples, double* output)
{
    if (num_samples == 0) {
        return;
    }
    duhem_state_t s = duhem_start(duhem, model, start, input[0], NULL);
    output[0] = duhem_step(&s, input[0]) + shift;
    s.output = output[0];
    for (size_t t = 1; t < num_samples; t++) {
        output[t] = duhem_step(&s, input[t]);
    }
}

duhem_t duhem_new(const model_t* model)
{
    enum { FINE = 64, TOP = (DUHEM_COLUMNS - 1) * FINE };
    duhem_t d = {.input_min = model->input_min, .input_max = model->input_max};
    double input[2 * TOP + 1];
    double output[2 * TOP + 1];
    for (size_t t = 0; t <= 2 * TOP; t++) {
        const double part = 1 - fabs((double)t / TOP - 1);
        input[t] = d.input_min + part * (d.input_max - d.input_min);
    }
    reference_run(model, START_NEGATIVE_SATURATION, input, 2 * TOP + 1, output);
    d.saturated = output[0];
    double widest = 1e-2 * fabs(output[TOP] - output[0]);
    for (size_t i = 0; i < DUHEM_COLUMNS; i++) {
        const double rising = output[i * FINE];
        const double falling = output[2 * TOP - i * FINE];
        d.middle[i] = 0.5 * (rising + falling);
        d.width[i] = 0.5 * fabs(falling - rising);
        widest = fmax(widest, d.width[i]);
    }
    for (size_t i = 0; i < DUHEM_COLUMNS; i++) {
        // Room for a loop a little wider, also where the model's closes.
        d.width[i] = 1.1 * d.width[i] + 0.1 * widest;
        const size_t before = i > 0 ? i - 1 : 0;
        const size_t after = i + 1 < DUHEM_COLUMNS ? i + 1 : i;
        const double slope =
            (d.middle[after] - d.middle[before]) * (DUHEM_COLUMNS - 1) / (double)(after - before);
        for (size_t k = 0; k < DUHEM_ROWS; k++) {
            d.slope[0][i * DUHEM_ROWS + k] = slope;
            d.slope[1][i * DUHEM_ROWS + k] = slope;
        }
    }
    return d;
}
