/* Reads Office Open XML spreadsheets: a ZIP archive of XML. Numbers are read as written, texts from
 * the shared strings; a formula has the value that was saved with it. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/memory.h"
#include "read/bytes/zip.h"
#include "read/packed/packed.h"

#include <libxml/xmlreader.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#define MIB ((size_t)1 << 20)
#define MAX_ENTRY_SIZE (512 * MIB)
/* Limits of the programs that write the format; ECMA-376 has none. */
enum { MAX_COLUMNS = 16384, MAX_ROWS = 1048576 };

bool xlsx_is_workbook(const unsigned char *bytes, size_t length)
{
    /* the name of the first entry follows its header of 30 bytes */
    static const char *const first[] = {"[Content_Types].xml", "_rels/", "docProps/", "xl/"};
    if (length < 30 || memcmp(bytes, "PK\3\4", 4) != 0)
        return false;
    for (size_t i = 0; i < COUNT_OF(first); i++) {
        const size_t n = strlen(first[i]);
        if (length >= 30 + n && memcmp(bytes + 30, first[i], n) == 0)
            return true;
    }
    return false;
}

/* ---- XML of an entry ------------------------------------------------------------------------- */

typedef struct xml_part {
    const char *name; /* name of the entry */
    byte_buffer bytes;
    xmlTextReader *xml;
} xml_part;

static void part_close(xml_part *p)
{
    if (p->xml != NULL)
        xmlFreeTextReader(p->xml);
    free(p->bytes.data);
    *p = (xml_part){.name = NULL};
}

/* Opens an entry; WT_END if there is none. */
static wt_status part_open(zip_archive *zip, const char *name, xml_part *p, wt_error *err)
{
    size_t i = 0;
    *p = (xml_part){.name = name};
    if (!archive_find(zip, name, &i))
        return WT_END;
    wt_status status = archive_read(zip, i, MAX_ENTRY_SIZE, &p->bytes, err);
    if (status == WT_OK && p->bytes.length > INT_MAX)
        status = wt_fail(err, WT_E_UNSUPPORTED, "a part of the spreadsheet is too large");
    if (status == WT_OK) {
        p->xml = xmlReaderForMemory((const char *)p->bytes.data, (int)p->bytes.length, NULL, NULL,
                                    XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING);
        if (p->xml == NULL)
            out_of_memory(0);
    }
    if (status != WT_OK)
        part_close(p);
    return status;
}

static wt_status fail_part(const xml_part *p, wt_error *err, const char *what)
{
    wt_fail(err, WT_E_CORRUPT, "%s", what);
    wt_error_place(err, "%s", p->name);
    wt_error_advice(err, "open the file in a spreadsheet program and save it again, or as CSV");
    return WT_E_CORRUPT;
}

/* Moves to the next node; WT_END after the last one. A document type is refused, since it could
 * define entities. */
static wt_status part_next(const xml_part *p, wt_error *err)
{
    const int more = xmlTextReaderRead(p->xml);
    if (more == 0)
        return WT_END;
    if (more < 0)
        return fail_part(p, err, "a part of the spreadsheet is not well-formed XML");
    const int type = xmlTextReaderNodeType(p->xml);
    if (type == XML_READER_TYPE_DOCUMENT_TYPE || type == XML_READER_TYPE_ENTITY_REFERENCE)
        return fail_part(p, err, "a part of the spreadsheet defines entities");
    return WT_OK;
}

static bool is_element_start(const xml_part *p, const char *name)
{
    return xmlTextReaderNodeType(p->xml) == XML_READER_TYPE_ELEMENT &&
           strcmp((const char *)xmlTextReaderConstLocalName(p->xml), name) == 0;
}

static bool is_element_end(const xml_part *p, const char *name)
{
    const int type = xmlTextReaderNodeType(p->xml);
    return (type == XML_READER_TYPE_END_ELEMENT ||
            (type == XML_READER_TYPE_ELEMENT && xmlTextReaderIsEmptyElement(p->xml) == 1)) &&
           strcmp((const char *)xmlTextReaderConstLocalName(p->xml), name) == 0;
}

static const char *node_text(const xml_part *p)
{
    const int type = xmlTextReaderNodeType(p->xml);
    if (type != XML_READER_TYPE_TEXT && type != XML_READER_TYPE_CDATA &&
        type != XML_READER_TYPE_SIGNIFICANT_WHITESPACE)
        return NULL;
    return (const char *)xmlTextReaderConstValue(p->xml);
}

