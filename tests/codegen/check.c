// Compiled as C and as C++ against a generated header (symbol `subject`) of the scalar SCALAR, and lib/:
//   check            runs the self-test
//   check inputs     prints a record to simulate
//   check compare    reads the simulated record from stdin and compares it with the firmware's outputs
#include HEADER
#include <stdio.h>
#include <string.h>

enum { NUM_SAMPLES = 4000 };

#define JOIN(prefix, scalar, name)   prefix##scalar##_##name
#define EXPAND(prefix, scalar, name) JOIN(prefix, scalar, name)
#define HYST(name)                   EXPAND(hyst_, SCALAR, name)

#ifdef SCALAR_f32
typedef float real_t;
static const double rounding_error = (double)SUBJECT_FLOAT_ERROR;
#else
#ifdef SCALAR_q31
typedef double real_t;
#else
typedef float real_t;
#endif
static const double rounding_error = (double)SUBJECT_QUANTIZATION_ERROR;
#endif

static HYST(segment_t) memory[SUBJECT_NUM_PLAYS];
static HYST(state_t) state;

/// In units, in and out.
static double output_at(real_t input)
{
#ifdef SCALAR_f32
    return (double)hyst_f32_step(&subject_model, &state, input);
#else
    return (double)subject_output_to_units(
        HYST(step)(&subject_model, &state, subject_input_from_units(input)));
#endif
}

static real_t sample(unsigned i)
{
    // A linear congruential walk: large jumps, small steps, and the range's ends.
    static unsigned long seed = 1;
    static float position = 0.0f;
    seed = (seed * 1103515245UL + 12345UL) & 0x7FFFFFFFUL;
    const float unit = (float)(seed >> 8) / 8388608.0f;
    position = i % 7 == 0 ? unit : position + 0.05f * (unit - 0.5f);
    if (i % 50 == 0) {
        position = i % 100 == 0 ? 1.0f : 0.0f;
    }
    position = position < 0.0f ? 0.0f : position;
    position = position > 1.0f ? 1.0f : position;
    const real_t input = SUBJECT_INPUT_MIN + position * (SUBJECT_INPUT_MAX - SUBJECT_INPUT_MIN);
    return input < SUBJECT_INPUT_MAX ? input : SUBJECT_INPUT_MAX;
}

static int print_inputs(void)
{
    puts("time,input");
    for (unsigned i = 0; i < NUM_SAMPLES; ++i) {
        printf("%u,%.17g\n", i, (double)sample(i));
    }
    return 0;
}

static int compare(void)
{
    char line[200];
    double largest = 0.0;
    // The record holds 15 digits.
    const double allowed = (double)SUBJECT_TABLE_ERROR + rounding_error + 1e-12;
    if (fgets(line, sizeof line, stdin) == NULL || strcmp(line, "time,input,output\n") != 0) {
        return 1;
    }
    for (unsigned i = 0; i < NUM_SAMPLES; ++i) {
        double time;
        double input;
        double output;
        if (scanf("%lf,%lf,%lf", &time, &input, &output) != 3) {
            return 1;
        }
        const double difference = output_at(sample(i)) - output;
        const double magnitude = difference < 0.0 ? -difference : difference;
        largest = magnitude > largest ? magnitude : largest;
        if (!(magnitude <= allowed)) {
            printf("sample %u: off by %g, allowed %g\n", i, magnitude, allowed);
            return 1;
        }
    }
    printf("largest difference %.3g of %.3g allowed\n", largest, allowed);
    return 0;
}

int main(int argc, char** argv)
{
    const hyst_status_t status = HYST(init)(&subject_model, &state, memory, SUBJECT_NUM_PLAYS);
    if (status != HYST_STATUS_OK) {
        puts(hyst_status_text(status));
        return 1;
    }
    if (argc > 1 && strcmp(argv[1], "inputs") == 0) {
        return print_inputs();
    }
    if (argc > 1 && strcmp(argv[1], "compare") == 0) {
        return compare();
    }
    if (sizeof(void*) == 4 && sizeof state + sizeof memory != SUBJECT_RAM_BYTES) {
        puts("SUBJECT_RAM_BYTES is wrong");
        return 1;
    }
    return (int)HYST(self_test)(&subject_model, &state, &subject_golden);
}
