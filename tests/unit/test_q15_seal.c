#define HYST_Q_BITS 16
#include "q_seal_tests.h"
