#define HYST_Q_BITS 32
#include "q_homing_tests.h"
