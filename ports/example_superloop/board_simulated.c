#include "actuator.h"
#include "board.h"

static hyst_f32_state_t plant;
static hyst_f32_segment_t memory[ACTUATOR_NUM_PLAYS];

/// The actuator in place of a real one: the model itself, but with a past that the firmware does not know.
static void put_actuator_into_unknown_state(void)
{
    if (plant.memory == NULL &&
        hyst_f32_init(&actuator_model, &plant, memory, ACTUATOR_NUM_PLAYS) == HYST_STATUS_OK) {
        (void)hyst_f32_reset(&actuator_model, &plant, HYST_START_POSITIVE_SATURATION, ACTUATOR_INPUT_MIN);
    }
}

void board_drive(const float input)
{
    put_actuator_into_unknown_state();
    (void)hyst_f32_step(&actuator_model, &plant, input);
}

float board_position(void)
{
    return plant.output;
}
