/* Unpacks a file that contains another one: the content of a gzip archive, or the data sheet of a
 * spreadsheet as text. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"
#include "read/bytes/input.h"
#include "read/formats.h"
#include "read/packed/packed.h"
#include "read/text/text.h"
#include "read/text/text_condition.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- the sheet ------------------------------------------------------------------------------- */

typedef struct sheet_choice {
    const wt_formats *formats;
    const wt_read_options *options;
    unsigned kinds;
    const workbook *book;
    const char *file;
    bool *chosen; /* one flag for each sheet */
    wt_error *err;
} sheet_choice;

static bool uses_all_sheets(const sheet_choice *c)
{
    return c->options->sheet != NULL && strcmp(c->options->sheet, "all") == 0;
}

/* Formats the names of all sheets, or of those chosen, for a message. */
static void format_sheet_names(const sheet_choice *c, bool chosen, char *names, size_t size)
{
    size_t used = 0;
    names[0] = '\0';
    for (size_t i = 0; i < c->book->n && used < size; i++)
        if (!chosen || c->chosen[i])
            used += (size_t)snprintf(names + used, size - used, "%s\"%s\"", used > 0 ? ", " : "",
                                     c->book->sheets[i].name);
}

/* Formats the line above a sheet: the temperature that its name states, or an empty line. */
static void format_sheet_line(const sheet_choice *c, size_t i, char *line, size_t size)
{
    const char *const name = c->book->sheets[i].name, *const pattern =
                                                          c->options->temperature_in_name;
    text_condition condition;
    line[0] = '\0';
    if ((pattern != NULL && condition_match_name(pattern, name, &condition)) ||
        condition_read_title((text_span){name, strlen(name)}, &condition))
        condition_format(&condition, line, size);
}

/* Writes the chosen sheets, one after the other. */
static void write_sheets(const sheet_choice *c, char **text, size_t *length)
{
    size_t n = 0;
    FILE *const out = text_stream_open(text, length);
    for (size_t i = 0; i < c->book->n; i++) {
        char line[64];
        if (!c->chosen[i])
            continue;
        format_sheet_line(c, i, line, sizeof line);
        if (line[0] != '\0')
            fprintf(out, "%s%s\n", n > 0 ? "\n" : "", line);
        (void)fwrite(c->book->sheets[i].text, 1, c->book->sheets[i].length, out);
        n++;
    }
    text_stream_close(out);
}

/* Sets *yes if a reader of the requested kinds recognises the sheet. */
static wt_status detect_sheet(const sheet_choice *c, size_t i, bool *yes)
{
    wt_error cause = WT_ERROR_INIT;
    wt_input *input = NULL;
    const file_reader *reader = NULL;
    wt_status status = wt_input_open_memory(c->book->sheets[i].text, c->book->sheets[i].length,
                                            c->file, &input, c->err);
    if (status != WT_OK)
        return status;
    status = detect_reader(c->formats, input, c->options->format, c->kinds, &reader, &cause);
    if (status == WT_OK && c->options->format != NULL) {
        const unsigned char *bytes = NULL;
        file_peek peek = {.whole = true, .name = c->file, .input = input};
        status = wt_input_bytes(input, &bytes, &peek.length, c->err);
        peek.bytes = bytes;
        *yes = status == WT_OK && reader->detect(reader, &peek).answer == ANSWER_YES;
        text_peek_free(peek.text);
    } else {
        *yes = status == WT_OK;
        status = status == WT_E_MEMORY ? wt_fail(c->err, status, "%s", cause.message) : WT_OK;
    }
    wt_input_close(input);
    return status;
}

static wt_status choose_by_name(const sheet_choice *c)
{
    char names[200];
    for (size_t i = 0; i < c->book->n; i++) {
        c->chosen[i] = strcasecmp(c->book->sheets[i].name, c->options->sheet) == 0;
        if (c->chosen[i])
            return WT_OK;
    }
    format_sheet_names(c, false, names, sizeof names);
    wt_fail(c->err, WT_E_NOT_FOUND, "the spreadsheet has no sheet \"%s\"", c->options->sheet);
    wt_error_found(c->err, "%s", names);
    return WT_E_NOT_FOUND;
}

