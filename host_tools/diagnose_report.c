#include "diagnose_report.h"

#include "diagnose_text.h"
#include "output_file.h"
#include "report_html.h"
#include "report_plot.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Legible on light and dark.
static const char measured_colour[] = "#8b919b";
static const char before_colour[] = "#d9822b";
static const char after_colour[] = "#2f8fd8";

static const char before_legend[] = "model";
static const char after_legend[] = "model with effect";

enum { MOST_CAUSES = 8 };

/// What a run's plots are drawn from, each [num_samples].
typedef struct {
    const report_t* report;
    const double* before;
    const double* after; ///< NULL when the verdict names no effect
    double* residual_before;
    double* residual_after; ///< NULL likewise
    double* rate;           ///< |d input/dt|
    FILE* out;
} drawing_t;

static const hypothesis_t* verdict_of(const diagnosis_t* d)
{
    const hypothesis_t* verdict = d->cause[0].hypothesis;
    return d->is_unknown || verdict->num_uses == 0 ? NULL : verdict;
}

static void with_unit(const char* what, const char* unit, const char* per, char* text, size_t size)
{
    const bool has_unit = unit[0] != '\0' || per[0] != '\0';
    (void)snprintf(text, size, has_unit ? "%s [%s%s]" : "%s", what, unit[0] != '\0' ? unit : "1", per);
}

static double* difference_of(const double* a, const double* b, size_t n)
{
    double* difference = xmalloc(n * sizeof *difference);
    for (size_t t = 0; t < n; t++) {
        difference[t] = a[t] - b[t];
    }
    return difference;
}

static double* rate_of(const effect_run_t* run)
{
    double* rate = xmalloc(run->num_samples * sizeof *rate);
    for (size_t t = 0; t < run->num_samples; t++) {
        const size_t before = t > 0 ? t - 1 : 0;
        const size_t after = t + 1 < run->num_samples ? t + 1 : t;
        rate[t] = fabs((run->input[after] - run->input[before]) / (run->time[after] - run->time[before]));
    }
    return rate;
}

static drawing_t drawing_new(const report_t* report, FILE* out)
{
    const size_t n = report->run->num_samples;
    const hypothesis_t* verdict = verdict_of(report->diagnosis);
    drawing_t drawing = {.report = report,
                         .before = report->diagnosis->before,
                         .after = verdict != NULL ? report->diagnosis->after : NULL,
                         .rate = rate_of(report->run),
                         .out = out};
    drawing.residual_before = difference_of(report->measured, drawing.before, n);
    drawing.residual_after = drawing.after != NULL ? difference_of(report->measured, drawing.after, n) : NULL;
    return drawing;
}

static void drawing_free(drawing_t* drawing)
{
    free(drawing->residual_before);
    free(drawing->residual_after);
    free(drawing->rate);
    *drawing = (drawing_t){0};
}

static outcome_t draw(const drawing_t* drawing, plot_t plot, const plot_series_t* series, size_t count)
{
    plot.series = series;
    plot.num_series = count;
    plot.num_samples = drawing->report->run->num_samples;
    fputs("<figure>", drawing->out);
    const outcome_t outcome = plot_svg(&plot, drawing->out);
    fputs("</figure>\n", drawing->out);
    return outcome;
}

/// The measured output's line is broad, so that a model that meets it lies within.
static plot_series_t measured_series(const drawing_t* drawing, const double* x)
{
    return (plot_series_t){"measured", measured_colour, 3.5, x, drawing->report->measured};
}

static outcome_t draw_over_time(const drawing_t* drawing, const char* output)
{
    const plot_t plot = {
        .id = "overTime", .x_label = "time [s]", .y_label = output, .width = 1000, .height = 330};
    const double* time = drawing->report->run->time;
    const plot_series_t series[] = {measured_series(drawing, time),
                                    {before_legend, before_colour, 1.3, time, drawing->before},
                                    {after_legend, after_colour, 1.3, time, drawing->after}};
    return draw(drawing, plot, series, drawing->after != NULL ? 3 : 2);
}

