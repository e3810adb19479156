#include "record.h"
#include "input_file.h"
#include "model.h"
#include "number.h"
#include "record_header.h"
#include <csv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char* file;
    const record_options_t* options;
    column_names_t names;
    struct csv_parser parser;
    char* buffer; ///< getline's
    size_t buffer_size;
    const char* line; ///< the present line, without its end
    size_t line_length;
    size_t line_number;
    field_t* fields;
    size_t num_fields; ///< 0 until the header was read
    size_t num_cells;  ///< seen in the present line
    size_t num_samples;
    size_t capacity;   ///< of every field's value
    size_t time_field; ///< num_fields when there is none
    outcome_t outcome;
} reader_t;

/// 1-based byte where a cell of the present line begins; for a cell beyond the last, the byte behind the
/// line.
static size_t cell_column(const reader_t* reader, size_t cell)
{
    bool quoted = false;
    size_t at = 0;
    for (; at < reader->line_length && cell > 0; ++at) {
        quoted = quoted != (reader->line[at] == '"');
        if (reader->line[at] == ',' && !quoted) {
            cell -= 1;
        }
    }
    while (cell == 0 && at < reader->line_length && (reader->line[at] == ' ' || reader->line[at] == '\t')) {
        at += 1;
    }
    return (size_t)(reader->line - reader->buffer) + at + 1;
}

static location_t cell_location(const reader_t* reader, size_t cell)
{
    return (location_t){
        .file = reader->file, .line = reader->line_number, .column = cell_column(reader, cell)};
}

static void add_field(reader_t* reader, const char* name, size_t length)
{
    reader->fields = xrealloc(reader->fields, (reader->num_fields + 1) * sizeof(field_t));
    char* copy = xmalloc(length + 1);
    memcpy(copy, name, length);
    copy[length] = '\0';
    reader->fields[reader->num_fields++] = (field_t){.name = copy};
}

static void header_cell(void* text, size_t length, void* context)
{
    add_field(context, text, length);
}

/// Not a number: fatal where the number is needed, else the column is no data for us.
static void refuse_cell(reader_t* reader, size_t cell, const char* text, size_t length,
                        number_status_t status)
{
    field_t* field = &reader->fields[cell];
    if (field->role == ROLE_AUXILIARY) {
        message_note(cell_location(reader, cell), "column \"%s\" is left out: it does not hold numbers only",
                     field->name);
        free(field->value);
        field->value = NULL;
        field->role = ROLE_LEFT_OUT;
        return;
    }
    const char* what = status == NUMBER_OVERFLOW ? "is too large for a number" : "is not a number";
    if (length == 0) {
        reader->outcome = message_error(OUTCOME_BAD_INPUT, cell_location(reader, cell),
                                        "empty cell in column \"%s\", expected a number", field->name);
    } else if (status == NUMBER_NOT_FINITE) {
        reader->outcome =
            message_error(OUTCOME_BAD_INPUT, cell_location(reader, cell),
                          "\"%s\" in column \"%s\", expected a finite number", text, field->name);
    } else {
        reader->outcome = message_error(OUTCOME_BAD_INPUT, cell_location(reader, cell),
                                        "\"%.60s\" in column \"%s\" %s, expected a decimal number", text,
                                        field->name, what);
    }
}

static void data_cell(void* text, size_t length, void* context)
{
    reader_t* reader = context;
    const size_t cell = reader->num_cells++;
    if (cell >= reader->num_fields || reader->fields[cell].role == ROLE_LEFT_OUT ||
        reader->outcome != OUTCOME_OK) {
        return;
    }
    double* value = &reader->fields[cell].value[reader->num_samples];
    const number_status_t status = number_parse(text, length, value);
    if (status != NUMBER_OK) {
        refuse_cell(reader, cell, text, length, status);
    }
}

/// Cells go to `cell` one by one.
static void parse_line(reader_t* reader, void (*cell)(void*, size_t, void*))
{
    if (csv_parse(&reader->parser, reader->line, reader->line_length, cell, NULL, reader) !=
            reader->line_length ||
        csv_fini(&reader->parser, cell, NULL, reader) != 0) {
        if (reader->outcome == OUTCOME_OK) {
            reader->outcome = message_error(
                OUTCOME_BAD_INPUT, (location_t){.file = reader->file, .line = reader->line_number},
                "misplaced quotation mark, expected a quoted cell to end in the same line");
        }
    }
}