/* Returns a copy of the attribute with this local name; NULL if it is absent. */
static char *copy_attribute(const xml_part *p, const char *name)
{
    char *copy = NULL;
    int more = xmlTextReaderMoveToFirstAttribute(p->xml);
    for (; more == 1 && copy == NULL; more = xmlTextReaderMoveToNextAttribute(p->xml)) {
        const char *value = (const char *)xmlTextReaderConstValue(p->xml);
        if (value != NULL && strcmp((const char *)xmlTextReaderConstLocalName(p->xml), name) == 0)
            copy = wt_strdup(value);
    }
    (void)xmlTextReaderMoveToElement(p->xml);
    return copy;
}

/* ---- texts ----------------------------------------------------------------------------------- */

/* Concatenated texts. */
typedef struct string_pool {
    char *bytes;
    size_t length, capacity;
    size_t *end; /* end of each text */
    size_t n;
} string_pool;

static void string_pool_clear(string_pool *t)
{
    free(t->bytes);
    free(t->end);
    *t = (string_pool){.bytes = NULL};
}

static void string_pool_append(string_pool *t, const char *piece)
{
    const size_t n = strlen(piece);
    if (n == 0)
        return;
    if (t->capacity - t->length < n) {
        t->capacity = 2 * (t->capacity + n);
        t->bytes = wt_realloc(t->bytes, t->capacity, 1);
    }
    memcpy(t->bytes + t->length, piece, n);
    t->length += n;
}

static void string_pool_end_text(string_pool *t)
{
    t->end = array_grow(t->end, t->n, sizeof *t->end);
    t->end[t->n++] = t->length;
}

/* Reads the shared strings; phonetic guides (rPh) are skipped. */
static wt_status read_string_table(zip_archive *zip, string_pool *strings, wt_error *err)
{
    xml_part p;
    bool in_text = false, is_phonetic = false;
    wt_status status = part_open(zip, "xl/sharedStrings.xml", &p, err);
    if (status == WT_END)
        return WT_OK;
    while (status == WT_OK && (status = part_next(&p, err)) == WT_OK) {
        const char *piece = node_text(&p);
        if (piece != NULL && in_text && !is_phonetic)
            string_pool_append(strings, piece);
        if (is_element_start(&p, "rPh"))
            is_phonetic = true;
        if (is_element_end(&p, "rPh"))
            is_phonetic = false;
        if (is_element_start(&p, "t"))
            in_text = true;
        if (is_element_end(&p, "t"))
            in_text = false;
        if (is_element_end(&p, "si"))
            string_pool_end_text(strings);
    }
    part_close(&p);
    return status == WT_END ? WT_OK : status;
}

/* ---- cells ----------------------------------------------------------------------------------- */

typedef enum xlsx_cell_kind { CELL_VALUE, CELL_SHARED, CELL_INLINE, CELL_NOTHING } xlsx_cell_kind;

/* The state of the current cell. */
typedef struct sheet_cell {
    size_t row, column;
    xlsx_cell_kind kind;
    string_pool text; /* characters read so far */
    bool in_text;
} sheet_cell;

/* Parses the column of a reference: "BC12" is column 54. The row is taken from the row element.
 * False for no reference. */
static bool parse_column_letters(const char *reference, size_t *column)
{
    size_t c = 0;
    const char *at = reference;
    for (; *at >= 'A' && *at <= 'Z' && c <= MAX_COLUMNS; at++)
        c = 26 * c + (size_t)(*at - 'A') + 1;
    if (at == reference || c > MAX_COLUMNS)
        return false;
    *column = c - 1;
    return true;
}

static bool parse_index(const char *text, size_t max_length, size_t *count)
{
    char *end = NULL;
    if (*text < '0' || *text > '9')
        return false;
    const unsigned long long n = strtoull(text, &end, 10);
    if (*end != '\0' || n > max_length)
        return false;
    *count = (size_t)n;
    return true;
}

