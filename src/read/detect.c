/* Finds the reader of a file, which may be packed: the content of a gzip archive, or the data sheet
 * of a spreadsheet as text. Every reader is queried; one that cannot decide yet sees more of the
 * file. The order of the list never decides a tie. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"

#include "read/bytes/input.h"
#include "read/formats.h"
#include "read/packed/packed.h"
#include "read/text/text.h"
#include "read/text/text_condition.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- files as they are ----------------------------------------------------------------------- */

#define FIRST_PEEK ((size_t)4096)

/* ---- unknown files --------------------------------------------------------------------------- */

typedef struct file_signature {
    size_t at; /* offset in the file */
    const char *bytes;
    size_t length;
    const char *label;
    const char *advice;
    bool measured;       /* may contain measured data */
    const char *options; /* options that the advice names; "" if none */
} file_signature;

#define SIGNATURE_AT(at, bytes, label, advice, measured)                                           \
    {                                                                                              \
        at, bytes, sizeof bytes - 1, label, advice, measured, ""                                   \
    }
#define SIGNATURE(bytes, label, advice) SIGNATURE_AT(0, bytes, label, advice, false)
#define SIGNATURE_MEASURED(bytes, label, advice) SIGNATURE_AT(0, bytes, label, advice, true)
#define ADVICE_TEXT "export it as text or CSV from the program of the instrument"
#define ADVICE_EXPORT "give the file that the instrument exported, as text or CSV"
#define ADVICE_UNPACK(program) "unpack it with `" program "` and give what is in it"
#define ADVICE_CURVES "export force curves as text: columns of height and force with their units"
#define LABEL_RESULT                                                                               \
    "a result of weartrack (text stream) without measured curves, sweeps or spectra"
#define ADVICE_TABLES                                                                              \
    "`weartrack table --list` shows its tables; where something is measured anew, give the file "  \
    "of the instrument"
#define ADVICE_DESCRIBE                                                                            \
    "export it in one of the formats of `weartrack formats list`; say what its columns hold, "     \
    "with "                                                                                        \
    "--columns \"NAME=QUANTITY:UNIT\" for each; or describe its layout in a file "                 \
    "(weartrack-format(5)) and give its folder with --formats"
