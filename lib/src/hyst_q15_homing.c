#define HYST_Q_BITS 16
#include "hyst_q_homing.h"