static void read_header(reader_t* reader)
{
    const location_t place = cell_location(reader, 0);
    parse_line(reader, header_cell);
    if (reader->outcome != OUTCOME_OK) {
        return;
    }
    size_t num_numbers = 0;
    for (size_t i = 0; i < reader->num_fields; ++i) {
        double value;
        const char* name = reader->fields[i].name;
        num_numbers += number_parse(name, strlen(name), &value) != NUMBER_NOT_A_NUMBER ? 1 : 0;
    }
    if (num_numbers == reader->num_fields) {
        reader->outcome = message_error(OUTCOME_BAD_INPUT, place,
                                        "the header row is missing: expected the columns' names, as in "
                                        "\"time,input,output\"");
        return;
    }
    reader->outcome =
        record_assign_roles(place, reader->options, &reader->names, reader->fields, reader->num_fields);
    reader->time_field = reader->num_fields;
    for (size_t i = 0; i < reader->num_fields; ++i) {
        if (reader->fields[i].role == ROLE_TIME) {
            reader->time_field = i;
        }
    }
}

static void reserve_sample(reader_t* reader)
{
    if (reader->num_samples < reader->capacity) {
        return;
    }
    reader->capacity = reader->capacity < 512 ? 1024 : 2 * reader->capacity;
    for (size_t i = 0; i < reader->num_fields; ++i) {
        if (reader->fields[i].role != ROLE_LEFT_OUT) {
            reader->fields[i].value = xrealloc(reader->fields[i].value, reader->capacity * sizeof(double));
        }
    }
}

static void check_time(reader_t* reader)
{
    const size_t i = reader->num_samples;
    if (reader->time_field == reader->num_fields || i == 0) {
        return;
    }
    const double* time = reader->fields[reader->time_field].value;
    if (!(time[i] > time[i - 1])) {
        reader->outcome =
            message_error(OUTCOME_BAD_INPUT, cell_location(reader, reader->time_field),
                          "time %.15g after %.15g, expected strictly increasing time", time[i], time[i - 1]);
    }
}

static void read_sample(reader_t* reader)
{
    reserve_sample(reader);
    reader->num_cells = 0;
    parse_line(reader, data_cell);
    if (reader->outcome != OUTCOME_OK) {
        return;
    }
    if (reader->num_cells != reader->num_fields) {
        const size_t odd = reader->num_cells < reader->num_fields ? reader->num_cells : reader->num_fields;
        reader->outcome =
            message_error(OUTCOME_BAD_INPUT, cell_location(reader, odd),
                          "%zu cells, expected %zu as in the header", reader->num_cells, reader->num_fields);
        return;
    }
    check_time(reader);
    reader->num_samples += 1;
}

/// What libcsv would take for data or for the end of a row.
static void check_bytes(reader_t* reader)
{
    const location_t place = {.file = reader->file, .line = reader->line_number};
    if (memchr(reader->line, '\0', reader->line_length) != NULL) {
        reader->outcome =
            message_error(OUTCOME_BAD_INPUT, place,
                          "a NUL byte, expected UTF-8 text (this may be UTF-16 or a binary file)");
    } else if (memchr(reader->line, '\r', reader->line_length) != NULL) {
        reader->outcome =
            message_error(OUTCOME_BAD_INPUT, place,
                          "a carriage return within the line, expected lines to end in LF or CRLF");
    }
}

static void read_line(reader_t* reader, size_t length)
{
    reader->line_number += 1;
    const bool byte_order_mark =
        reader->line_number == 1 && length >= 3 && memcmp(reader->buffer, "\xEF\xBB\xBF", 3) == 0;
    const size_t start = byte_order_mark ? 3 : 0;
    length -= length > start && reader->buffer[length - 1] == '\n' ? 1 : 0;
    length -= length > start && reader->buffer[length - 1] == '\r' ? 1 : 0;
    reader->line = reader->buffer + start;
    reader->line_length = length - start;
    check_bytes(reader);
    const size_t blank = strspn(reader->line, " \t\r\n");
    if (reader->outcome != OUTCOME_OK || blank >= reader->line_length || reader->line[blank] == '#') {
        return;
    }
    if (reader->num_fields == 0) {
        read_header(reader);
    } else {
        read_sample(reader);
    }
}

static void check_length(reader_t* reader)
{
    const location_t end = {.file = reader->file, .line = reader->line_number};
    if (reader->num_fields == 0) {
        reader->outcome =
            message_error(OUTCOME_BAD_INPUT, end,
                          "no data: expected a header row such as \"time,input,output\" and samples");
    } else if (reader->num_samples < 2) {
        reader->outcome =
            message_error(OUTCOME_BAD_INPUT, end, "%s after the header, expected at least 2 samples",
                          reader->num_samples == 0 ? "no samples" : "only one sample");
    }
}

