#include "number.h"
#include "output_file.h"
#include "record.h"
#include <csv.h>
#include <string.h>

static void write_name(FILE* stream, const char* name)
{
    const size_t length = strlen(name);
    const bool blank_end =
        length > 0 && (strchr(" \t", name[0]) != NULL || strchr(" \t", name[length - 1]) != NULL);
    const bool plain = strcspn(name, ",\"#") == length && !blank_end;
    if (plain) {
        fputs(name, stream);
    } else {
        csv_fwrite(stream, name, length);
    }
}

static size_t format_value(const record_column_t* column, size_t sample, char* text)
{
    if (column->integer) {
        text[0] = column->value[sample] > 0.5 ? '1' : '0';
        return 1;
    }
    return number_format(column->value[sample], text);
}

outcome_t record_write(const char* path, const record_column_t* columns, size_t num_columns,
                       size_t num_samples)
{
    output_file_t file;
    const outcome_t opened = output_open(&file, path);
    if (opened != OUTCOME_OK) {
        return opened;
    }
    for (size_t i = 0; i < num_columns; ++i) {
        write_name(file.stream, columns[i].name);
        fputc(i + 1 < num_columns ? ',' : '\n', file.stream);
    }
    // A stream that has failed, a closed pipe say, is given no more.
    for (size_t sample = 0; sample < num_samples && ferror(file.stream) == 0; ++sample) {
        for (size_t i = 0; i < num_columns; ++i) {
            char text[NUMBER_SIZE + 1];
            const size_t length = format_value(&columns[i], sample, text);
            text[length] = i + 1 < num_columns ? ',' : '\n';
            fwrite(text, 1, length + 1, file.stream);
        }
    }
    return output_commit(&file);
}
