/// Firmware that counts what a model costs on the core it runs on: instructions and stack, for each measured
/// model. Prints lines of "name value...", which cost_table.sh reads.
#include "scalar.h"

#include "cost_models.h"
#include "port.h"
#include "print.h"
#include "stack.h"
#include "test_signal.h"

enum {
    NUM_SMOOTH = 1024,
    NUM_LEVELS = 65,
    NUM_JUMPS = 64,
    REPEATS = 20,
    NUM_CHANNELS = 40,
    NUM_ROUNDS = 100
};

static SCALAR(state_t) state;
static memory_t memory[MOST_PLAYS];
static SCALAR(state_t) kept_state;
static memory_t kept_memory[MOST_PLAYS];
static sample_t inputs[NUM_SMOOTH];
static sample_t wanted[NUM_SMOOTH];
static volatile sample_t sink;

static void print_value(const char* name, const uint32_t value)
{
    port_print(name);
    port_print(" ");
    print_unsigned(value);
}

static sample_t input_at(const SCALAR(model_t) * model, const float part)
{
    return sample_between(model->input_min, model->input_max, part);
}

static void start(const SCALAR(model_t) * model, const sample_t input)
{
    (void)SCALAR(reset)(model, &state, HYST_START_NEGATIVE_SATURATION, input);
}

static uint32_t count_loop(void)
{
    port_count_start();
    for (uint32_t i = 0; i < NUM_SMOOTH; ++i) {
        sink = inputs[i];
    }
    return port_count_instructions();
}

static uint32_t count_steps(const SCALAR(model_t) * model)
{
    start(model, inputs[0]);
    port_count_start();
    for (uint32_t i = 0; i < NUM_SMOOTH; ++i) {
        sink = SCALAR(step)(model, &state, inputs[i]);
    }
    return port_count_instructions();
}

/// Each answer is applied; leaves the applied inputs in `inputs`.
static uint32_t count_inverses_and_steps(const SCALAR(model_t) * model)
{
    start(model, inputs[0]);
    port_count_start();
    for (uint32_t i = 0; i < NUM_SMOOTH; ++i) {
        inputs[i] = SCALAR(inverse)(model, &state, wanted[i]).input;
        sink = SCALAR(step)(model, &state, inputs[i]);
    }
    return port_count_instructions();
}

static void count_smooth(const SCALAR(model_t) * model)
{
    for (uint32_t i = 0; i < NUM_SMOOTH; ++i) {
        inputs[i] = input_at(model, signal_smooth(i, 3));
    }
    const uint32_t forward = count_steps(model) - count_loop();
    start(model, inputs[0]);
    for (uint32_t i = 0; i < NUM_SMOOTH; ++i) {
        wanted[i] = SCALAR(step)(model, &state, inputs[i]);
    }
    const uint32_t both = count_inverses_and_steps(model);
    const uint32_t inverse = both - count_steps(model);
    print_value(" forward_smooth", forward / NUM_SMOOTH);
    print_value(" inverse_smooth", inverse / NUM_SMOOTH);
}

/// Word by word, so that no memcpy is needed.
static void copy_memory(memory_t* to, const memory_t* from, const uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i) {
        to[i] = from[i];
    }
}

static void keep(const uint32_t num_plays)
{
    kept_state = state;
    copy_memory(kept_memory, memory, num_plays);
}

static void put_back(const uint32_t num_plays)
{
    state = kept_state;
    copy_memory(memory, kept_memory, num_plays);
}

/// One step from the kept state, counted over many so that the counter's tick does not show.
static uint32_t count_one_step(const SCALAR(model_t) * model, const sample_t input)
{
    port_count_start();
    for (uint32_t i = 0; i < REPEATS; ++i) {
        put_back(model->num_plays);
        sink = input;
    }
    const uint32_t without = port_count_instructions();
    port_count_start();
    for (uint32_t i = 0; i < REPEATS; ++i) {
        put_back(model->num_plays);
        sink = SCALAR(step)(model, &state, input);
    }
    return (port_count_instructions() - without) / REPEATS;
}

static uint32_t count_one_inverse(const SCALAR(model_t) * model, const sample_t output)
{
    port_count_start();
    for (uint32_t i = 0; i < REPEATS; ++i) {
        sink = SCALAR(inverse)(model, &state, output).input;
    }
    return port_count_instructions() / REPEATS;
}

static void raise(uint32_t* most, const uint32_t value)
{
    *most = value > *most ? value : *most;
}

