#define HYST_Q_BITS 32
#include "q_bank_tests.h"
