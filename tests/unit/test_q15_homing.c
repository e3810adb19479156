#define HYST_Q_BITS 16
#include "q_homing_tests.h"