static const file_signature signatures[] = {
    SIGNATURE_MEASURED("PK\3\4",
                       "a ZIP archive that is no JPK file and no spreadsheet, or a cut one",
                       "copy a JPK file or a spreadsheet again, unpack any other archive"),
    SIGNATURE_MEASURED("PK\5\6", "an empty ZIP archive", ADVICE_EXPORT),
    SIGNATURE_MEASURED(HDF5_SIGNATURE, "an HDF5 file of another program", ADVICE_TEXT),
    SIGNATURE("%PDF", "a PDF document", ADVICE_EXPORT),
    SIGNATURE("SQLite format 3", "an SQLite database", ADVICE_TEXT),
    SIGNATURE("\211PNG", "a PNG picture", ADVICE_EXPORT),
    SIGNATURE("\377\330\377", "a JPEG picture", ADVICE_EXPORT),
    SIGNATURE("II*\0", "a TIFF picture", ADVICE_EXPORT),
    SIGNATURE("MM\0*", "a TIFF picture", ADVICE_EXPORT),
    SIGNATURE_MEASURED("WSxM file copyright", "a WSxM file", ADVICE_CURVES),
    SIGNATURE_MEASURED("\1\260\223\377", "an NT-MDT file (.mdt)",
                       "export each curve as text from Nova: height, approach and retract"),
    SIGNATURE_MEASURED("Experiment\t", "a Nanonis (SPECS) spectrum", ADVICE_CURVES),
    SIGNATURE(":NANONIS_VERSION:", "a Nanonis (SPECS) image", ADVICE_TEXT),
    SIGNATURE_AT(257, "ustar", "a tar archive", "unpack it (tar -xf), and give its files", true),
    SIGNATURE_AT(4, "1AY&SY", "a bzip2 archive", ADVICE_UNPACK("bunzip2"), true),
    SIGNATURE_MEASURED("\3757zXZ", "an xz archive", ADVICE_UNPACK("unxz")),
    SIGNATURE_MEASURED("\50\265\57\375", "a Zstandard archive", ADVICE_UNPACK("unzstd")),
    SIGNATURE_MEASURED("7z\274\257\47\34", "a 7-Zip archive", ADVICE_UNPACK("7z x")),
    SIGNATURE_MEASURED("Rar!\32\7", "a RAR archive", ADVICE_UNPACK("unrar x")),
    SIGNATURE_MEASURED("TDSm", "a TDMS file of LabVIEW or DIAdem (National Instruments)",
                       "export its channels as text or CSV with a names row and units, from the "
                       "program that wrote it, DIAdem or npTDMS (Python)"),
    SIGNATURE_MEASURED("\5\0", "an Igor binary wave (Asylum Research), or unknown binary data",
                       ADVICE_TEXT),
    SIGNATURE_MEASURED("## weartrack: ", LABEL_RESULT, ADVICE_TABLES),
    SIGNATURE_MEASURED("## table: ", LABEL_RESULT, ADVICE_TABLES),
    SIGNATURE("<?xml", "an XML document", "a case file is for `weartrack run`; " ADVICE_EXPORT),
    SIGNATURE("<!DOCTYPE", "an HTML or XML document", ADVICE_EXPORT),
    SIGNATURE("<html", "an HTML page", ADVICE_EXPORT),
    {0, "\377\376", 2, "UTF-16 text of no known layout", ADVICE_DESCRIBE, false, "columns"},
    {0, "\376\377", 2, "UTF-16 text of no known layout", ADVICE_DESCRIBE, false, "columns"},
};
static const file_signature empty = {0, "", 0, "an empty file", "export it again", true, ""};
static const file_signature binary = {0, "", 0, "unknown binary data", ADVICE_TEXT, false, ""};
static const file_signature plain_text = {
    0, "", 0, "text of no known layout", ADVICE_DESCRIBE, false, "columns"};