static wt_status begin_sheet_row(const xml_part *p, sheet_cell *c, wt_error *err)
{
    char *number = copy_attribute(p, "r");
    size_t row = c->row + 2; /* counted from 1, after the last one; SIZE_MAX + 2 is 1 */
    bool good = number == NULL || parse_index(number, MAX_ROWS, &row);
    free(number);
    good = good && row >= 1 && row <= MAX_ROWS && (c->row == SIZE_MAX || row - 1 > c->row);
    if (!good)
        return fail_part(p, err, "the rows of a sheet are not numbered one after the other");
    c->row = row - 1;
    c->column = SIZE_MAX;
    return WT_OK;
}

static wt_status begin_sheet_cell(const xml_part *p, sheet_cell *c, wt_error *err)
{
    static const struct {
        const char *type;
        xlsx_cell_kind kind;
    } kinds[] = {{"s", CELL_SHARED}, {"inlineStr", CELL_INLINE}, {"e", CELL_NOTHING}};
    char *reference = copy_attribute(p, "r"), *type = copy_attribute(p, "t");
    size_t column = c->column + 1;
    const bool good = (reference == NULL || parse_column_letters(reference, &column)) &&
                      column < MAX_COLUMNS && (c->column == SIZE_MAX || column > c->column) &&
                      c->row != SIZE_MAX;
    c->kind = CELL_VALUE;
    for (size_t i = 0; i < COUNT_OF(kinds) && type != NULL; i++)
        if (strcmp(type, kinds[i].type) == 0)
            c->kind = kinds[i].kind;
    free(reference);
    free(type);
    if (!good)
        return fail_part(p, err, "the cells of a row do not stand one after the other");
    c->column = column;
    c->text.length = 0;
    return WT_OK;
}

static wt_status end_sheet_cell(const xml_part *p, sheet_cell *c, const string_pool *strings,
                                sheet_text *out, wt_error *err)
{
    const char *text = c->text.bytes;
    size_t length = c->text.length;
    if (c->kind == CELL_NOTHING || length == 0)
        return WT_OK;
    if (c->kind == CELL_SHARED) {
        size_t i = 0;
        if (length >= 20)
            return fail_part(p, err, "a cell names no text");
        char number[20];
        memcpy(number, text, length);
        number[length] = '\0';
        if (!parse_index(number, SIZE_MAX / 2, &i) || i >= strings->n)
            return fail_part(p, err, "a cell names a text that is not there");
        const size_t from = i > 0 ? strings->end[i - 1] : 0;
        text = strings->bytes + from;
        length = strings->end[i] - from;
    }
    return length == 0 || sheet_add_cell(out, c->row, c->column, text, length)
               ? WT_OK
               : sheet_fail(p->name, err);
}

/* Processes one node of a sheet. */
static wt_status read_sheet_node(const xml_part *p, sheet_cell *c, const string_pool *strings,
                                 sheet_text *out, wt_error *err)
{
    wt_status status = WT_OK;
    const char *mark = c->kind == CELL_INLINE ? "t" : "v";
    const char *piece = node_text(p);
    if (piece != NULL && c->in_text)
        string_pool_append(&c->text, piece);
    if (is_element_start(p, "row"))
        status = begin_sheet_row(p, c, err);
    else if (is_element_start(p, "c"))
        status = begin_sheet_cell(p, c, err);
    else if (is_element_start(p, mark))
        c->in_text = true;
    if (status == WT_OK && is_element_end(p, mark))
        c->in_text = false;
    if (status == WT_OK && is_element_end(p, "c"))
        status = end_sheet_cell(p, c, strings, out, err);
    return status;
}

/* Reads a sheet; WT_END for a chart, which has no rows. */
static wt_status read_sheet(zip_archive *zip, const char *entry, const string_pool *strings,
                            const workbook *book, sheet_text *out, wt_error *err)
{
    xml_part p;
    sheet_cell c = {.row = SIZE_MAX, .column = SIZE_MAX};
    bool is_sheet = false;
    wt_status status = part_open(zip, entry, &p, err);
    if (status == WT_END) {
        wt_fail(err, WT_E_CORRUPT, "a sheet of the spreadsheet is missing");
        wt_error_place(err, "%s", entry);
        return WT_E_CORRUPT;
    }
    if (status == WT_OK)
        out->max_length =
            workbook_text_limit(book, 16 * MIB + 4 * (p.bytes.length + strings->length));
    while (status == WT_OK && (status = part_next(&p, err)) == WT_OK) {
        is_sheet = is_sheet || is_element_start(&p, "worksheet");
        status = read_sheet_node(&p, &c, strings, out, err);
    }
    string_pool_clear(&c.text);
    part_close(&p);
    return status == WT_END && is_sheet ? WT_OK : status;
}

