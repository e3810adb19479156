#include "effect.h"
#include "effect_catalogue.h"
#include <string.h>

/// In the contract's order, in which a run applies them within a stage.
static const effect_t* const catalogue[] = {
    &effect_gain_offset,
    &effect_delay,
    &effect_delay_measurement,
    &effect_input_lag,
    &effect_slew_limit,
    &effect_rate_dependence_play_lag,
    &effect_rate_dependence_widening,
    &effect_rate_dependence_diffusion,
    &effect_rate_dependence_excess,
    &effect_creep_additional,
    &effect_creep_delayed,
    &effect_creep_power_law,
    &effect_noncongruency_product,
    &effect_noncongruency_moving,
    &effect_noncongruency_increment,
    &effect_noncongruency_remanence_field,
    &effect_noncongruency_remanence_stiffness,
    &effect_wear_amplitude,
    &effect_wear_increment,
    &effect_wear_response,
    &effect_self_heating_losses,
    &effect_self_heating_friction,
    &effect_initial_state,
    &effect_initial_state_turning_points,
    &effect_output_lag,
    &effect_resonance,
    &effect_backlash,
    &effect_output_saturation,
    &effect_output_nonlinearity_polynomial,
    &effect_output_nonlinearity_two_point,
    &effect_drift_linear,
    &effect_drift_spline,
    &effect_drift_fine_spline,
    &effect_drift_finest_spline,
    &effect_drift_dense_spline,
    &effect_periodic_disturbance,
    &effect_periodic_disturbance_run_up,
    &effect_quantization,
    &effect_exogenous,
    &effect_exogenous_coercive_field,
};

size_t effect_count(void)
{
    return sizeof catalogue / sizeof catalogue[0];
}

const effect_t* effect_at(size_t index)
{
    return catalogue[index];
}

bool effect_is_known(const char* name)
{
    for (size_t i = 0; i < effect_count(); ++i) {
        if (strcmp(catalogue[i]->name, name) == 0) {
            return true;
        }
    }
    return strcmp(name, "unknown") == 0;
}
