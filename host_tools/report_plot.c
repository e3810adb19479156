#include "report_plot.h"

#include <errno.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

/// One run of gnuplot: its standard streams are unnamed temporary files, so that nothing of a record or model
/// is ever part of a command line or a file's name.
typedef struct {
    FILE* script;
    FILE* drawing;
    FILE* complaints;
} gnuplot_t;

static outcome_t cannot_run(int error)
{
    if (error == ENOENT) {
        return message_error(OUTCOME_IO, NOWHERE,
                             "--report needs gnuplot, which is not on this machine: install the package "
                             "gnuplot-nox (Debian, Ubuntu) or gnuplot (Fedora, macOS)");
    }
    return message_error(OUTCOME_IO, NOWHERE, "gnuplot cannot be run: %s", strerror(error));
}

static void gnuplot_close(gnuplot_t* gnuplot)
{
    FILE* streams[] = {gnuplot->script, gnuplot->drawing, gnuplot->complaints};
    for (size_t i = 0; i < sizeof streams / sizeof streams[0]; i++) {
        if (streams[i] != NULL) {
            (void)fclose(streams[i]);
        }
    }
}

static outcome_t gnuplot_open(gnuplot_t* gnuplot)
{
    *gnuplot = (gnuplot_t){tmpfile(), tmpfile(), tmpfile()};
    if (gnuplot->script == NULL || gnuplot->drawing == NULL || gnuplot->complaints == NULL) {
        const int error = errno;
        gnuplot_close(gnuplot);
        return message_error(OUTCOME_IO, NOWHERE, "no temporary file can be made: %s", strerror(error));
    }
    return OUTCOME_OK;
}

static int spawn_with_streams(const gnuplot_t* gnuplot, pid_t* process)
{
    // -d: no settings of the user's own.
    char name[] = "gnuplot";
    char defaults[] = "-d";
    char from_stdin[] = "-";
    char* arguments[] = {name, defaults, from_stdin, NULL};
    posix_spawn_file_actions_t actions;
    int error = posix_spawn_file_actions_init(&actions);
    if (error != 0) {
        return error;
    }
    FILE* const streams[] = {gnuplot->script, gnuplot->drawing, gnuplot->complaints};
    for (int i = 0; i < 3 && error == 0; i++) {
        error = posix_spawn_file_actions_adddup2(&actions, fileno(streams[i]), i);
    }
    if (error == 0) {
        error = posix_spawnp(process, name, &actions, NULL, arguments, environ);
    }
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

/// Runs the script; `drawing` is then at its start.
static outcome_t gnuplot_run(gnuplot_t* gnuplot)
{
    if (fflush(gnuplot->script) != 0 || ferror(gnuplot->script) != 0) {
        return message_error(OUTCOME_IO, NOWHERE, "gnuplot's script cannot be written: %s", strerror(errno));
    }
    rewind(gnuplot->script);
    pid_t process;
    const int error = spawn_with_streams(gnuplot, &process);
    if (error != 0) {
        return cannot_run(error);
    }
    int status = 0;
    while (waitpid(process, &status, 0) < 0) {
        if (errno != EINTR) {
            return cannot_run(errno);
        }
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127) { // how some systems report a missing program
        return cannot_run(ENOENT);
    }
    rewind(gnuplot->drawing);
    rewind(gnuplot->complaints);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        char complaint[400] = "";
        const size_t length = fread(complaint, 1, sizeof complaint - 1, gnuplot->complaints);
        complaint[length] = '\0';
        return message_error(OUTCOME_IO, NOWHERE, "gnuplot failed: %s", complaint);
    }
    return OUTCOME_OK;
}

outcome_t plot_check(void)
{
    gnuplot_t gnuplot;
    outcome_t outcome = gnuplot_open(&gnuplot);
    if (outcome == OUTCOME_OK) {
        outcome = gnuplot_run(&gnuplot);
        gnuplot_close(&gnuplot);
    }
    return outcome;
}

/// A gnuplot string between single quotes, in which nothing but the quote itself is special.
static void put_quoted(FILE* script, const char* text)
{
    fputc('\'', script);
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '\'') {
            fputc('\'', script);
        }
        fputc(c < ' ' || c == 0x7f ? ' ' : c, script);
    }
    fputc('\'', script);
}

