#include "fine_plant.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    PLAYS = 8,
    LAGS = 6,
    POWER_LAGS = 60,
    LAYERS = 10,
    STATES = 6,
    MOST_NODES = 40,
    MOST_UNKNOWNS = MOST_NODES + 2
};

typedef struct {
    const char* name;
    const char* mechanism;
    const double* p;
    const model_t* model;
    double dt;
    double duration;
    double command; ///< the last step's
    double drive;
    double layer[LAYERS]; ///< the field across half a lamination, the applied one outside the first
    double seen;          ///< by the plays, ahead of a mean field
    double remanence;
    double history[600]; ///< the delay's line
    size_t steps;
    double w[PLAYS];
    double sum, scaled, travel;
    double middle, half;
    double lagged_middle;
    double lag[LAGS];
    double power[POWER_LAGS];
    double place, speed;
    double before, heat, spans, command_speed, unlimited;
    double spline[MOST_UNKNOWNS];
    bool started;
} plant_t;

static bool is(const plant_t* plant, const char* name)
{
    return strcmp(plant->name, name) == 0;
}

static bool by(const plant_t* plant, const char* name, const char* mechanism)
{
    return is(plant, name) && strcmp(plant->mechanism, mechanism) == 0;
}

static double clamp(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

static double delayed(plant_t* plant, double value)
{
    const size_t length = sizeof plant->history / sizeof plant->history[0];
    for (size_t i = 0; !plant->started && i < length; ++i) {
        plant->history[i] = value;
    }
    plant->history[plant->steps % length] = value;
    const size_t late = (size_t)lround(plant->p[0] / plant->dt);
    return plant->history[(plant->steps + length - late) % length];
}

static double drive(plant_t* plant, double u)
{
    if (!plant->started) {
        plant->drive = u;
    }
    if (by(plant, "delay", "")) {
        return delayed(plant, u);
    }
    if (is(plant, "input_lag")) {
        const double half_range = (plant->model->input_max - plant->model->input_min) / 2;
        const double level = clamp(plant->drive / half_range, -1, 1);
        plant->drive += plant->dt / (plant->p[0] * (1 + plant->p[1] * level)) * (u - plant->drive);
        return plant->drive;
    }
    if (is(plant, "slew_limit")) {
        const double* p = plant->p;
        plant->unlimited = plant->started ? plant->unlimited : u;
        plant->unlimited += plant->dt * (u - plant->unlimited) / p[2];
        plant->drive += plant->dt * clamp((u - plant->drive) / p[2], -p[0] * (1 - p[1]), p[0] * (1 + p[1]));
        return u + plant->drive - plant->unlimited;
    }
    return u;
}

static double nonhysteretic(const plant_t* plant, double v)
{
    return plant->model->nonhysteretic.slope * v + plant->model->nonhysteretic.shift;
}

/// The heat equation over layers of equal thickness, the slowest of its modes with time constant p[0].
static double diffused(plant_t* plant, double v)
{
    const double pi = acos(-1.0);
    const double rate = plant->dt * LAYERS * LAYERS * 4 / (pi * pi * plant->p[0]);
    double before[LAYERS];
    double mean = 0;
    memcpy(before, plant->layer, sizeof before);
    for (size_t k = 0; k < LAYERS; ++k) {
        // The surface is half a layer from the first one's middle; nothing flows through the lamination's.
        const double outward = k > 0 ? before[k - 1] - before[k] : 2 * (v - before[k]);
        const double inward = k + 1 < LAYERS ? before[k + 1] - before[k] : 0;
        plant->layer[k] += rate * (outward + inward);
        mean += plant->layer[k] / LAYERS;
    }
    return mean;
}

static double field_inside(plant_t* plant, double v)
{
    if (!plant->started) {
        plant->seen = v;
        for (size_t k = 0; k < LAYERS; ++k) {
            plant->layer[k] = v;
        }
    }
    if (by(plant, "rate_dependence", "diffusion")) {
        plant->seen = diffused(plant, v);
    } else if (by(plant, "rate_dependence", "excess")) {
        const double gap = (v - plant->seen) / plant->p[0];
        plant->seen += plant->dt * gap * fabs(gap);
    } else {
        plant->seen = v;
    }
    return plant->seen;
}

/// The output over the mean of the plays' ascent from negative and descent from positive saturation.
static double above_middle(const plant_t* plant, double v, double output)
{
    const model_t* model = plant->model;
    const double bottom = tanh(model->descending.slope * model->input_min + model->descending.shift);
    const double top = tanh(model->ascending.slope * model->input_max + model->ascending.shift);
    double middle = nonhysteretic(plant, v);
    for (size_t j = 0; j < PLAYS; ++j) {
        const double r = model->radius[j];
        const double up = fmax(tanh(model->ascending.slope * v + model->ascending.shift) - r, bottom + r);
        const double down = fmin(tanh(model->descending.slope * v + model->descending.shift) + r, top - r);
        middle += model->weight[j] * (up + down) / 2;
    }
    return output - middle;
}

/// The input goes to the turns one after the other, in small steps.
static double after_turns(const plant_t* plant, double r, double w, double v)
{
    enum { TURNS = 4, PARTS = 100 };
    const model_t* model = plant->model;
    double from = model->input_min;
    for (int k = 0; k <= TURNS; ++k) {
        const double to = k < TURNS ? plant->p[k] : v;
        for (int i = 1; i <= PARTS; ++i) {
            const double u = from + (to - from) * i / PARTS;
            w = clamp(w, tanh(model->ascending.slope * u + model->ascending.shift) - r,
                      tanh(model->descending.slope * u + model->descending.shift) + r);
        }
        from = to;
    }
    return w;
}

static void move_play(const plant_t* plant, double r, double* w, double low, double high)
{
    if (by(plant, "rate_dependence", "play_lag")) {
        const double tau = plant->p[0] * (1 + plant->p[1] * r / plant->model->radius[PLAYS - 1]);
        *w += plant->dt / tau * (clamp(*w, low, high) - *w);
    } else {
        *w = clamp(*w, low, high);
    }
}

/// The next input of a way down the range from its top and up to v at p[2].
static double approached(const plant_t* plant, double u, double* to, double v)
{
    const double reach = plant->p[2] * plant->dt;
    u += clamp(*to - u, -reach, reach);
    *to = u > plant->model->input_min ? *to : v;
    return u;
}

/// A play that lags, come this way from positive saturation.
static double after_approach(const plant_t* plant, double r, double v)
{
    const model_t* model = plant->model;
    double w = tanh(model->ascending.slope * model->input_max + model->ascending.shift) - r;
    double u = model->input_max;
    double to = model->input_min;
    while (u > to || u < v) {
        u = approached(plant, u, &to, v);
        move_play(plant, r, &w, tanh(model->ascending.slope * u + model->ascending.shift) - r,
                  tanh(model->descending.slope * u + model->descending.shift) + r);
    }
    return w;
}

/// What the plays give to the major loop's middle.
static double plays_middle(const plant_t* plant, double v)
{
    return -above_middle(plant, v, 0) - nonhysteretic(plant, v);
}

/// How far that is at v above itself with the plays' lag behind.
static double middle_ahead(plant_t* plant, double v)
{
    const double part = plant->dt / plant->p[0];
    if (!plant->started) {
        double u = plant->model->input_max;
        double to = plant->model->input_min;
        plant->lagged_middle = plays_middle(plant, u);
        while (u > to || u < v) {
            u = approached(plant, u, &to, v);
            plant->lagged_middle += part * (plays_middle(plant, u) - plant->lagged_middle);
        }
    }
    plant->lagged_middle += part * (plays_middle(plant, v) - plant->lagged_middle);
    return plays_middle(plant, v) - plant->lagged_middle;
}

static void start_plays(plant_t* plant, double v)
{
    const model_t* model = plant->model;
    const double bottom = tanh(model->descending.slope * model->input_min + model->descending.shift);
    const double top = tanh(model->ascending.slope * model->input_max + model->ascending.shift);
    for (size_t j = 0; j < PLAYS; ++j) {
        const double r = model->radius[j];
        const double low = tanh(model->ascending.slope * v + model->ascending.shift) - r;
        const double high = tanh(model->descending.slope * v + model->descending.shift) + r;
        plant->w[j] = fmax(bottom + r, low);
        if (by(plant, "initial_state", "turning_points")) {
            plant->w[j] = after_turns(plant, r, bottom + r, v);
        } else if (by(plant, "rate_dependence", "play_lag")) {
            plant->w[j] = after_approach(plant, r, v);
        } else if (is(plant, "initial_state")) {
            const double place =
                (r - model->radius[0]) / (model->radius[PLAYS - 1] - model->radius[0]) * (STATES - 1);
            const size_t node = place < STATES - 1 ? (size_t)place : STATES - 2;
            const double part = place - (double)node;
            plant->w[j] += ((1 - part) * plant->p[node] + part * plant->p[node + 1]) * (high - plant->w[j]);
        }
        plant->middle += model->weight[j] * (bottom + top) / 2;
        plant->half += model->weight[j] * ((top - bottom) / 2 - r);
        plant->sum += model->weight[j] * plant->w[j];
    }
    plant->scaled = plant->sum;
    plant->command = v;
}

/// By how much a coercive field that follows the column sets back what the plays see of v.
static double set_back(const plant_t* plant, double v, double temperature)
{
    const model_t* model = plant->model;
    return (v - (model->input_max + model->input_min) / 2) * plant->p[0] *
           (temperature + plant->p[1] * temperature * temperature);
}

/// The plays' weighted sum as the effects inside the hysteresis leave it.
static double plays(plant_t* plant, double command, double temperature)
{
    const model_t* model = plant->model;
    const double half_range = (model->input_max - model->input_min) / 2;
    double v = field_inside(plant, command);
    double extra = 0;
    if (by(plant, "exogenous", "coercive_field")) {
        v -= set_back(plant, v, temperature);
    } else if (is(plant, "exogenous")) {
        extra = plant->p[2] * (temperature + plant->p[3] * temperature * temperature);
    }
    if (by(plant, "noncongruency", "moving")) {
        v += plant->p[0] * half_range * (plant->sum - plant->middle) / plant->half;
    }
    if (by(plant, "noncongruency", "remanence_field")) {
        v += plant->p[0] * half_range * plant->remanence;
    }
    if (by(plant, "rate_dependence", "widening")) {
        extra += plant->p[0] * fabs(command - plant->command) / plant->dt;
    }
    const double before = plant->sum;
    plant->sum = 0;
    for (size_t j = 0; j < PLAYS; ++j) {
        const double r = model->radius[j] + extra;
        move_play(plant, r, &plant->w[j], tanh(model->ascending.slope * v + model->ascending.shift) - r,
                  tanh(model->descending.slope * v + model->descending.shift) + r);
        plant->sum += model->weight[j] * plant->w[j];
    }
    plant->travel += fabs(command - plant->command);
    plant->command_speed = fabs(command - plant->command) / plant->dt;
    plant->command = command;
    const double level = command / half_range;
    const double faded = exp(-plant->p[0] * plant->travel / (2 * half_range));
    const double moved = plant->sum - before;
    if (by(plant, "noncongruency", "increment")) {
        plant->scaled += (1 + plant->p[0] * level) * moved;
    } else if (by(plant, "wear", "increment")) {
        plant->scaled += faded * moved;
    } else if (by(plant, "noncongruency", "product")) {
        plant->scaled = plant->middle + (1 + plant->p[0] * level) * (plant->sum - plant->middle);
    } else if (by(plant, "wear", "amplitude")) {
        plant->scaled = plant->middle + faded * (plant->sum - plant->middle);
    } else {
        plant->scaled = plant->sum;
    }
    return plant->scaled;
}

/// The model's output between its two saturations.
static void output_range(const plant_t* plant, double* middle, double* half)
{
    const curve_t* d = &plant->model->nonhysteretic;
    const double low = d->slope * plant->model->input_min + d->shift + plant->middle - plant->half;
    const double high = d->slope * plant->model->input_max + d->shift + plant->middle + plant->half;
    *middle = (low + high) / 2;
    *half = (high - low) / 2;
}

static double worn(plant_t* plant, double y)
{
    double middle;
    double half;
    output_range(plant, &middle, &half);
    const double* p = plant->p;
    const double span = plant->model->input_max - plant->model->input_min;
    const double own = plant->started ? fabs(y - plant->before) / plant->dt / (2 * half) * span : 0;
    const double speed = (1 - p[4]) * plant->command_speed + p[4] * own;
    plant->spans += plant->dt / span * speed * pow(speed / p[5], p[3]);
    plant->before = y;
    const double pivot = middle + p[1] * half;
    const double settled = (1 - exp(-p[2] * plant->spans)) / p[2];
    return pivot + (y - pivot) / exp(p[0] * settled);
}

/// (1 + t/onset)^order - 1 as a mixture of lags, ten a decade from a tenth of the onset on: the integral over
/// ln(tau) of order / Gamma(1 - order) (tau/onset)^order exp(-onset/tau) (1 - exp(-t/tau)).
static double power_creep(plant_t* plant, double y)
{
    const double* p = plant->p;
    double sum = 0;
    for (size_t k = 0; k < POWER_LAGS; ++k) {
        const double tau = p[1] * exp(log(10.0) * ((double)k / 10 - 1));
        const double density = p[2] / tgamma(1 - p[2]) * exp(p[2] * log(tau / p[1]) - p[1] / tau);
        plant->power[k] += plant->dt / tau * (y - plant->place - plant->power[k]);
        sum += p[0] * density * log(10.0) / 10 * plant->power[k];
    }
    return sum;
}

/// Heat that the motion's losses leave, by small steps.
static double heated(plant_t* plant, double y, bool squared)
{
    const double* p = plant->p;
    const double rate = plant->started ? fabs(y - plant->before) / plant->dt : 0;
    plant->heat += plant->dt / p[0] * ((squared ? rate * rate : rate) - plant->heat);
    plant->before = y;
    double middle;
    double half;
    output_range(plant, &middle, &half);
    return middle + (y - middle) / exp(p[1] * plant->heat) + p[2] * plant->heat;
}

static double body(plant_t* plant, double y, double temperature)
{
    if (!plant->started) {
        plant->place = y;
        for (size_t k = 0; k < LAGS; ++k) {
            plant->lag[k] = y;
        }
    }
    const double* p = plant->p;
    if (is(plant, "gain_offset")) {
        return p[0] * y + p[1];
    }
    if (by(plant, "exogenous", "")) {
        const double law = temperature + p[3] * temperature * temperature;
        return y * (1 + p[0] * law) + p[1] * law;
    }
    if (by(plant, "wear", "response")) {
        return worn(plant, y);
    }
    if (is(plant, "unknown")) {
        return heated(plant, y, by(plant, "unknown", "self_heating_losses"));
    }
    if (!is(plant, "creep")) {
        return y;
    }
    if (by(plant, "creep", "power_law")) {
        return y + power_creep(plant, y);
    }
    double mean = 0;
    for (size_t k = 0; k < LAGS; ++k) {
        const double tau = exp(log(p[1]) + (log(p[2]) - log(p[1])) * (double)k / (LAGS - 1));
        plant->lag[k] += plant->dt / tau * (y - plant->lag[k]);
        mean += plant->lag[k] / LAGS;
    }
    return by(plant, "creep", "delayed") ? y + p[0] * (mean - y) : y + p[0] * (mean - plant->place);
}

/// The natural spline through 0 and the nodes at 1, 2 ... as b x + sum c_k max(x - k, 0)^3: the nodes, and no
/// curvature beyond the last. Gauss-Jordan with pivots.
static void fit_spline(const double* node, size_t nodes, double* unknown)
{
    const size_t unknowns = nodes + 2;
    double a[MOST_UNKNOWNS][MOST_UNKNOWNS + 1] = {{0}};
    for (size_t row = 0; row < unknowns; ++row) {
        for (size_t k = 0; k <= nodes; ++k) {
            const double x = fmax((double)row + 1 - (double)k, 0);
            a[row][k + 1] = row < nodes ? x * x * x : row == nodes ? 1 : (double)k;
        }
        a[row][0] = row < nodes ? (double)row + 1 : 0;
        a[row][unknowns] = row < nodes ? node[row] : 0;
    }
    for (size_t column = 0; column < unknowns; ++column) {
        size_t best = column;
        for (size_t row = column; row < unknowns; ++row) {
            best = fabs(a[row][column]) > fabs(a[best][column]) ? row : best;
        }
        for (size_t k = 0; k <= unknowns; ++k) {
            const double swapped = a[column][k];
            a[column][k] = a[best][k];
            a[best][k] = swapped;
        }
        for (size_t row = 0; row < unknowns; ++row) {
            const double factor = row != column ? a[row][column] / a[column][column] : 0;
            for (size_t k = column; k <= unknowns; ++k) {
                a[row][k] -= factor * a[column][k];
            }
        }
    }
    for (size_t k = 0; k < unknowns; ++k) {
        unknown[k] = a[k][unknowns] / a[k][k];
    }
}

static double drift(plant_t* plant, double time)
{
    if (by(plant, "drift", "linear")) {
        return plant->p[0] * time;
    }
    const size_t nodes = by(plant, "drift", "dense_spline")    ? 40
                         : by(plant, "drift", "finest_spline") ? 20
                         : by(plant, "drift", "fine_spline")   ? 10
                                                               : 6;
    const double x = (double)nodes * time / plant->duration;
    if (!plant->started) {
        fit_spline(plant->p, nodes, plant->spline);
    }
    double value = plant->spline[0] * x;
    for (size_t k = 0; k <= nodes; ++k) {
        value += plant->spline[k + 1] * pow(fmax(x - (double)k, 0), 3);
    }
    return value;
}

static double curved(const plant_t* plant, double y)
{
    const double* p = plant->p;
    double middle;
    double half;
    output_range(plant, &middle, &half);
    const double z = (y - middle) / half;
    if (by(plant, "output_nonlinearity", "two_point")) {
        return y + half * (1 - z * z) * (p[0] + p[1] * (0.5 - fabs(p[0])) * z);
    }
    return y + half * (p[2] + p[3] * z + p[0] * z * z + p[1] * z * z * z);
}

static double hum(const plant_t* plant, double time)
{
    const double* p = plant->p;
    const double start = by(plant, "periodic_disturbance", "run_up") ? exp(-time / p[9]) : 0;
    double sum = 0;
    for (int h = 1; h <= 3; ++h) {
        const double angle = 2 * acos(-1.0) * h * (p[0] * time + p[7] * start);
        sum += p[2 * h - 1] * sin(angle) + p[2 * h] * cos(angle);
    }
    return sum * (1 + p[8] * start);
}

/// The contact follows what drives it by small steps, the gap is about the contact.
static double loose(plant_t* plant, double y)
{
    const double half = plant->p[0] / 2;
    if (!plant->started) {
        plant->before = y;
        plant->place = y + plant->p[1] * half;
    }
    plant->before += plant->dt / plant->p[2] * (y - plant->before);
    plant->place = clamp(plant->place, plant->before - half, plant->before + half);
    return plant->place + y - plant->before;
}

/// The logarithm of a sum of exponentials: the soft form of a largest and of a smallest.
static double soft_bottom(double y, double low, double knee)
{
    return knee * log(exp(y / knee) + exp(low / knee));
}

static double soft_top(double y, double high, double knee)
{
    return -knee * log(exp(-y / knee) + exp(-high / knee));
}

static double sensor(plant_t* plant, double y, double time)
{
    const double* p = plant->p;
    if (by(plant, "delay", "measurement")) {
        return delayed(plant, y);
    }
    if (is(plant, "output_lag")) {
        plant->place += plant->dt / p[0] * (y - plant->place);
        plant->before = plant->started ? plant->before : y;
        plant->before += plant->dt / (p[1] * p[0]) * (plant->place - plant->before);
        return plant->before;
    }
    if (is(plant, "resonance")) {
        const double w = 2 * acos(-1.0) * p[0];
        plant->speed += plant->dt * (w * w * (y - plant->place) - 2 * p[1] * w * plant->speed);
        plant->place += plant->dt * plant->speed;
        return (1 - p[2]) * plant->place + p[2] * y;
    }
    if (is(plant, "backlash")) {
        return loose(plant, y);
    }
    if (is(plant, "output_saturation")) {
        return soft_top(soft_bottom(y, p[0], p[2]), p[1], p[2]);
    }
    if (is(plant, "output_nonlinearity")) {
        return curved(plant, y);
    }
    if (is(plant, "drift")) {
        return y + drift(plant, time);
    }
    if (is(plant, "periodic_disturbance")) {
        return y + hum(plant, time);
    }
    if (is(plant, "quantization")) {
        return p[1] + p[0] * floor((y - p[1]) / p[0] + 0.5);
    }
    return y;
}

/// Both parts of the material.
static double material(plant_t* plant, double v, double temperature)
{
    const double half_range = (plant->model->input_max - plant->model->input_min) / 2;
    const double before = plant->remanence;
    const double sum = plays(plant, v, temperature);
    const bool has_share =
        by(plant, "rate_dependence", "diffusion") || by(plant, "rate_dependence", "excess");
    const double share = has_share ? plant->p[1] : 0;
    double output = sum + (1 - share) * nonhysteretic(plant, v) + share * nonhysteretic(plant, plant->seen);
    if (by(plant, "noncongruency", "remanence_field")) {
        output = sum + nonhysteretic(plant, v + plant->p[1] * plant->p[0] * half_range * before);
    }
    if (by(plant, "exogenous", "coercive_field")) {
        output = sum + nonhysteretic(plant, v - plant->p[2] * set_back(plant, v, temperature));
    }
    if (by(plant, "rate_dependence", "play_lag")) {
        output += plant->p[3] * middle_ahead(plant, v);
    }
    double middle;
    double half;
    output_range(plant, &middle, &half);
    plant->remanence = above_middle(plant, v, output) / half;
    if (by(plant, "noncongruency", "remanence_stiffness")) {
        const double x = v / half_range;
        const double steeper = plant->p[0] * x + plant->p[1] * (x * x - 1) + plant->p[2] * x * (x * x - 1);
        return output + steeper * plant->remanence * half;
    }
    return output;
}

static double step(plant_t* plant, double u, double temperature, double time)
{
    const double v = drive(plant, u);
    if (!plant->started) {
        start_plays(plant, v);
    }
    const double y = body(plant, material(plant, v, temperature), temperature);
    const double output = sensor(plant, y, time);
    plant->started = true;
    plant->steps += 1;
    return output;
}

void fine_plant(const effect_case_t* of, const model_t* model, const record_t* record, double* output)
{
    plant_t* plant = xcalloc(1, sizeof *plant);
    *plant = (plant_t){.name = of->name,
                       .mechanism = of->mechanism != NULL ? of->mechanism : "",
                       .p = of->parameter,
                       .model = model,
                       .duration = record->time[record->num_samples - 1]};
    const double* temperature = record->auxiliary[0].value;
    plant->dt = (record->time[1] - record->time[0]) / FINE_STEPS;
    output[0] = step(plant, record->input[0], 0, 0);
    for (size_t i = 1; i < record->num_samples; ++i) {
        for (size_t k = 1; k <= FINE_STEPS; ++k) {
            const double part = (double)k / FINE_STEPS;
            output[i] = step(plant, (1 - part) * record->input[i - 1] + part * record->input[i],
                             (1 - part) * temperature[i - 1] + part * temperature[i] - temperature[0],
                             (1 - part) * record->time[i - 1] + part * record->time[i]);
        }
    }
    free(plant);
}