static const file_signature *classify_bytes(const unsigned char *bytes, size_t length)
{
    if (length == 0)
        return &empty;
    for (size_t i = 0; i < sizeof signatures / sizeof *signatures; i++) {
        const file_signature *s = &signatures[i];
        if (length >= s->at + s->length && memcmp(bytes + s->at, s->bytes, s->length) == 0)
            return s;
    }
    size_t n = length < FIRST_PEEK ? length : FIRST_PEEK;
    for (size_t i = 0; i < n; i++) {
        unsigned char c = bytes[i];
        if (c == 0x7f || (c < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f'))
            return &binary;
    }
    return &plain_text;
}

/* ---- querying the readers -------------------------------------------------------------------- */

/* Passes of the detection. A later pass runs only if no reader has recognised the file. */
typedef enum detection_pass {
    PASS_SIGNATURES,
    PASS_TEXTS,
    PASS_TEXTS_OF_OTHER_KINDS,
    N_PASSES
} detection_pass;

/* Combined answers of a group of readers: the best reader, one with an equal score, and one that
 * recognises the file but cannot read it. */
typedef struct detection_result {
    const file_reader *best;
    const file_reader *tied;
    int score;
    const file_reader *unsupported;
    char reason[sizeof((recognition *)0)->reason];
} detection_result;

static void record_answer(detection_result *v, const file_reader *reader, const recognition *answer)
{
    if (answer->answer == ANSWER_UNSUPPORTED && v->unsupported == NULL) {
        v->unsupported = reader;
        memcpy(v->reason, answer->reason, sizeof v->reason);
        v->reason[sizeof v->reason - 1] = '\0';
    }
    if (answer->answer != ANSWER_YES)
        return;
    if (v->best == NULL || answer->score > v->score) {
        v->best = reader;
        v->score = answer->score;
        v->tied = NULL;
    } else if (answer->score == v->score) {
        v->tied = reader;
    }
}

static bool has_kind(const file_reader *reader, unsigned kinds)
{
    return kinds == 0 || (reader->info.kinds & kinds) != 0;
}

static bool is_in_pass(const file_reader *reader, detection_pass q, unsigned kinds)
{
    if (q == PASS_SIGNATURES || !reader_is_text(reader))
        return q == PASS_SIGNATURES && !reader_is_text(reader);
    return has_kind(reader, kinds) == (q == PASS_TEXTS);
}

/* Runs one pass. Element [1] collects the answers of the readers of the requested kinds, element
 * [0] those of all others. */
static wt_status query_readers(const wt_formats *formats, wt_input *input, detection_pass q,
                               unsigned kinds, detection_result results[2], wt_error *err)
{
    const size_t n = wt_formats_count(formats);
    wt_status status = WT_OK;
    const file_reader **open = wt_alloc(n, sizeof *open);
    size_t n_open = 0;
    for (size_t i = 0; i < n; i++)
        if (is_in_pass(formats_reader(formats, i), q, kinds))
            open[n_open++] = formats_reader(formats, i);
    size_t want = FIRST_PEEK;
    resource_error_clear();
    while (n_open > 0) {
        wt_error cause;
        file_peek peek = {.name = wt_input_name(input), .input = input, .err = &cause};
        size_t need = 0, still_open = 0;
        for (size_t i = 0; i < n_open && status == WT_OK; i++) {
            /* the reader before may have moved the bytes of the input */
            status = wt_input_peek(input, want, &peek.bytes, &peek.length, &peek.whole, err);
            if (status != WT_OK)
                break;
            cause = (wt_error)WT_ERROR_INIT;
            const recognition answer = open[i]->detect(open[i], &peek);
            if (answer.answer == ANSWER_FAILED) {
                status = cause.status;
                if (err != NULL)
                    *err = cause;
            }
            if (answer.answer == ANSWER_MORE && !peek.whole) {
                need = answer.need > need ? answer.need : need;
                open[still_open++] = open[i];
            } else {
                record_answer(&results[has_kind(open[i], kinds)], open[i], &answer);
            }
        }
        text_peek_free(peek.text);
        if (status != WT_OK)
            break;
        n_open = still_open;
        /* Doubling the size limits the number of iterations, whatever size the readers request. */
        size_t twice = want > SIZE_MAX / 2 ? SIZE_MAX : 2 * want;
        want = need > twice ? need : twice;
    }
    free(open);
    return resource_error_finish(status, err);
}

static const char *data_kind_name(unsigned kinds)
{
    switch (kinds) {
    case WT_KIND_FORCE:
        return "force curves";
    case WT_KIND_SWEEP:
        return "DMA sweeps";
    case WT_KIND_IMAGE:
        return "images";
    case WT_KIND_SPECTRUM:
        return "power spectra";
    case WT_KIND_RECORD:
        return "records of friction";
    default:
        return "data of the kind asked for";
    }
}

static wt_status fail_wrong_kind(const file_reader *reader, unsigned kinds, wt_error *err)
{
    wt_fail(err, WT_E_EMPTY, "this format holds no %s", data_kind_name(kinds));
    wt_error_found(err, "%s (%s)", reader->info.title, reader->info.id);
    const unsigned reader_kinds = reader->info.kinds;
    const char *const fits = (reader_kinds & WT_KIND_FORCE) != 0    ? "weartrack indent"
                             : (reader_kinds & WT_KIND_SWEEP) != 0  ? "weartrack master"
                             : (reader_kinds & WT_KIND_IMAGE) != 0  ? "weartrack spot"
                             : (reader_kinds & WT_KIND_RECORD) != 0 ? "weartrack record"
                             : (reader_kinds & WT_KIND_SPECTRUM) != 0
                                 ? "weartrack friction --roughness"
                                 : NULL;
    if (fits != NULL)
        wt_error_advice(err, "`%s` takes %s", fits,
                        data_kind_name(reader_kinds & (~reader_kinds + 1)));
    return WT_E_EMPTY;
}

static wt_status fail_unknown(wt_input *input, unsigned kinds, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    bool whole = false;
    wt_status status = wt_input_peek(input, FIRST_PEEK, &bytes, &length, &whole, err);
    if (status != WT_OK)
        return status;
    const file_signature *like = classify_bytes(bytes, length);
    status = like->measured ? wt_fail(err, WT_E_UNSUPPORTED, "such a file is not read")
                            : wt_fail(err, WT_E_FORMAT, "file format not recognised");
    wt_error_found(err, "%s", like->label);
    if (like == &binary && (kinds & WT_KIND_IMAGE) != 0) {
        wt_error_options(err, "format");
        wt_error_advice(err, "--format gwyddion has the program Gwyddion read it, which knows many "
                             "height maps; or export it as .x3p, .gwy or .gsf");
    } else {
        wt_error_options(err, "%s", like->options);
        wt_error_advice(err, "%s", like->advice);
    }
    return status;
}

static wt_status fail_ambiguous(const file_reader *a, const file_reader *b, wt_error *err)
{
    wt_fail(err, WT_E_AMBIGUOUS, "two formats describe this file equally well");
    wt_error_found(err, "%s and %s", a->info.id, b->info.id);
    wt_error_advice(err, "choose with --format %s or --format %s", a->info.id, b->info.id);
    wt_error_options(err, "format");
    return WT_E_AMBIGUOUS;
}

/* The score of descriptions that recognise numbers without names. Such numbers fit any kind of
 * data, so a match of another kind is no reason to fail. */
static const int nameless_score = 5;

static wt_status detect(const wt_formats *formats, wt_input *input, unsigned kinds,
                        const file_reader **reader, wt_error *err)
{
    detection_result results[2] = {{.score = 0}};
    const detection_result *other = &results[0], *v = &results[1];
    for (detection_pass q = PASS_SIGNATURES; q < N_PASSES; q++) {
        wt_status status = query_readers(formats, input, q, kinds, results, err);
        if (status != WT_OK)
            return status;
        if (v->tied != NULL)
            return fail_ambiguous(v->best, v->tied, err);
        if (v->best != NULL) {
            *reader = v->best;
            return WT_OK;
        }
        if (other->best != NULL && other->score > nameless_score)
            return fail_wrong_kind(other->best, kinds, err);
        if (q == PASS_TEXTS && v->unsupported != NULL) {
            wt_fail(err, WT_E_UNSUPPORTED, "%s", v->reason);
            wt_error_found(err, "%s (%s)", v->unsupported->info.title, v->unsupported->info.id);
            return WT_E_UNSUPPORTED;
        }
    }
    return fail_unknown(input, kinds, err);
}

/* A tar archive of a text file would be read as that text between the header and the padding. An
 * archive of several files would be read as one text. */
static bool is_tar(wt_input *input)
{
    static const char mark[] = "ustar";
    enum { MARK = 257 };
    const unsigned char *bytes = NULL;
    size_t length = 0;
    bool whole = false;
    return wt_input_peek(input, FIRST_PEEK, &bytes, &length, &whole, NULL) == WT_OK &&
           length > MARK + sizeof mark && memcmp(bytes + MARK, mark, sizeof mark - 1) == 0;
}

/* Finds the reader of the bytes as they are: the reader of `format`, or with NULL the one
 * that recognises them. `kinds` limits the search (0: any). A recognised file without any of these
 * kinds is WT_E_EMPTY. */
static wt_status detect_reader(const wt_formats *formats, wt_input *input, const char *format,
                               unsigned kinds, const file_reader **reader, wt_error *err)
{
    wt_status status = WT_E_NOT_FOUND;
    if (is_tar(input)) {
        status = fail_unknown(input, kinds, err);
    } else if (format == NULL) {
        status = detect(formats, input, kinds, reader, err);
    } else {
        const file_reader *found = formats_find_reader(formats, format);
        if (found == NULL) {
            wt_fail(err, status, "there is no format \"%s\"", format);
            wt_error_advice(err, "see `weartrack formats list`");
        } else if (!has_kind(found, kinds)) {
            status = fail_wrong_kind(found, kinds, err);
        } else {
            *reader = found;
            status = WT_OK;
        }
    }
    if (status != WT_OK)
        wt_error_file(err, wt_input_name(input));
    return status;
}

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
