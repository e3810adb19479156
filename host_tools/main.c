#include "command.h"
#include "hyst/hyst.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define TEXT_OF(number)                   #number
#define VERSION_TEXT(major, minor, patch) TEXT_OF(major) "." TEXT_OF(minor) "." TEXT_OF(patch)

typedef struct {
    const char* name;
    outcome_t (*run)(int argc, const char** argv);
    const char* summary;
} verb_t;

static const verb_t verbs[] = {
    {"identify", cmd_identify, "fits a model to a measured record"},
    {"compress", cmd_compress, "merges a model's plays into fewer"},
    {"emit", cmd_emit, "writes a model as a C header for firmware"},
    {"simulate", cmd_simulate, "runs a model over a record's input"},
    {"invert", cmd_invert, "finds the input that gives a wanted output"},
    {"diagnose", cmd_diagnose, "finds the unmodelled effect behind a gap between model and record"},
    {"effects", cmd_effects, "lists those effects, with their equations and parameters"},
};
enum { NUM_VERBS = sizeof verbs / sizeof verbs[0] };

static void print_help(void)
{
    puts("Usage: hyst VERB [OPTION...] ARGUMENT...\n"
         "\n"
         "Identifies, compresses, runs, inverts and emits generalized Prandtl-Ishlinskii hysteresis "
         "models.\n");
    for (size_t i = 0; i < NUM_VERBS; ++i) {
        printf("  %-10s %s\n", verbs[i].name, verbs[i].summary);
    }
    puts("\n"
         "hyst VERB --help explains each verb; hyst --version prints the version. A file called - is stdin "
         "or\n"
         "stdout. An output file appears whole or not at all.\n"
         "\n"
         "Exit codes: 0 done, 1 ran and the answer is no, 2 usage, 3 bad input data, 4 numerical failure,\n"
         "5 input/output.\n"
         "\n"
         "Example:\n"
         "  hyst identify loop.csv -o model.json\n"
         "  hyst compress model.json --plays 6 --cost entropy-sum -o small.json\n"
         "  hyst emit small.json -o model.h");
}

static outcome_t unknown_verb(const char* name)
{
    char list[200] = "";
    for (size_t i = 0; i < NUM_VERBS; ++i) {
        strcat(list, i == 0 ? "" : ", ");
        strcat(list, verbs[i].name);
    }
    return message_error(OUTCOME_USAGE, NOWHERE, "\"%s\" is no verb, expected one of %s (see hyst --help)",
                         name, list);
}

static outcome_t run(int argc, const char** argv)
{
    if (argc < 2) {
        return message_error(OUTCOME_USAGE, NOWHERE, "a verb is missing (see hyst --help)");
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        print_help();
        return OUTCOME_OK;
    }
    if (strcmp(argv[1], "--version") == 0) {
        puts("hyst " VERSION_TEXT(HYST_VERSION_MAJOR, HYST_VERSION_MINOR, HYST_VERSION_PATCH));
        return OUTCOME_OK;
    }
    for (size_t i = 0; i < NUM_VERBS; ++i) {
        if (strcmp(argv[1], verbs[i].name) == 0) {
            return verbs[i].run(argc - 1, argv + 1);
        }
    }
    return unknown_verb(argv[1]);
}

/// A file opened later must not become stdin, stdout or stderr because the caller closed one of them. Opened
/// the wrong way round, so that using them still fails.
static void keep_standard_streams(void)
{
    static const int wrong_way[] = {O_WRONLY, O_RDONLY, O_RDONLY};
    for (int descriptor = 0; descriptor < 3; ++descriptor) {
        if (fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) {
            (void)!open("/dev/null", wrong_way[descriptor]);
        }
    }
}

int main(int argc, char** argv)
{
    keep_standard_streams();
    // A reader that went away is a message and OUTCOME_IO, not a silent death.
    signal(SIGPIPE, SIG_IGN);
    const char** arguments = xcalloc((size_t)argc + 1, sizeof *arguments);
    for (int i = 0; i < argc; ++i) {
        arguments[i] = argv[i];
    }
    outcome_t outcome = run(argc, arguments);
    free(arguments);
    errno = 0;
    if ((fflush(stdout) != 0 || ferror(stdout) != 0) && outcome != OUTCOME_IO) {
        outcome = message_error(OUTCOME_IO, (location_t){.file = "<stdout>"}, "cannot be written: %s",
                                errno != 0 ? strerror(errno) : "writing failed");
    }
    return (int)outcome;
}
