#define HYST_Q_BITS 32
#include "hyst_q_seal.h"
