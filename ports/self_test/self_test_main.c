/// Firmware that proves a generated model on the machine it runs on; the same source runs on the host.
#include "float_bits.h"
#include "hyst/hyst_f32.h"
#include "port.h"
#include "print.h"
#include "self_test_model.h"
#include "test_signal.h"
#include <float.h>

enum { NUM_FORWARD = 20000, NUM_INVERSE = 2000, NUM_TIMED = 4096 };

static hyst_f32_segment_t memory[TESTED_MODEL_NUM_PLAYS];
static hyst_f32_state_t state;
static float timed_input[NUM_TIMED];
static float timed_wanted[NUM_TIMED];
static volatile float sink;

static float within(const float low, const float high, const float part)
{
    const float x = low + part * (high - low);
    return x < high ? x : high;
}

static float input_at(const float part)
{
    return within(TESTED_MODEL.input_min, TESTED_MODEL.input_max, part);
}

static bool report(const char* what, const bool passed)
{
    port_print(what);
    port_print(passed ? "pass" : "FAIL");
    return passed;
}

static bool check_model(void)
{
    const hyst_status_t status = hyst_f32_init(&TESTED_MODEL, &state, memory, TESTED_MODEL_NUM_PLAYS);
    const bool passed = report("model:      ", status == HYST_STATUS_OK);
    port_print(", " TESTED_MODEL_NAME ", ");
    print_unsigned(TESTED_MODEL.num_plays);
    port_print(" plays, ");
    print_unsigned(TESTED_MODEL.num_knots);
    port_print(" knots, RAM ");
    print_unsigned(TESTED_MODEL_RAM_BYTES);
    port_print(" bytes, flash ");
    print_unsigned(TESTED_MODEL_FLASH_BYTES);
    port_print(" bytes and ");
    print_unsigned(TESTED_MODEL_GOLDEN_FLASH_BYTES);
    port_print(" for the golden vectors\n");
    if (!passed) {
        port_print(hyst_status_text(status));
        port_print("\n");
    }
    return passed;
}

static bool check_golden(void)
{
    const bool passed = report(
        "self-test:  ", hyst_f32_self_test(&TESTED_MODEL, &state, &TESTED_MODEL_GOLDEN) == HYST_STATUS_OK);
    port_print(", ");
    print_unsigned(TESTED_MODEL_GOLDEN.num_steps);
    port_print(" golden vectors\n");
    return passed;
}

static float magnitude(const float x)
{
    return x < 0.0f ? -x : x;
}

static float larger(const float a, const float b)
{
    return a > b ? a : b;
}

/// The inverse's rounding, coarser than it is derived for in the library's tests: with u = FLT_EPSILON / 2 an
/// output is off by (11 num_plays + 20) u of the sum of its terms' largest magnitudes, a round trip by 4 of
/// that, and the input by 10 u of its magnitude and width, times the steepest slope.
static float round_trip_bound(void)
{
    float envelope = larger(magnitude(TESTED_MODEL.input_min), magnitude(TESTED_MODEL.input_max));
    float slope = 1.0f;
    float nonhysteretic = TESTED_MODEL.nonhysteretic_slope * envelope;
    float nonhysteretic_slope = TESTED_MODEL.nonhysteretic_slope;
    if (TESTED_MODEL.num_knots != 0) {
        envelope = slope = nonhysteretic = nonhysteretic_slope = 0.0f;
    }
    for (uint32_t k = 0; k < TESTED_MODEL.num_knots; ++k) {
        const hyst_f32_knot_t* knot = &TESTED_MODEL.knot[k];
        envelope = larger(envelope, larger(magnitude(knot->ascending), magnitude(knot->descending)));
        nonhysteretic = larger(nonhysteretic, magnitude(knot->nonhysteretic));
        if (k + 1 < TESTED_MODEL.num_knots) {
            slope = larger(slope, larger(knot->ascending_slope, knot->descending_slope));
            nonhysteretic_slope = larger(nonhysteretic_slope, knot->nonhysteretic_slope);
        }
    }
    const hyst_f32_play_t* last = &TESTED_MODEL.play[TESTED_MODEL.num_plays - 1];
    const float weights = last->slope;
    const float terms =
        magnitude(TESTED_MODEL.constant) + nonhysteretic + weights * (envelope + last->opening);
    const float input = larger(magnitude(TESTED_MODEL.input_min), magnitude(TESTED_MODEL.input_max)) +
                        (TESTED_MODEL.input_max - TESTED_MODEL.input_min);
    return FLT_EPSILON * (2.0f * (11.0f * (float)TESTED_MODEL.num_plays + 20.0f) * terms +
                          5.0f * (weights * slope + nonhysteretic_slope) * input);
}

