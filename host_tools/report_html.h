/// Pieces of HTML that the report is made of.
#ifndef HYST_HOST_REPORT_HTML_H
#define HYST_HOST_REPORT_HTML_H

#include <stdio.h>

/// Everything up to the opening of <main>, with the style for light and dark.
void html_begin(FILE* out, const char* title);
void html_end(FILE* out);
/// Any text, as text.
void html_text(FILE* out, const char* text);
/// <TAG>text</TAG>.
void html_element(FILE* out, const char* tag, const char* text);

/// A bar on a track that stands for 0 ... 1: filled from `from` to `to`, with a whisker from `low` to `high`
/// when low <= high. What lies beyond the track is cut off.
typedef struct {
    double from, to;
    double low, high;
    const char* kind; ///< "share", "probability", "shrink" or "negative": its colour
} html_bar_t;
void html_bar(FILE* out, const html_bar_t* bar);

#endif