/// A decaying alternation with twice as many swings as plays: as many nested reversals as the memory can
/// hold.
static void nest(const SCALAR(model_t) * model)
{
    const uint32_t swings = 4 * model->num_plays;
    start(model, model->input_min);
    for (uint32_t i = 0; i <= swings; ++i) {
        const float swing = 0.5f - 0.5f * (float)i / (float)swings;
        (void)SCALAR(step)(model, &state, input_at(model, i % 2 == 0 ? 0.5f + swing : 0.5f - swing));
    }
}

/// From the deepest nest to every level of the range, and from every level of random jumps to the next.
static void count_worst(const SCALAR(model_t) * model)
{
    uint32_t forward = 0;
    uint32_t inverse = 0;
    nest(model);
    keep(model->num_plays);
    for (uint32_t i = 0; i < NUM_LEVELS; ++i) {
        const float part = (float)i / (float)(NUM_LEVELS - 1);
        raise(&forward, count_one_step(model, input_at(model, part)));
        put_back(model->num_plays);
        const reach_t reach = reach_of(model, &state);
        raise(&inverse,
              count_one_inverse(model, sample_between(reach.reachable_min, reach.reachable_max, part)));
    }
    uint32_t seed = 3;
    for (uint32_t i = 0; i < NUM_JUMPS; ++i) {
        keep(model->num_plays);
        const reach_t reach = reach_of(model, &state);
        raise(&inverse, count_one_inverse(model, sample_between(reach.reachable_min, reach.reachable_max,
                                                                signal_random(&seed))));
        raise(&forward, count_one_step(model, input_at(model, signal_random(&seed))));
    }
    print_value(" forward_worst", forward);
    print_value(" inverse_worst", inverse);
}

/// Over the same inputs as the worst count, and the inputs that are no inputs.
static void measure_stack(const SCALAR(model_t) * model)
{
    uint32_t forward = 0;
    uint32_t inverse = 0;
    nest(model);
    keep(model->num_plays);
    for (uint32_t i = 0; i < NUM_LEVELS + 2; ++i) {
        const float part = (float)i / (float)(NUM_LEVELS - 1) - 1.0f / (float)(NUM_LEVELS - 1);
        put_back(model->num_plays);
        const reach_t reach = reach_of(model, &state);
        const sample_t output = sample_between(reach.reachable_min, reach.reachable_max, part);
        stack_paint();
        sink = SCALAR(inverse)(model, &state, output).input;
        raise(&inverse, stack_used());
        stack_paint();
        sink = SCALAR(step)(model, &state, input_at(model, part));
        raise(&forward, stack_used());
    }
    print_value(" forward_stack", forward);
    print_value(" inverse_stack", inverse);
}

/// Many channels of one model in one call, each at another place of the smooth path.
static void count_channels(const SCALAR(model_t) * model)
{
    static SCALAR(state_t) states[NUM_CHANNELS];
    static memory_t memories[NUM_CHANNELS][CHANNEL_PLAYS];
    static sample_t channels[NUM_CHANNELS];
    uint32_t total = 0;
    for (uint32_t c = 0; c < NUM_CHANNELS; ++c) {
        if (SCALAR(init)(model, &states[c], memories[c], CHANNEL_PLAYS) != HYST_STATUS_OK) {
            port_print("refused\n");
        }
    }
    for (uint32_t i = 0; i < NUM_ROUNDS; ++i) {
        for (uint32_t c = 0; c < NUM_CHANNELS; ++c) {
            channels[c] = input_at(model, signal_smooth(i + 97 * c, 3));
        }
        port_count_start();
        step_channels(model, states, channels, channels, NUM_CHANNELS);
        total += port_count_instructions();
    }
    port_print("channels");
    print_value(" num", NUM_CHANNELS);
    print_value(" plays", model->num_plays);
    print_value(" ram", (uint32_t)(sizeof states + sizeof memories));
    print_value(" forward_smooth", total / NUM_ROUNDS);
    port_print("\n");
}

int main(void)
{
    for (uint32_t m = 0; m < NUM_COST_MODELS; ++m) {
        const SCALAR(model_t)* model = cost_models[m].model;
        if (SCALAR(init)(model, &state, memory, MOST_PLAYS) != HYST_STATUS_OK) {
            port_print("refused\n");
            return 1;
        }
        port_print("model");
        print_value(" plays", model->num_plays);
        print_value(" tables", cost_models[m].table_bytes);
        print_value(" ram", (uint32_t)sizeof state + model->num_plays * (uint32_t)sizeof memory[0]);
        count_smooth(model);
        count_worst(model);
        measure_stack(model);
        port_print("\n");
        if (model->num_plays == CHANNEL_PLAYS) {
            count_channels(model);
        }
    }
    return 0;
}