static void make_time(reader_t* reader, record_t* record)
{
    const double rate = reader->options->sample_rate;
    if (!(rate > 0.0)) {
        return;
    }
    if (record->time != NULL) {
        message_warning((location_t){.file = reader->file},
                        "--sample-rate is not used: the record has a time column");
        return;
    }
    record->time = xcalloc(record->num_samples, sizeof(double));
    for (size_t i = 0; i < record->num_samples; ++i) {
        record->time[i] = (double)i / rate;
    }
}

static double* take(field_t* field)
{
    double* value = field->value;
    field->value = NULL;
    return value;
}

/// Hands the fields' values over to the record.
static void fill_record(reader_t* reader, record_t* record)
{
    record->path = xstrdup(reader->file);
    record->num_samples = reader->num_samples;
    record->auxiliary = xcalloc(reader->num_fields, sizeof(column_t));
    for (size_t i = 0; i < reader->num_fields; ++i) {
        field_t* field = &reader->fields[i];
        switch (field->role) {
        case ROLE_TIME:
            record->time = take(field);
            break;
        case ROLE_INPUT:
            record->input = take(field);
            break;
        case ROLE_OUTPUT:
            record->output = take(field);
            break;
        case ROLE_AUXILIARY:
            record->auxiliary[record->num_auxiliary++] = (column_t){xstrdup(field->name), take(field)};
            break;
        case ROLE_LEFT_OUT:
            break;
        }
    }
    make_time(reader, record);
}

static void reader_free(reader_t* reader)
{
    csv_free(&reader->parser);
    column_names_free(&reader->names);
    for (size_t i = 0; i < reader->num_fields; ++i) {
        free(reader->fields[i].name);
        free(reader->fields[i].value);
    }
    free(reader->fields);
    free(reader->buffer);
}

static void read_stream(reader_t* reader, const char* path)
{
    FILE* stream;
    reader->outcome = input_open(path, &stream);
    if (reader->outcome != OUTCOME_OK) {
        return;
    }
    ssize_t length = 0;
    while (reader->outcome == OUTCOME_OK &&
           (length = getline(&reader->buffer, &reader->buffer_size, stream)) >= 0) {
        read_line(reader, (size_t)length);
    }
    const outcome_t closed = input_close(path, stream);
    if (reader->outcome == OUTCOME_OK) {
        reader->outcome = closed;
    }
    if (reader->outcome == OUTCOME_OK) {
        check_length(reader);
    }
}

outcome_t record_read(const char* path, const record_options_t* options, record_t* record)
{
    *record = (record_t){0};
    if (!isfinite(options->sample_rate) || options->sample_rate < 0.0) {
        return message_error(OUTCOME_USAGE, NOWHERE,
                             "--sample-rate is %g, expected a number of hertz above 0", options->sample_rate);
    }
    reader_t reader = {.file = input_name(path), .options = options};
    if (csv_init(&reader.parser, CSV_STRICT | CSV_STRICT_FINI | CSV_APPEND_NULL) != 0) {
        return message_error(OUTCOME_IO, NOWHERE, "the CSV reader cannot be set up");
    }
    reader.outcome = column_names_parse(options->columns, &reader.names);
    if (reader.outcome == OUTCOME_OK) {
        read_stream(&reader, path);
    }
    if (reader.outcome == OUTCOME_OK) {
        fill_record(&reader, record);
    }
    reader_free(&reader);
    return reader.outcome;
}

void record_free(record_t* record)
{
    free(record->path);
    free(record->time);
    free(record->input);
    free(record->output);
    for (size_t i = 0; i < record->num_auxiliary; ++i) {
        free(record->auxiliary[i].name);
        free(record->auxiliary[i].value);
    }
    free(record->auxiliary);
    free(record->carried);
    *record = (record_t){0};
}

bool record_is_carried(const record_t* record, size_t sample)
{
    return record->carried != NULL && record->carried[sample];
}

const column_t* record_find_auxiliary(const record_t* record, const char* name)
{
    for (size_t i = 0; i < record->num_auxiliary; ++i) {
        if (strcmp(record->auxiliary[i].name, name) == 0) {
            return &record->auxiliary[i];
        }
    }
    return NULL;
}
