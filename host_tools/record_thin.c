#include "record_thin.h"

#include "model.h"
#include "record_fill.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STRETCHES = 12, LEAD = 4 };

typedef enum { LEFT_OUT, CARRIED, JUDGED } fate_t;

/// What becomes of each sample of the whole record.
typedef struct {
    const double* input;
    unsigned char* fate; ///< [num_samples] fate_t
} choice_t;

static void keep_extremes(choice_t* choice, size_t begin, size_t end)
{
    size_t least = begin;
    size_t greatest = begin;
    for (size_t t = begin; t < end; t++) {
        least = choice->input[t] < choice->input[least] ? t : least;
        greatest = choice->input[t] > choice->input[greatest] ? t : greatest;
    }
    if (begin < end) {
        choice->fate[least] = CARRIED;
        choice->fate[greatest] = CARRIED;
    }
}

/// How far back from the end of a gap the k-th cell of `count` begins: half the cells grow from 1 sample to
/// the length of the others, which share out the rest evenly.
static size_t cell_distance(size_t gap, size_t k, size_t count)
{
    const size_t growing = count / 2;
    const double even = (double)gap / (double)(count - growing + 1);
    const double distance =
        k <= growing ? pow(even, (double)k / (double)growing) : even * (double)(k - growing + 1);
    return distance < (double)gap && k < count ? (size_t)distance : gap;
}

static void carry_over(choice_t* choice, size_t begin, size_t end, size_t num_cells)
{
    size_t last = end;
    for (size_t k = 1; k <= num_cells; k++) {
        const size_t first = end - cell_distance(end - begin, k, num_cells);
        keep_extremes(choice, first, last);
        last = first;
    }
}

/// Marks what is kept: 2/3 of `most` in stretches, the rest between them, two samples a cell.
static void choose(choice_t* choice, size_t num_samples, size_t most)
{
    const size_t length = 2 * most / (3 * STRETCHES);
    const size_t num_cells = most / (3 * 2 * (STRETCHES - 1));
    size_t end = 0;
    for (size_t s = 0; s < STRETCHES; s++) {
        const size_t begin = s * (num_samples - length) / (STRETCHES - 1);
        const size_t lead = s == 0 ? 0 : length / LEAD;
        carry_over(choice, end, begin, s == 0 ? 0 : num_cells);
        memset(choice->fate + begin, CARRIED, lead);
        memset(choice->fate + begin + lead, JUDGED, length - lead);
        end = begin + length;
    }
}

/// The samples with a fate, allocated; NULL of NULL.
static double* kept_of(const choice_t* choice, size_t num_samples, size_t num_kept, const double* value)
{
    if (value == NULL) {
        return NULL;
    }
    double* kept = xmalloc(num_kept * sizeof *kept);
    size_t k = 0;
    for (size_t t = 0; t < num_samples; t++) {
        if (choice->fate[t] != LEFT_OUT) {
            kept[k++] = value[t];
        }
    }
    return kept;
}

static record_t kept_record(const choice_t* choice, const record_t* record, size_t num_kept)
{
    const size_t n = record->num_samples;
    record_t kept = {.path = xstrdup(record->path),
                     .num_samples = num_kept,
                     .time = kept_of(choice, n, num_kept, record->time),
                     .input = kept_of(choice, n, num_kept, record->input),
                     .output = kept_of(choice, n, num_kept, record->output),
                     .num_auxiliary = record->num_auxiliary,
                     .auxiliary = xcalloc(record->num_auxiliary + 1, sizeof *kept.auxiliary)};
    for (size_t c = 0; c < record->num_auxiliary; c++) {
        kept.auxiliary[c] = (column_t){xstrdup(record->auxiliary[c].name),
                                       kept_of(choice, n, num_kept, record->auxiliary[c].value)};
    }
    return kept;
}

/// Times of a record that has none, once samples are left out.
static double* kept_numbers(const choice_t* choice, size_t num_samples, size_t num_kept)
{
    double* number = xmalloc(num_samples * sizeof *number);
    for (size_t t = 0; t < num_samples; t++) {
        number[t] = (double)t;
    }
    double* kept = kept_of(choice, num_samples, num_kept, number);
    free(number);
    return kept;
}

static size_t count_kept(const choice_t* choice, size_t num_samples)
{
    size_t count = 0;
    for (size_t t = 0; t < num_samples; t++) {
        count += choice->fate[t] != LEFT_OUT;
    }
    return count;
}

/// Which of the kept samples are not to be judged by.
static bool* kept_carried(const choice_t* choice, const record_t* record, size_t num_kept,
                          size_t first_judged)
{
    bool* carried = xmalloc(num_kept * sizeof *carried);
    for (size_t t = 0, k = 0; t < record->num_samples; t++) {
        if (choice->fate[t] != LEFT_OUT) {
            carried[k++] = choice->fate[t] == CARRIED || t < first_judged || record_is_carried(record, t);
        }
    }
    return carried;
}

static record_t kept_samples(const record_t* record, size_t most, size_t first_judged)
{
    const size_t n = record->num_samples;
    choice_t choice = {record->input, xcalloc(n, 1)};
    if (n <= most) {
        memset(choice.fate, JUDGED, n);
    } else {
        choose(&choice, n, most);
    }
    const size_t num_kept = count_kept(&choice, n);
    record_t kept = kept_record(&choice, record, num_kept);
    if (kept.time == NULL && num_kept < n) {
        kept.time = kept_numbers(&choice, n, num_kept);
    }
    if (num_kept < n || first_judged > 0 || record->carried != NULL) {
        kept.carried = kept_carried(&choice, record, num_kept, first_judged);
    }
    free(choice.fate);
    return kept;
}

record_t record_thin(const record_t* record, size_t most, size_t first_judged)
{
    record_t whole = kept_samples(record, record->num_samples, first_judged);
    record_fill(&whole);
    if (record->num_samples <= most) {
        return whole;
    }
    record_t thinned = kept_samples(&whole, most, 0);
    record_free(&whole);
    return thinned;
}
