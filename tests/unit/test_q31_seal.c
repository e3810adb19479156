#define HYST_Q_BITS 32
#include "q_seal_tests.h"
