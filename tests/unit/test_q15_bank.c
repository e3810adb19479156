#define HYST_Q_BITS 16
#include "q_bank_tests.h"
