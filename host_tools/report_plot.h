/// Line and scatter plots as SVG, drawn by gnuplot.
#ifndef HYST_HOST_REPORT_PLOT_H
#define HYST_HOST_REPORT_PLOT_H

#include "message.h"
#include <stdio.h>

typedef struct {
    const char* legend;
    const char* colour; ///< "#rrggbb", legible on light and dark
    double width;       ///< of a line, or a point's size
    const double* x;    ///< [num_samples] finite
    const double* y;    ///< [num_samples] finite
} plot_series_t;

typedef struct {
    const char* id; ///< letters only, for the names within the SVG
    const char* x_label;
    const char* y_label; ///< labels may be any text
    int width, height;   ///< of the drawing's coordinates
    bool points;         ///< else lines
    double y_limit;      ///< the frame's -limit ... limit; 0: all that is drawn
    size_t num_samples;
    size_t num_series;
    const plot_series_t* series;
} plot_t;

/// Whether gnuplot can be run; else OUTCOME_IO with what to install.
outcome_t plot_check(void);
/// Appends an <svg> element. Each series is thinned to PLOT_MOST_POINTS, with the least and the largest y of
/// every stretch kept. OUTCOME_IO with gnuplot's message when it fails.
outcome_t plot_svg(const plot_t* plot, FILE* out);

enum { PLOT_MOST_POINTS = 2000 };

#endif
