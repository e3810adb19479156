/// The smallest firmware: an actuator with hysteresis is homed and then driven along a path by its inverse
/// model, in a timer interrupt; the super-loop takes snapshots for a restart. It ends after a while, so that
/// a test can run it.
#include "actuator.h" // hyst emit actuator.json --symbol actuator -o actuator.h
#include "board.h"
#include "hyst/hyst_f32_homing.h"
#include "hyst/hyst_f32_seal.h"
#include "port.h"
#include "print.h"
#include "test_signal.h"

enum {
    PERIOD_US = 500,
    HOMING_CYCLES = 20,
    NUM_SAMPLES = 2000,
    SNAPSHOT = HYST_F32_SEALED_WORDS(ACTUATOR_NUM_PLAYS)
};

static hyst_f32_segment_t memory[ACTUATOR_NUM_PLAYS];
static hyst_f32_state_t state;
static hyst_f32_homing_t homing;
static hyst_word_t snapshot[SNAPSHOT];
static volatile uint32_t num_samples;
static volatile float worst_error;

/// A smooth path over the outputs that can be reached from anywhere: between the two saturations' nearer
/// ends.
static float wanted_at(const uint32_t sample)
{
    static float low, high;
    if (sample == 0) {
        const hyst_f32_reach_t reach = hyst_f32_reachable(&actuator_model, &state);
        low = reach.reachable_min;
        high = reach.reachable_max;
    }
    return low + signal_smooth(sample, 7) * (high - low);
}

void timer_interrupt(void)
{
    float input;
    if (hyst_f32_homing_next(&homing, &input)) {
        board_drive(input);
        (void)hyst_f32_step(&actuator_model, &state, input);
        return;
    }
    const float wanted = wanted_at(num_samples);
    const hyst_f32_inverse_t found = hyst_f32_inverse(&actuator_model, &state, wanted);
    board_drive(found.input);
    (void)hyst_f32_step(&actuator_model, &state, found.input); // what was really applied
    const float error = board_position() > wanted ? board_position() - wanted : wanted - board_position();
    if (error > worst_error) {
        worst_error = error;
    }
    ++num_samples;
}

/// The interrupt steps the state: it must not in the middle of this.
static bool take_snapshot(void)
{
    board_mask_interrupts();
    const hyst_status_t status = hyst_f32_seal(&actuator_model, &state, snapshot, SNAPSHOT);
    board_unmask_interrupts();
    return status == HYST_STATUS_OK;
}

int main(void)
{
    if (hyst_f32_init(&actuator_model, &state, memory, ACTUATOR_NUM_PLAYS) != HYST_STATUS_OK ||
        hyst_f32_self_test(&actuator_model, &state, &actuator_golden) != HYST_STATUS_OK ||
        hyst_f32_homing_init(&homing, &actuator_model, HOMING_CYCLES) != HYST_STATUS_OK) {
        port_print("no model to run\n");
        return 1;
    }
    board_start_timer(PERIOD_US);
    bool snapshots_passed = true;
    while (num_samples < NUM_SAMPLES) {
        board_wait();
        snapshots_passed = take_snapshot() && snapshots_passed;
    }
    board_mask_interrupts();
    const bool restored = hyst_f32_unseal(&actuator_model, &state, snapshot, SNAPSHOT) == HYST_STATUS_OK;
    // What driving by the inverse adds must not show beside the error of the model's own table.
    const bool followed = worst_error <= ACTUATOR_TABLE_ERROR;
    port_print("largest error on the path: ");
    print_error(worst_error);
    port_print(snapshots_passed && restored ? "\nsnapshots: pass\n" : "\nsnapshots: FAIL\n");
    port_print(followed ? "path: pass\n" : "path: FAIL\n");
    return followed && snapshots_passed && restored ? 0 : 1;
}