/// Follows wanted outputs over all that can be reached, each answer committed: smooth ones, then jumps.
static bool check_round_trip(void)
{
    const float high =
        hyst_f32_reset(&TESTED_MODEL, &state, HYST_START_POSITIVE_SATURATION, TESTED_MODEL.input_max);
    const float low =
        hyst_f32_reset(&TESTED_MODEL, &state, HYST_START_NEGATIVE_SATURATION, TESTED_MODEL.input_min);
    const float bound = round_trip_bound();
    float worst = 0.0f;
    uint32_t seed = 1;
    uint32_t num_clamped = 0;
    for (uint32_t i = 0; i < NUM_INVERSE; ++i) {
        const float part = i < NUM_INVERSE / 2 ? signal_smooth(i, 7) : signal_random(&seed);
        const float wanted = within(low, high, part);
        const hyst_f32_inverse_t found = hyst_f32_inverse(&TESTED_MODEL, &state, wanted);
        num_clamped += found.clamped ? 1u : 0u;
        worst = larger(worst, magnitude(hyst_f32_step(&TESTED_MODEL, &state, found.input) - wanted));
    }
    const bool passed = report("round trip: ", worst <= bound && num_clamped == 0);
    port_print(", largest error ");
    print_error(worst);
    port_print(", bound ");
    print_error(bound);
    port_print("\n");
    return passed;
}

/// One number for every bit of a long run: equal on host and target.
static void print_checksum(void)
{
    uint32_t sum = CHECKSUM_START;
    uint32_t seed = 2;
    (void)hyst_f32_reset(&TESTED_MODEL, &state, HYST_START_DEMAGNETISED, TESTED_MODEL.input_min);
    for (uint32_t i = 0; i < NUM_FORWARD; ++i) {
        const float part = i % 1000 < 500 ? signal_smooth(i, 3) : signal_random(&seed);
        sum = checksum_add(sum, float_bits(hyst_f32_step(&TESTED_MODEL, &state, input_at(part))));
    }
    for (uint32_t i = 0; i < NUM_INVERSE; ++i) {
        const hyst_f32_reach_t reach = hyst_f32_reachable(&TESTED_MODEL, &state);
        const float wanted = within(reach.reachable_min, reach.reachable_max, signal_random(&seed));
        const hyst_f32_inverse_t found = hyst_f32_inverse(&TESTED_MODEL, &state, wanted);
        sum = checksum_add(sum, float_bits(found.input));
        sum = checksum_add(sum, float_bits(hyst_f32_step(&TESTED_MODEL, &state, found.input)));
    }
    port_print("checksum:   ");
    print_hex(sum);
    port_print(" over 20000 forward steps and 2000 inverses\n");
}

static uint32_t count_empty(void)
{
    port_count_start();
    for (uint32_t i = 0; i < NUM_TIMED; ++i) {
        sink = timed_input[i];
    }
    return port_count_instructions();
}

static uint32_t count_forward(void)
{
    (void)hyst_f32_reset(&TESTED_MODEL, &state, HYST_START_NEGATIVE_SATURATION, timed_input[0]);
    port_count_start();
    for (uint32_t i = 0; i < NUM_TIMED; ++i) {
        sink = hyst_f32_step(&TESTED_MODEL, &state, timed_input[i]);
    }
    return port_count_instructions();
}

/// Inverse and commit; leaves the inputs that were applied in timed_input.
static uint32_t count_inverse_and_forward(void)
{
    (void)hyst_f32_reset(&TESTED_MODEL, &state, HYST_START_NEGATIVE_SATURATION, timed_input[0]);
    port_count_start();
    for (uint32_t i = 0; i < NUM_TIMED; ++i) {
        const hyst_f32_inverse_t found = hyst_f32_inverse(&TESTED_MODEL, &state, timed_wanted[i]);
        timed_input[i] = found.input;
        sink = hyst_f32_step(&TESTED_MODEL, &state, found.input);
    }
    return port_count_instructions();
}

static void print_counts(const char* what)
{
    const uint32_t empty = count_empty();
    const uint32_t forward = count_forward() - empty;
    (void)hyst_f32_reset(&TESTED_MODEL, &state, HYST_START_NEGATIVE_SATURATION, timed_input[0]);
    for (uint32_t i = 0; i < NUM_TIMED; ++i) {
        timed_wanted[i] = hyst_f32_step(&TESTED_MODEL, &state, timed_input[i]);
    }
    const uint32_t both = count_inverse_and_forward();
    const uint32_t same_forward = count_forward();
    port_print(what);
    if (both == 0) {
        port_print("instructions not measured on the host\n");
        return;
    }
    port_print("forward ");
    print_unsigned(forward / NUM_TIMED);
    port_print(", inverse ");
    print_unsigned((both - same_forward) / NUM_TIMED);
    port_print(" instructions a sample\n");
}

static void measure(void)
{
    for (uint32_t i = 0; i < NUM_TIMED; ++i) {
        timed_input[i] = input_at(signal_smooth(i, 3));
    }
    print_counts("smooth:     ");
    uint32_t seed = 3;
    for (uint32_t i = 0; i < NUM_TIMED; ++i) {
        timed_input[i] = input_at(signal_random(&seed));
    }
    print_counts("jumps:      ");
}

int main(void)
{
    if (!check_model()) {
        return 1;
    }
    const bool golden_passed = check_golden();
    const bool round_trip_passed = check_round_trip();
    print_checksum();
    measure();
    (void)report("result:     ", golden_passed && round_trip_passed);
    port_print("\n");
    return golden_passed && round_trip_passed ? 0 : 1;
}