/// Beside each other: the model as it is, and with the verdict's effects.
static outcome_t draw_loops(const drawing_t* drawing, const char* input, const char* output)
{
    // Thinned to few of many samples, a path's points no longer follow each other along a loop.
    const bool points = drawing->report->run->num_samples > 5 * (size_t)PLOT_MOST_POINTS;
    plot_t plot = {.id = "loopsBefore",
                   .x_label = input,
                   .y_label = output,
                   .width = drawing->after != NULL ? 500 : 1000,
                   .height = 400,
                   .points = points};
    const double* x = drawing->report->run->input;
    plot_series_t series[] = {measured_series(drawing, x),
                              {before_legend, before_colour, points ? 0.25 : 1, x, drawing->before}};
    series[0].width = points ? 0.4 : 2.5;
    fputs(drawing->after != NULL ? "<div class=\"two\">\n" : "<div>\n", drawing->out);
    outcome_t outcome = draw(drawing, plot, series, 2);
    if (outcome == OUTCOME_OK && drawing->after != NULL) {
        plot.id = "loopsAfter";
        series[1] = (plot_series_t){after_legend, after_colour, series[1].width, x, drawing->after};
        outcome = draw(drawing, plot, series, 2);
    }
    fputs("</div>\n", drawing->out);
    return outcome;
}

static int by_size(const void* a, const void* b)
{
    const double x = fabs(*(const double*)a);
    const double y = fabs(*(const double*)b);
    return (x > y) - (x < y);
}

/// The frame of the residuals: a start that the model knows nothing of, or a spike, must not flatten all the
/// rest. 0 when nothing is far beyond the 99.5 % of the plain model's residuals; *beyond: how many are.
static double residual_limit(const drawing_t* drawing, size_t* beyond)
{
    const size_t n = drawing->report->run->num_samples;
    double* sorted = xmalloc(n * sizeof *sorted);
    memcpy(sorted, drawing->residual_before, n * sizeof *sorted);
    qsort(sorted, n, sizeof *sorted, by_size);
    const double limit = 1.5 * fabs(sorted[n - 1 - n / 200]);
    const bool is_far = fabs(sorted[n - 1]) > 2 * limit;
    *beyond = 0;
    for (size_t t = n; is_far && t > 0 && fabs(sorted[t - 1]) > limit; t--) {
        *beyond += 1;
    }
    free(sorted);
    return is_far ? limit : 0;
}

static outcome_t draw_residuals(const drawing_t* drawing, const plot_t* plot, const double* x)
{
    const plot_series_t series[] = {
        {before_legend, before_colour, plot->points ? 0.25 : 1.3, x, drawing->residual_before},
        {after_legend, after_colour, plot->points ? 0.25 : 1.3, x, drawing->residual_after}};
    return draw(drawing, *plot, series, drawing->after != NULL ? 2 : 1);
}

static outcome_t draw_plots(const drawing_t* drawing)
{
    enum { LABEL = 200 };
    const report_t* report = drawing->report;
    char input[LABEL];
    char output[LABEL];
    char rate[LABEL];
    char residual[LABEL];
    with_unit("input", report->model->input_unit, "", input, sizeof input);
    with_unit("output", report->model->output_unit, "", output, sizeof output);
    with_unit("|d input/dt|", report->model->input_unit, "/s", rate, sizeof rate);
    with_unit("measured - model", report->model->output_unit, "", residual, sizeof residual);
    plot_t residuals = {
        .id = "residualTime", .x_label = "time [s]", .y_label = residual, .width = 1000, .height = 280};
    size_t beyond = 0;
    residuals.y_limit = residual_limit(drawing, &beyond);
    html_element(drawing->out, "h2", "Measured against model");
    outcome_t outcome = draw_over_time(drawing, output);
    if (outcome == OUTCOME_OK) {
        outcome = draw_loops(drawing, input, output);
    }
    html_element(drawing->out, "h2", "Residual");
    if (outcome == OUTCOME_OK) {
        outcome = draw_residuals(drawing, &residuals, report->run->time);
    }
    if (beyond > 0) {
        fprintf(drawing->out, "<p class=\"soft\">%zu of the model's residuals lie beyond the frame.</p>\n",
                beyond);
    }
    fputs("<div class=\"two\">\n", drawing->out);
    residuals.id = "residualInput";
    residuals.x_label = input;
    residuals.width = 500;
    residuals.height = 320;
    residuals.points = true;
    if (outcome == OUTCOME_OK) {
        outcome = draw_residuals(drawing, &residuals, report->run->input);
    }
    residuals.id = "residualRate";
    residuals.x_label = rate;
    if (outcome == OUTCOME_OK) {
        outcome = draw_residuals(drawing, &residuals, drawing->rate);
    }
    fputs("</div>\n", drawing->out);
    return outcome;
}

