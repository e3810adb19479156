/// Firmware that proves a generated fixed-point model on the machine it runs on; the same source runs on the
/// host. MODEL_SCALAR: q31 or q15; MODEL_NUMBER: its inputs' and outputs' type.
#include "self_test_model.h"

#include "float_bits.h"
#include "port.h"
#include "print.h"
#include "test_signal.h"

#define JOIN_EXPANDED(scalar, name) hyst_##scalar##_##name
#define JOIN(scalar, name)          JOIN_EXPANDED(scalar, name)
#define SCALAR(name)                JOIN(MODEL_SCALAR, name)

enum { NUM_FORWARD = 20000, NUM_INVERSE = 2000 };

static SCALAR(segment_t) memory[TESTED_MODEL_NUM_PLAYS];
static SCALAR(state_t) state;

static bool report(const char* what, const bool passed)
{
    port_print(what);
    port_print(passed ? "pass" : "FAIL");
    return passed;
}

/// 64 bits, since the range's width may need 33.
static MODEL_NUMBER input_at(const float part)
{
    const int64_t width = (int64_t)TESTED_MODEL.input_max - TESTED_MODEL.input_min;
    const int64_t along = (int64_t)(part * (float)width);
    return (MODEL_NUMBER)(TESTED_MODEL.input_min + (along < width ? along : width));
}

static bool check_model(void)
{
    const hyst_status_t status = SCALAR(init)(&TESTED_MODEL, &state, memory, TESTED_MODEL_NUM_PLAYS);
    const bool passed = report("model:      ", status == HYST_STATUS_OK);
    port_print(", " TESTED_MODEL_NAME ", ");
    print_unsigned(TESTED_MODEL.num_plays);
    port_print(" plays, RAM ");
    print_unsigned((uint32_t)(sizeof state + sizeof memory));
    port_print(" bytes\n");
    if (!passed) {
        port_print(hyst_status_text(status));
        port_print("\n");
    }
    return passed;
}

static bool check_golden(void)
{
    const bool passed = report(
        "self-test:  ", SCALAR(self_test)(&TESTED_MODEL, &state, &TESTED_MODEL_GOLDEN) == HYST_STATUS_OK);
    port_print(", ");
    print_unsigned(TESTED_MODEL_GOLDEN.num_steps);
    port_print(" golden vectors\n");
    return passed;
}

/// The output that `input` would give, looked at by stepping and putting the past back.
static MODEL_NUMBER output_of(const MODEL_NUMBER input)
{
    static SCALAR(segment_t) kept[TESTED_MODEL_NUM_PLAYS];
    const SCALAR(state_t) before = state;
    for (uint32_t j = 0; j < TESTED_MODEL_NUM_PLAYS; ++j) {
        kept[j] = memory[j];
    }
    const MODEL_NUMBER output = SCALAR(step)(&TESTED_MODEL, &state, input);
    state = before;
    for (uint32_t j = 0; j < TESTED_MODEL_NUM_PLAYS; ++j) {
        memory[j] = kept[j];
    }
    return output;
}

/// The inverse answers with the nearest output there is: one that some input gives must come back exactly.
/// Every number goes into the checksum.
static bool check_long_run(void)
{
    uint32_t sum = CHECKSUM_START;
    uint32_t seed = 2;
    (void)SCALAR(reset)(&TESTED_MODEL, &state, HYST_START_DEMAGNETISED, TESTED_MODEL.input_min);
    for (uint32_t i = 0; i < NUM_FORWARD; ++i) {
        const float part = i % 1000 < 500 ? signal_smooth(i, 3) : signal_random(&seed);
        sum = checksum_add(sum, (uint32_t)SCALAR(step)(&TESTED_MODEL, &state, input_at(part)));
    }
    bool exact = true;
    for (uint32_t i = 0; i < NUM_INVERSE; ++i) {
        const MODEL_NUMBER wanted = output_of(input_at(signal_random(&seed)));
        const SCALAR(inverse_t) found = SCALAR(inverse)(&TESTED_MODEL, &state, wanted);
        const MODEL_NUMBER output = SCALAR(step)(&TESTED_MODEL, &state, found.input);
        exact = exact && output == wanted && !found.clamped;
        sum = checksum_add(sum, (uint32_t)found.input);
        sum = checksum_add(sum, (uint32_t)output);
    }
    (void)report("round trip: ", exact);
    port_print("\nchecksum:   ");
    print_hex(sum);
    port_print(" over 20000 forward steps and 2000 inverses\n");
    return exact;
}

int main(void)
{
    if (!check_model()) {
        return 1;
    }
    const bool golden_passed = check_golden();
    const bool run_passed = check_long_run();
    (void)report("result:     ", golden_passed && run_passed);
    port_print("\n");
    return golden_passed && run_passed ? 0 : 1;
}
