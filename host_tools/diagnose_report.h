/// The diagnosis as one self-contained HTML file with plots.
#ifndef HYST_HOST_DIAGNOSE_REPORT_H
#define HYST_HOST_DIAGNOSE_REPORT_H

#include "diagnose.h"
#include "diagnose_budget.h"

typedef struct {
    const model_t* model;
    const char* model_path; ///< as given, for the heading
    const char* record_path;
    const effect_run_t* run; ///< over the record
    const double* measured;  ///< [run->num_samples]
    const diagnosis_t* diagnosis;
    const budget_t* budget; ///< or NULL
} report_t;

/// Written whole or not at all; "-" is stdout. OUTCOME_IO (reported) without gnuplot, or when the file cannot
/// be written.
outcome_t report_write(const char* path, const report_t* report);

#endif