static void put_point(FILE* script, const plot_series_t* series, size_t t)
{
    fprintf(script, "%.9g %.9g\n", series->x[t], series->y[t]);
}

static void put_series(FILE* script, const plot_series_t* series, size_t num_samples, size_t index)
{
    const size_t stretches = num_samples < PLOT_MOST_POINTS ? num_samples : PLOT_MOST_POINTS / 2;
    fprintf(script, "$series%zu << END\n", index);
    for (size_t s = 0; s < stretches; s++) {
        const size_t end = (s + 1) * num_samples / stretches;
        size_t least = s * num_samples / stretches;
        size_t largest = least;
        for (size_t t = least; t < end; t++) {
            least = series->y[t] < series->y[least] ? t : least;
            largest = series->y[t] > series->y[largest] ? t : largest;
        }
        put_point(script, series, least < largest ? least : largest);
        if (least != largest) {
            put_point(script, series, least < largest ? largest : least);
        }
    }
    fputs("END\n", script);
}

static void put_label(FILE* script, char axis, const char* label)
{
    fprintf(script, "set %clabel ", axis);
    put_quoted(script, label);
    fputs(" noenhanced textcolor rgb '#7d838c'\n", script);
}

/// The plot command's part for one series; a key of its own, whose points are large enough to tell their
/// colour.
static void put_curve(FILE* script, const plot_t* plot, size_t index)
{
    const plot_series_t* series = &plot->series[index];
    const char* style = plot->points ? "points pointtype 7 pointsize" : "lines linewidth";
    fprintf(script, "%s$series%zu using 1:2 with %s %.3g linecolor rgb '%s' notitle, ",
            index == 0 ? "plot " : ", ", index, style, series->width, series->colour);
    fprintf(script, "NaN with %s %.3g linecolor rgb '%s' title ", style, plot->points ? 0.8 : 2.5,
            series->colour);
    put_quoted(script, series->legend);
}

static void put_script(FILE* script, const plot_t* plot)
{
    fprintf(script, "set terminal svg size %d,%d dynamic font 'sans-serif,12' name '%s'\n", plot->width,
            plot->height, plot->id);
    fputs("set encoding utf8\n"
          "set border 3 linecolor rgb '#7d838c'\n"
          "set tics nomirror out scale 0.5 textcolor rgb '#7d838c'\n"
          "set key outside top left horizontal reverse Left noenhanced textcolor rgb '#7d838c' samplen 1.5\n"
          "set autoscale xfix\n"
          "set xzeroaxis linecolor rgb '#7d838c' dashtype 3\n",
          script);
    if (plot->y_limit > 0) {
        fprintf(script, "set yrange [%.9g:%.9g]\n", -plot->y_limit, plot->y_limit);
    }
    put_label(script, 'x', plot->x_label);
    put_label(script, 'y', plot->y_label);
    for (size_t i = 0; i < plot->num_series; i++) {
        put_series(script, &plot->series[i], plot->num_samples, i);
    }
    for (size_t i = 0; i < plot->num_series; i++) {
        put_curve(script, plot, i);
    }
    fputc('\n', script);
}

/// From "<svg" on: within HTML the XML declaration has no place.
static outcome_t copy_svg(FILE* drawing, FILE* out)
{
    static const char opening[] = "<svg";
    size_t matched = 0;
    int c;
    while (matched < sizeof opening - 1 && (c = fgetc(drawing)) != EOF) {
        matched = c == opening[matched] ? matched + 1 : (size_t)(c == opening[0]);
    }
    if (matched < sizeof opening - 1) {
        return message_error(OUTCOME_IO, NOWHERE, "gnuplot drew nothing, expected an SVG drawing");
    }
    fputs(opening, out);
    while ((c = fgetc(drawing)) != EOF) {
        fputc(c, out);
    }
    return OUTCOME_OK;
}

outcome_t plot_svg(const plot_t* plot, FILE* out)
{
    gnuplot_t gnuplot;
    outcome_t outcome = gnuplot_open(&gnuplot);
    if (outcome != OUTCOME_OK) {
        return outcome;
    }
    put_script(gnuplot.script, plot);
    outcome = gnuplot_run(&gnuplot);
    if (outcome == OUTCOME_OK) {
        outcome = copy_svg(gnuplot.drawing, out);
    }
    gnuplot_close(&gnuplot);
    return outcome;
}
