/// Test signals in [0, 1], the same bits everywhere: no libm.
#ifndef HYST_PORT_TEST_SIGNAL_H
#define HYST_PORT_TEST_SIGNAL_H

#include <stdint.h>

/// Two incommensurate waves of parabolas, `rate` times 1/2048 of a period per sample: nested loops of all
/// sizes.
float signal_smooth(uint32_t index, uint32_t rate);
/// Uniform jumps from a linear congruential generator, which is advanced.
float signal_random(uint32_t* seed);

#endif