static void put_head(const report_t* report, FILE* out)
{
    const diagnosis_t* d = report->diagnosis;
    char text[1200];
    html_element(out, "h1", "Diagnosis of the gap between model and record");
    fputs("<p class=\"soft\">model ", out);
    html_text(out, report->model_path);
    fputs(" · record ", out);
    html_text(out, report->record_path);
    fprintf(out, " · %zu samples, %.4g s</p>\n<div class=\"lead\">", report->run->num_samples,
            report->run->duration);
    text_summary(d, report->model->output_unit, text, sizeof text);
    html_element(out, "p", text);
    if (d->num_indistinguishable > 0) {
        fputs("<p class=\"soft\">This record cannot tell it from: ", out);
        for (size_t k = 0; k < d->num_indistinguishable; k++) {
            text_names(d->cause[d->indistinguishable[k]].hypothesis, text, sizeof text);
            fputs(k > 0 ? "; " : "", out);
            html_text(out, text);
        }
        fputs(".</p>", out);
    }
    if (d->advice[0] != '\0') {
        fputs("<p class=\"soft\">Next: ", out);
        html_text(out, d->advice);
        fputs(".</p>", out);
    }
    fputs("</div>\n", out);
}

static int by_axis(const void* a, const void* b)
{
    const region_t* x = a;
    const region_t* y = b;
    return x->axis != y->axis ? (x->axis > y->axis) - (x->axis < y->axis)
                              : (x->share < y->share) - (x->share > y->share);
}

static void put_where(const report_t* report, FILE* out)
{
    const diagnosis_t* d = report->diagnosis;
    if (d->num_regions == 0) {
        return;
    }
    region_t region[WHERE_MAX_REGIONS];
    memcpy(region, d->region, d->num_regions * sizeof region[0]);
    qsort(region, d->num_regions, sizeof region[0], by_axis);
    html_element(out, "h2", "Where the gap lies");
    fputs("<div class=\"wide\"><table><tr><th>axis</th><th>region</th><th>share of the gap's energy, 90 % "
          "interval</th><th class=\"n\">share</th><th class=\"n\">lift</th></tr>\n",
          out);
    for (size_t i = 0; i < d->num_regions; i++) {
        char text[300];
        where_describe(&region[i], report->model->input_unit, report->model->output_unit, text, sizeof text);
        const bool is_new = i == 0 || region[i].axis != region[i - 1].axis;
        fprintf(out, "<tr><td>%s</td><td>", is_new ? where_axis_name(region[i].axis) : "");
        html_text(out, text);
        fputs("</td><td>", out);
        html_bar(out, &(html_bar_t){0, region[i].share, region[i].share_low, region[i].share_high, "share"});
        fprintf(out, "</td><td class=\"n\">%.0f %%</td><td class=\"n\">%.2g</td></tr>\n",
                100 * region[i].share, region[i].lift);
    }
    fputs("</table></div>\n", out);
}

static void put_causes(const report_t* report, FILE* out)
{
    const diagnosis_t* d = report->diagnosis;
    html_element(out, "h2", "Candidates");
    fputs("<div class=\"wide\"><table><tr><th>effects</th><th>probability</th><th "
          "class=\"n\"></th><th>predicted "
          "shrink, 90 % interval</th><th class=\"n\"></th><th class=\"n\">error left",
          out);
    if (report->model->output_unit[0] != '\0') {
        fputs(" [", out);
        html_text(out, report->model->output_unit);
        fputs("]", out);
    }
    fputs("</th></tr>\n", out);
    for (size_t k = 0; k < d->num_causes && k < MOST_CAUSES; k++) {
        const cause_t* cause = &d->cause[k];
        char names[400];
        text_names(cause->hypothesis, names, sizeof names);
        fputs("<tr><td>", out);
        html_text(out, names);
        fputs("</td><td>", out);
        html_bar(out, &(html_bar_t){0, cause->probability, 1, 0, "probability"});
        fprintf(out, "</td><td class=\"n\">%.1f %%</td><td>", 100 * cause->probability);
        html_bar(out, &(html_bar_t){0, cause->shrink, cause->shrink_low, cause->shrink_high, "shrink"});
        fprintf(out, "</td><td class=\"n\">%.0f %% (%.0f to %.0f)</td><td class=\"n\">%.4g</td></tr>\n",
                100 * cause->shrink, 100 * cause->shrink_low, 100 * cause->shrink_high, cause->rmse_after);
    }
    fputs("</table></div>\n", out);
}