/* ---- the book -------------------------------------------------------------------------------- */

/* Reads the relations of the workbook as pairs of id and entry. */
static wt_status read_relations(zip_archive *zip, string_pool *relations, wt_error *err)
{
    xml_part p;
    wt_status status = part_open(zip, "xl/_rels/workbook.xml.rels", &p, err);
    while (status == WT_OK && (status = part_next(&p, err)) == WT_OK) {
        if (!is_element_start(&p, "Relationship"))
            continue;
        char *id = copy_attribute(&p, "Id"), *target = copy_attribute(&p, "Target");
        const bool absolute = target != NULL && target[0] == '/';
        if (id != NULL && target != NULL) {
            string_pool_append(relations, id);
            string_pool_end_text(relations);
            string_pool_append(relations, absolute ? "" : "xl/");
            string_pool_append(relations, absolute ? target + 1 : target);
            string_pool_end_text(relations);
        }
        free(id);
        free(target);
    }
    part_close(&p);
    return status == WT_END ? WT_OK : status;
}

/* Returns a copy of the entry of a relation; NULL if there is none. */
static char *find_relation_entry(const string_pool *relations, const char *id)
{
    const size_t length = strlen(id);
    for (size_t i = 0; i + 1 < relations->n; i += 2) {
        const size_t from = i > 0 ? relations->end[i - 1] : 0, middle = relations->end[i];
        if (middle - from == length && memcmp(relations->bytes + from, id, length) == 0)
            return wt_strndup(relations->bytes + middle, relations->end[i + 1] - middle);
    }
    return NULL;
}

static wt_status add_sheet(zip_archive *zip, const xml_part *p, const string_pool *relations,
                           const string_pool *strings, workbook *book, wt_error *err)
{
    char *name = copy_attribute(p, "name"), *id = copy_attribute(p, "id"),
         *state = copy_attribute(p, "state");
    char *entry = id != NULL ? find_relation_entry(relations, id) : NULL;
    sheet_text text = {.bytes = NULL};
    wt_status status = WT_OK;
    if (name == NULL || id == NULL)
        status = fail_part(p, err, "a sheet has no name, or no place");
    if (status == WT_OK && entry == NULL)
        status = fail_part(p, err, "a sheet has no place in the file");
    if (status == WT_OK)
        status = read_sheet(zip, entry, strings, book, &text, err);
    if (status == WT_OK)
        status =
            workbook_add(book, name, state != NULL && strcmp(state, "visible") != 0, &text, err);
    free(text.bytes);
    free(entry);
    free(state);
    free(id);
    free(name);
    return status == WT_END ? WT_OK : status;
}

wt_status xlsx_read(wt_input *input, workbook *book, wt_error *err)
{
    zip_archive *zip = NULL;
    string_pool strings = {.bytes = NULL}, relations = {.bytes = NULL};
    xml_part p = {.name = NULL};
    wt_status status = archive_open(input, &zip, err);
    if (status == WT_OK && zip->defect != NULL)
        status = wt_fail(err, WT_E_CORRUPT, "spreadsheet: %s", zip->defect);
    if (status == WT_OK)
        status = part_open(zip, "xl/workbook.xml", &p, err);
    if (status == WT_END) {
        status = wt_fail(err, WT_E_FORMAT, "not a spreadsheet");
        wt_error_found(err, "a document or an archive of another program");
        wt_error_advice(err, "give the file that the instrument exported, as text or CSV");
    }
    if (status == WT_OK)
        status = read_string_table(zip, &strings, err);
    if (status == WT_OK)
        status = read_relations(zip, &relations, err);
    while (status == WT_OK && (status = part_next(&p, err)) == WT_OK)
        if (is_element_start(&p, "sheet"))
            status = add_sheet(zip, &p, &relations, &strings, book, err);
    status = status == WT_END ? WT_OK : status;
    part_close(&p);
    string_pool_clear(&relations);
    string_pool_clear(&strings);
    archive_close(zip);
    if (status != WT_OK)
        workbook_clear(book);
    return status;
}