/* Chooses the sheets that a reader recognises. Hidden sheets are skipped unless they are named. */
static wt_status choose_by_content(const sheet_choice *c)
{
    char names[200];
    size_t n = 0, visible = 0, last = 0;
    for (size_t i = 0; i < c->book->n; i++) {
        if (c->book->sheets[i].hidden)
            continue;
        const wt_status status = detect_sheet(c, i, &c->chosen[i]);
        if (status != WT_OK)
            return status;
        n += c->chosen[i];
        visible++;
        last = i;
    }
    if (n == 1 || (n > 1 && uses_all_sheets(c)))
        return WT_OK;
    format_sheet_names(c, n > 0, names, sizeof names);
    if (n > 1) {
        wt_fail(c->err, WT_E_AMBIGUOUS, "%zu sheets of the spreadsheet hold data", n);
        wt_error_found(c->err, "%s", names);
        wt_error_advice(c->err, "choose one with --sheet NAME, or take all of them as one "
                                "measurement with --sheet all");
        wt_error_options(c->err, "sheet");
        return WT_E_AMBIGUOUS;
    }
    /* A single visible sheet is read in any case; its reader reports what is wrong. */
    c->chosen[last] = visible == 1;
    if (visible == 1)
        return WT_OK;
    wt_fail(c->err, WT_E_FORMAT, "no sheet of the spreadsheet is recognised");
    wt_error_found(c->err, "%s", names);
    wt_error_advice(c->err, "a table of data begins with the names of its columns, such as f, E', "
                            "E'' and T, with their units behind them in brackets or in the next "
                            "row; `weartrack formats list` shows what is known");
    return WT_E_FORMAT;
}

/* Joins the chosen sheets to one text. */
static wt_input *join_sheets(const sheet_choice *c)
{
    char *text = NULL;
    char names[200];
    size_t length = 0, n = 0, one = 0;
    for (size_t i = 0; i < c->book->n; i++) {
        n += c->chosen[i];
        one = c->chosen[i] ? i : one;
    }
    write_sheets(c, &text, &length);
    format_sheet_names(c, true, names, sizeof names);
    char *const name = n == 1 ? format_text("%s, sheet %s", c->file, c->book->sheets[one].name)
                              : format_text("%s, sheets %s one after the other", c->file, names);
    wt_input *const content = input_from_bytes(text, length, name);
    free(name);
    return content;
}

static wt_status choose_sheet(const wt_formats *formats, wt_input *input, const workbook *book,
                              const wt_read_options *options, unsigned kinds, wt_input **content,
                              wt_error *err)
{
    const sheet_choice c = {.formats = formats,
                            .options = options,
                            .kinds = kinds,
                            .book = book,
                            .file = wt_input_name(input),
                            .chosen = wt_alloc(book->n, sizeof(bool)),
                            .err = err};
    wt_status status = WT_OK;
    if (book->n == 0)
        status = wt_fail(err, WT_E_EMPTY, "the spreadsheet has no sheet with cells");
    else
        status = options->sheet != NULL && !uses_all_sheets(&c) ? choose_by_name(&c)
                                                                : choose_by_content(&c);
    if (status == WT_OK)
        *content = join_sheets(&c);
    free(c.chosen);
    return status;
}

/* ---- unpacking ------------------------------------------------------------------------------- */

/* Unpacks one layer. *content stays NULL if nothing is packed. */
static wt_status unpack_layer(const wt_formats *formats, wt_input *input,
                              const wt_read_options *options, unsigned kinds, wt_input **content,
                              wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    bool whole = false;
    workbook book = {.sheets = NULL};
    wt_status status = wt_input_peek(input, PACKED_PEEK, &bytes, &length, &whole, err);
    if (status != WT_OK)
        return status;
    if (gzip_is_archive(bytes, length))
        return gzip_unpack(input, content, err);
    const bool new_book = xlsx_is_workbook(bytes, length);
    if (!new_book && !xls_is_workbook(bytes, length))
        return WT_OK;
    status = new_book ? xlsx_read(input, &book, err) : xls_read(input, &book, err);
    if (status == WT_OK)
        status = choose_sheet(formats, input, &book, options, kinds, content, err);
    workbook_clear(&book);
    return status;
}

/* Maximum nesting of archives, such as a gzip archive of a gzip archive of a spreadsheet. */
enum { MAX_ARCHIVE_DEPTH = 3 };

wt_status find_reader(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                      unsigned kinds, const file_reader **reader, wt_input **content, wt_error *err)
{
    wt_input *in = input_content(input);
    wt_status status = WT_OK;
    for (int i = in == input ? 0 : MAX_ARCHIVE_DEPTH; i < MAX_ARCHIVE_DEPTH; i++) {
        wt_input *inner = NULL;
        status = unpack_layer(formats, in, options, kinds, &inner, err);
        if (status != WT_OK || inner == NULL)
            break;
        input_attach_content(in, inner);
        in = inner;
    }
    *content = in;
    if (status == WT_OK)
        status = detect_reader(formats, in, options->format, kinds, reader, err);
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}

wt_status wt_format_detect(const wt_formats *formats, wt_input *input,
                           const wt_read_options *options, unsigned kinds,
                           const wt_format_info **info, wt_error *err)
{
    static const wt_read_options usual = {.format = NULL, .sheet = NULL};
    const file_reader *reader = NULL;
    wt_input *content = NULL;
    wt_status status = find_reader(formats, input, options != NULL ? options : &usual, kinds,
                                   &reader, &content, err);
    if (status == WT_OK)
        *info = &reader->info;
    return status;
}
