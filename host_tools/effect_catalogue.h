/// Every effect there is; effect.c holds their order.
#ifndef HYST_HOST_EFFECT_CATALOGUE_H
#define HYST_HOST_EFFECT_CATALOGUE_H

#include "effect.h"

extern const effect_t effect_gain_offset;
extern const effect_t effect_delay;
extern const effect_t effect_delay_measurement;
extern const effect_t effect_input_lag;
extern const effect_t effect_slew_limit;
extern const effect_t effect_rate_dependence_play_lag;
extern const effect_t effect_rate_dependence_widening;
extern const effect_t effect_rate_dependence_diffusion;
extern const effect_t effect_rate_dependence_excess;
extern const effect_t effect_creep_additional;
extern const effect_t effect_creep_delayed;
extern const effect_t effect_creep_power_law;
extern const effect_t effect_noncongruency_increment;
extern const effect_t effect_noncongruency_product;
extern const effect_t effect_noncongruency_moving;
extern const effect_t effect_noncongruency_remanence_field;
extern const effect_t effect_noncongruency_remanence_stiffness;
extern const effect_t effect_wear_increment;
extern const effect_t effect_wear_amplitude;
extern const effect_t effect_wear_response;
extern const effect_t effect_self_heating_losses;
extern const effect_t effect_self_heating_friction;
extern const effect_t effect_initial_state;
extern const effect_t effect_initial_state_turning_points;
extern const effect_t effect_output_lag;
extern const effect_t effect_resonance;
extern const effect_t effect_backlash;
extern const effect_t effect_output_saturation;
extern const effect_t effect_output_nonlinearity_polynomial;
extern const effect_t effect_output_nonlinearity_two_point;
extern const effect_t effect_drift_linear;
extern const effect_t effect_drift_spline;
extern const effect_t effect_drift_fine_spline;
extern const effect_t effect_drift_finest_spline;
extern const effect_t effect_drift_dense_spline;
extern const effect_t effect_periodic_disturbance;
extern const effect_t effect_periodic_disturbance_run_up;
extern const effect_t effect_quantization;
extern const effect_t effect_exogenous;
extern const effect_t effect_exogenous_coercive_field;

#endif