/// A parameter's unit with the model's own for "input" and "output".
static void put_unit(const model_t* model, const char* unit, FILE* out)
{
    while (*unit != '\0') {
        const bool is_input = strncmp(unit, "input", 5) == 0 && model->input_unit[0] != '\0';
        const bool is_output = strncmp(unit, "output", 6) == 0 && model->output_unit[0] != '\0';
        if (is_input || is_output) {
            html_text(out, is_input ? model->input_unit : model->output_unit);
            unit += is_input ? 5 : 6;
        } else {
            const char letter[2] = {*unit, '\0'};
            html_text(out, letter);
            unit++;
        }
    }
}

static void put_parameters(const report_t* report, FILE* out)
{
    const hypothesis_t* verdict = verdict_of(report->diagnosis);
    if (verdict == NULL) {
        return;
    }
    html_element(out, "h2", "Parameters of the verdict");
    fputs("<div class=\"wide\"><table><tr><th>effect</th><th>parameter</th><th class=\"n\">value</th>"
          "<th>unit</th></tr>\n",
          out);
    for (size_t i = 0; i < verdict->num_uses; i++) {
        const effect_use_t* use = &verdict->use[i];
        for (size_t k = 0; k < use->effect->num_parameters; k++) {
            fprintf(out, "<tr><td>%s%s%s ", use->effect->name, use->effect->mechanism != NULL ? ", " : "",
                    use->effect->mechanism != NULL ? use->effect->mechanism : "");
            html_text(out, use->column);
            fprintf(out, "</td><td>%s</td><td class=\"n\">%.6g</td><td>", use->effect->parameter[k].name,
                    use->parameter[k]);
            put_unit(report->model, use->effect->parameter[k].unit, out);
            fputs("</td></tr>\n", out);
        }
    }
    fputs("</table></div>\n", out);
}

static void put_budget_row(FILE* out, const char* name, const char* text, const html_bar_t* bar, double share,
                           const double* rmse)
{
    fprintf(out, "<tr><td>%s</td><td class=\"soft\">%s</td><td>", name, text);
    html_bar(out, bar);
    fprintf(out, "</td><td class=\"n\">%.2f %%</td><td class=\"n\">", 100 * share);
    if (rmse != NULL) {
        fprintf(out, "%.4g", *rmse);
    }
    fputs("</td></tr>\n", out);
}

/// A waterfall: every bar begins where the one before it ended, and the last leads to the total.
static void put_budget(const report_t* report, FILE* out)
{
    const budget_t* budget = report->budget;
    if (budget == NULL) {
        return;
    }
    html_element(out, "h2", "Error budget of the firmware");
    fprintf(out, "<p class=\"soft\">RMS of firmware output less measured output: %.4g%s", budget->total,
            report->model->output_unit[0] != '\0' ? " " : "");
    html_text(out, report->model->output_unit);
    fputs("; shares of its mean square, largest first.</p>\n<div class=\"wide\"><table><tr><th>part</th><th>"
          "</th><th>share</th><th class=\"n\"></th><th class=\"n\">RMS</th></tr>\n",
          out);
    const double scale = fmax(1, 1 - budget->cross_share);
    double reached = 0;
    for (size_t i = 0; i < BUDGET_PARTS; i++) {
        const budget_entry_t* entry = &budget->entry[i];
        const html_bar_t bar = {reached / scale, (reached + entry->share) / scale, 1, 0, "share"};
        put_budget_row(out, budget_part_name(entry->part), budget_part_text(entry->part), &bar, entry->share,
                       &entry->rmse);
        reached += entry->share;
    }
    const html_bar_t cross = {reached / scale, 1 / scale, 1, 0,
                              budget->cross_share < 0 ? "negative" : "share"};
    char text[200];
    budget_describe_cross(budget, text, sizeof text);
    put_budget_row(out, "cross terms", text, &cross, budget->cross_share, NULL);
    put_budget_row(out, "total", "", &(html_bar_t){0, 1 / scale, 1, 0, "probability"}, 1, &budget->total);
    fputs("</table></div>\n", out);
}

static outcome_t put_report(const report_t* report, FILE* out)
{
    html_begin(out, "hyst diagnose");
    put_head(report, out);
    drawing_t drawing = drawing_new(report, out);
    const outcome_t outcome = draw_plots(&drawing);
    drawing_free(&drawing);
    put_where(report, out);
    put_causes(report, out);
    put_parameters(report, out);
    put_budget(report, out);
    html_end(out);
    return outcome;
}

outcome_t report_write(const char* path, const report_t* report)
{
    output_file_t file;
    outcome_t outcome = output_open(&file, path);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    outcome = put_report(report, file.stream);
    if (outcome != OUTCOME_OK) {
        output_abandon(&file);
        return outcome;
    }
    return output_commit(&file);
}
