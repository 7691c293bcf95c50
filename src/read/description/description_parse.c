/* Parses the XML of a format description, with a function for each element.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/description/description_xml.h"

#include "core/base/memory.h"
#include "read/embedded_formats.h"

#include <errno.h>
#include <libxml/parser.h>
#include <libxml/xmlschemas.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Names in the order of wt_segment_kind. */
static const char *const segment_kinds[] = {"approach", "retract", "dwell", "modulation", "other"};
#define N_SEGMENT_KINDS (sizeof segment_kinds / sizeof *segment_kinds)

static wt_quantity quantity_attribute(description_parser *p, const xmlNode *node)
{
    const char *id = parse_attribute(p, node, "quantity");
    wt_quantity quantity = WT_Q_NONE;
    if (id != NULL && !wt_quantity_find(id, &quantity))
        parse_fail(p, node, "unknown quantity", "a quantity of the schema", id);
    return quantity;
}

static void check_unit_attribute(description_parser *p, const xmlNode *node, const char *unit,
                                 wt_quantity quantity)
{
    double factor = 1, offset = 0;
    char expected[128];
    if (p->status != WT_OK || unit == NULL ||
        wt_unit_to_si(unit, quantity, &factor, &offset, NULL) == WT_OK)
        return;
    snprintf(expected, sizeof expected, "a unit of %s, such as %s", wt_quantity_id(quantity),
             wt_quantity_unit(quantity));
    parse_fail(p, node, "the unit does not fit the quantity", expected, unit);
}

static void read_detect_element(description_parser *p, const xmlNode *detect)
{
    static const char *const kinds[] = {"require", "hint", "forbid", "names"};
    text_description *d = p->d;
    bool decides = false;
    int score = 0;
    d->probes = parse_alloc_children(p, detect, NULL, sizeof *d->probes);
    for (const xmlNode *c = NULL; (c = parse_next_child(p, detect, c, NULL)) != NULL;) {
        text_probe *probe = &d->probes[d->n_probes++];
        for (size_t k = 0; k < 4; k++)
            if (parse_is_element(c, kinds[k]))
                probe->kind = (probe_kind)k;
        decides |= probe->kind == PROBE_REQUIRE || probe->kind == PROBE_NAMES;
        probe->within = parse_count(p, c, "within", 100);
        probe->score = (int)parse_count(p, c, "score", 0);
        score += probe->kind == PROBE_FORBID ? 0 : probe->score;
        if (probe->kind == PROBE_NAMES)
            continue;
        probe->text = parse_attribute(p, c, "text");
        parse_pattern(p, c, "regex", &probe->pattern, 0);
        if ((probe->text != NULL) == probe->pattern.compiled)
            parse_fail(p, c, "what is looked for must be said once", "either text or regex",
                       probe->text != NULL ? "both" : "neither");
    }
    if (!decides)
        parse_fail(p, detect, "nothing distinguishes a file of this format from others",
                   "at least one require or names element", NULL);
    if (score < 1)
        parse_fail(p, detect, "a match would count nothing", "a score of 1 to 100",
                   "no score in any element");
}

/* Splits an attribute at its blanks. */
static void read_token_list(description_parser *p, const xmlNode *node, const char *name,
                            char ***items, size_t *n)
{
    char *text = parse_attribute(p, node, name);
    char *rest = NULL;
    size_t max_words = 1;
    if (text == NULL)
        return;
    for (const char *c = text; *c != '\0'; c++)
        max_words += *c == ' ';
    *items = arena_alloc(&p->d->memory, max_words, sizeof **items);
    for (char *word = strtok_r(text, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest))
        (*items)[(*n)++] = word;
}

/* Splits an attribute into normalised column names. */
static void read_name_list(description_parser *p, const xmlNode *node, const char *name,
                           char ***items, size_t *n)
{
    read_token_list(p, node, name, items, n);
    for (size_t i = 0; i < *n; i++)
        (*items)[i] = parse_normalised(p, (*items)[i]);
}

static void read_text_element(description_parser *p, const xmlNode *node)
{
    static const char *const encodings[] = {"auto", "utf-8", "latin-1", "utf-16"};
    static const char *const separators[] = {"auto",  "tab",        "semicolon",
                                             "comma", "whitespace", "fixed"};
    static const char *const decimals[] = {"auto", "point", "comma"};
    static const char marks[] = {'\0', '.', ','};
    text_description *d = p->d;
    char **widths = NULL;
    size_t n = 0;
    d->encoding = (text_encoding)parse_choice(p, node, "encoding", encodings, 4, 0);
    d->separator = (cell_separator)parse_choice(p, node, "separator", separators, 6, 0);
    d->names_separator = (cell_separator)parse_choice(p, node, "names-separator", separators, 6,
                                                      (size_t)d->separator);
    d->decimal = marks[parse_choice(p, node, "decimal", decimals, 3, 0)];
    d->comment = parse_attribute(p, node, "comment");
    read_token_list(p, node, "missing", &d->missing, &d->n_missing);
    read_token_list(p, node, "widths", &widths, &n);
    d->widths = arena_alloc(&d->memory, n, sizeof *d->widths);
    for (size_t i = 0; i < n; i++)
        d->widths[d->n_widths++] = (size_t)strtoul(widths[i], NULL, 10);
    bool fixed = d->separator == SEPARATOR_FIXED || d->names_separator == SEPARATOR_FIXED;
    if (fixed != (n > 0))
        parse_fail(p, node, "fixed columns and their widths belong together",
                   "separator=\"fixed\" with widths=\"...\"", fixed ? "no widths" : "only widths");
    if (d->separator == SEPARATOR_COMMA && d->decimal == ',')
        parse_fail(p, node, "a comma cannot be both", "another separator or decimal=\"point\"",
                   "separator and decimal mark are commas");
}

static void read_header_element(description_parser *p, const xmlNode *node)
{
    static const char *const sets[] = {"decimal", "separator",  "sample",       "rows",
                                       "title",   "value-unit", "value-factor", "width",
                                       "height",  "pixel-size"};
    const size_t n_sets = sizeof sets / sizeof *sets;
    text_description *d = p->d;
    d->fields = parse_alloc_children(p, node, "field", sizeof *d->fields);
    for (const xmlNode *c = NULL; (c = parse_next_child(p, node, c, "field")) != NULL;) {
        header_field *field = &d->fields[d->n_fields++];
        field->name = parse_attribute(p, c, "name");
        field->group = parse_count(p, c, "group", 1);
        field->unit_group = parse_count(p, c, "unit-group", 0);
        parse_pattern(p, c, "regex", &field->pattern,
                      field->group > field->unit_group ? field->group : field->unit_group);
        field->quantity = quantity_attribute(p, c);
        field->unit = parse_attribute(p, c, "unit");
        field->fallback = parse_bool(p, c, "fallback");
        field->sets = (field_sets)(parse_choice(p, c, "sets", sets, n_sets, (size_t)-1) + 1);
        if (field->quantity == WT_Q_NONE)
            continue;
        if (find_header_value(field->quantity, field->sets) == HEADER_COUNT)
            parse_fail(
                p, c, "a header line cannot give this quantity",
                "temperature, angular_frequency, spring_constant, sensitivity, position_x, "
                "position_y, velocity, "
                "time (duration), force (set-point), normal_force, or length for a radius or what "
                "sets a size or a factor",
                wt_quantity_id(field->quantity));
        check_unit_attribute(p, c, field->unit, field->quantity);
        if ((field->unit != NULL) == (field->unit_group > 0))
            parse_fail(p, c, "the unit of a header value must be said once",
                       "either unit or unit-group", field->unit != NULL ? "both" : "neither");
    }
}

static int compare_column_names(const void *a, const void *b)
{
    const column_name *x = a, *y = b;
    int order = strcmp(x->name, y->name);
    if (order != 0)
        return order;
    return (x->rule > y->rule) - (x->rule < y->rule);
}

static void read_column_elements(description_parser *p, const xmlNode *table)
{
    text_description *d = p->d;
    size_t n = 0;
    d->rules = parse_alloc_children(p, table, "column", sizeof *d->rules);
    for (const xmlNode *c = NULL; (c = parse_next_child(p, table, c, "column")) != NULL;)
        n += parse_count_children(p, c, "name");
    d->names = arena_alloc(&d->memory, n, sizeof *d->names);
    for (const xmlNode *c = NULL; (c = parse_next_child(p, table, c, "column")) != NULL;) {
        column_rule *rule = &d->rules[d->n_rules];
        size_t kind =
            parse_choice(p, c, "segment", segment_kinds, N_SEGMENT_KINDS, N_SEGMENT_KINDS);
        rule->quantity = quantity_attribute(p, c);
        rule->unit = parse_attribute(p, c, "unit");
        rule->required_name = parse_normalised(p, parse_attribute(p, c, "with"));
        rule->has_segment = kind < N_SEGMENT_KINDS;
        rule->segment = kind < N_SEGMENT_KINDS ? (wt_segment_kind)kind : WT_SEGMENT_OTHER;
        rule->negate = parse_bool(p, c, "negate");
        rule->assumed = parse_attribute(p, c, "assumed");
        check_unit_attribute(p, c, rule->unit, rule->quantity);
        for (const xmlNode *name = NULL; (name = parse_next_child(p, c, name, "name")) != NULL;) {
            d->names[d->n_names].rule = d->n_rules;
            d->names[d->n_names].name = parse_normalised(p, parse_content(p, name));
            if (p->status == WT_OK)
                d->n_names++;
        }
        d->n_rules++;
    }
    if (d->n_names > 1)
        qsort(d->names, d->n_names, sizeof *d->names, compare_column_names);
}

static void read_table_element(description_parser *p, const xmlNode *table)
{
    static const char *const units[] = {"row", "name", "name-or-row", "line", "none"};
    static const char *const titles[] = {"same", "next"};
    static const char *const blanks[] = {"skip", "block"};
    static const char *const row_layouts[] = {"values", "matrix"};
    text_description *d = p->d;
    d->names_are = parse_attribute(p, table, "names-are");
    parse_pattern(p, table, "names-lines", &d->names_lines, 1);
    const bool elsewhere = d->names_are != NULL || d->names_lines.compiled;
    parse_pattern(p, table, "names", &d->names_line, elsewhere ? 0 : 1);
    d->has_names_line = d->names_line.compiled;
    d->matrix = parse_choice(p, table, "rows", row_layouts, 2, 0) == 1;
    if (d->names_lines.compiled && (!d->has_names_line || d->names_are != NULL))
        parse_fail(p, table, "names that stand elsewhere go with the line above the rows",
                   "an attribute names, and either names-are or names-lines", NULL);
    d->units = (units_location)parse_choice(p, table, "units", units, 5, 0);
    parse_pattern(p, table, "units-line", &d->units_line, 1);
    if ((d->units == UNITS_LINE) != d->units_line.compiled)
        parse_fail(p, table, "a line of units must be described", "units=\"line\" with units-line",
                   d->units_line.compiled ? "only units-line" : "no units-line");
    if (d->units == UNITS_LINE && !d->has_names_line)
        parse_fail(p, table, "a line of units goes with a line of names", "an attribute names",
                   NULL);
    if (description_is_nameless(d) && d->units != UNITS_NONE)
        parse_fail(p, table, "without a row of names there is none of units", "units=\"none\"",
                   NULL);
    d->row_prefix = parse_normalised(p, parse_attribute(p, table, "row-prefix"));
    read_name_list(p, table, "row-number", &d->row_numbers, &d->n_row_numbers);
    d->flag_column = parse_normalised(p, parse_attribute(p, table, "flag-column"));
    read_name_list(p, table, "flags", &d->flags, &d->n_flags);
    if ((d->flag_column != NULL) != (d->n_flags > 0) ||
        (d->n_flags > 0 && d->kinds != WT_KIND_SWEEP))
        parse_fail(p, table, "a column of flags and its flags belong together, in a sweep",
                   "kinds=\"sweep\", and flag-column with flags", NULL);
    d->blank_is_block = parse_choice(p, table, "blank", blanks, 2, 0) == 1;
    d->steps = parse_alloc_children(p, table, "step", sizeof *d->steps);
    d->end_markers = parse_alloc_children(p, table, "end", sizeof *d->end_markers);
    d->unread_tests = parse_alloc_children(p, table, "other", sizeof *d->unread_tests);
    d->aliases = parse_alloc_children(p, table, "unit", sizeof *d->aliases);
    for (const xmlNode *c = NULL; (c = parse_next_child(p, table, c, "step")) != NULL;) {
        step_marker *step = &d->steps[d->n_steps++];
        step->title_next = parse_choice(p, c, "title", titles, 2, 0) == 1;
        parse_pattern(p, c, "regex", &step->pattern, step->title_next ? 0 : 1);
    }
    for (const xmlNode *c = NULL; (c = parse_next_child(p, table, c, "end")) != NULL;) {
        parse_pattern(p, c, "regex", &d->end_markers[d->n_end_markers++], 0);
        d->end_required = parse_bool(p, c, "required") || d->end_required;
    }
    for (const xmlNode *c = NULL; (c = parse_next_child(p, table, c, "other")) != NULL;) {
        unread_test *other = &d->unread_tests[d->n_unread_tests++];
        parse_pattern(p, c, "regex", &other->pattern, 0);
        other->label = parse_attribute(p, c, "what");
    }
    for (const xmlNode *c = NULL; (c = parse_next_child(p, table, c, "unit")) != NULL;) {
        unit_alias *alias = &d->aliases[d->n_aliases++];
        alias->found = parse_attribute(p, c, "found");
        alias->means = parse_attribute(p, c, "means");
    }
    if (p->status == WT_OK)
        read_column_elements(p, table);
}

static void read_isotherms_element(description_parser *p, const xmlNode *node)
{
    const char *jump = parse_attribute(p, node, "temperature-jump");
    p->d->group = parse_normalised(p, parse_attribute(p, node, "group"));
    read_name_list(p, node, "sample", &p->d->samples, &p->d->n_samples);
    read_name_list(p, node, "repeating", &p->d->repeating, &p->d->n_repeating);
    if (jump != NULL && (wt_quantity_parse(jump, WT_Q_TEMPERATURE_DIFFERENCE,
                                           &p->d->temperature_jump, NULL) != WT_OK ||
                         !(p->d->temperature_jump > 0)))
        parse_fail(p, node, "not a temperature difference", "a positive one with its unit, \"5 K\"",
                   jump);
}

static wt_segment_kind segment_kind_attribute(description_parser *p, const xmlNode *node)
{
    return (wt_segment_kind)parse_choice(p, node, "kind", segment_kinds, N_SEGMENT_KINDS,
                                         WT_SEGMENT_OTHER);
}

static void read_segments_element(description_parser *p, const xmlNode *node)
{
    text_description *d = p->d;
    d->segment_column = parse_normalised(p, parse_attribute(p, node, "column"));
    d->curve_column = parse_normalised(p, parse_attribute(p, node, "curve"));
    d->turning_point = parse_bool(p, node, "turning-point");
    d->markers = parse_alloc_children(p, node, "marker", sizeof *d->markers);
    d->values = parse_alloc_children(p, node, "value", sizeof *d->values);
    for (const xmlNode *c = NULL; (c = parse_next_child(p, node, c, "marker")) != NULL;) {
        segment_marker *marker = &d->markers[d->n_markers++];
        marker->kind = segment_kind_attribute(p, c);
        parse_pattern(p, c, "regex", &marker->pattern, 0);
    }
    for (const xmlNode *c = NULL; (c = parse_next_child(p, node, c, "value")) != NULL;) {
        segment_marker *value = &d->values[d->n_values++];
        value->kind = segment_kind_attribute(p, c);
        value->text = parse_attribute(p, c, "text");
    }
    if ((d->segment_column != NULL) != (d->n_values > 0))
        parse_fail(p, node, "a segment column and its values belong together",
                   "column=\"NAME\" with value elements",
                   d->n_values > 0 ? "only values" : "no values");
}

static unsigned parse_kinds(const char *kind_names)
{
    unsigned kinds = 0;
    kinds |= strstr(kind_names, "force") != NULL ? WT_KIND_FORCE : 0u;
    kinds |= strstr(kind_names, "sweep") != NULL ? WT_KIND_SWEEP : 0u;
    kinds |= strstr(kind_names, "image") != NULL ? WT_KIND_IMAGE : 0u;
    kinds |= strstr(kind_names, "spectrum") != NULL ? WT_KIND_SPECTRUM : 0u;
    kinds |= strstr(kind_names, "record") != NULL ? WT_KIND_RECORD : 0u;
    return kinds;
}

static void parse_section(description_parser *p, const xmlNode *root, const char *name,
                          void (*read)(description_parser *p, const xmlNode *node))
{
    const xmlNode *const node = parse_next_child(p, root, NULL, name);
    if (node != NULL)
        read(p, node);
}

/* Parses it up to DESCRIPTION_DETECT. */
static void parse_detect(description_parser *p, const xmlNode *root)
{
    p->d->extent = DESCRIPTION_DETECT;
    parse_section(p, root, "detect", read_detect_element);
    parse_section(p, root, "text", read_text_element);
}

/* Parses a document that follows the schema. */
static void parse_format(description_parser *p, const xmlNode *root)
{
    text_description *d = p->d;
    const char *const kinds = parse_attribute(p, root, "kinds");
    d->id = parse_attribute(p, root, "id");
    d->version = parse_attribute(p, root, "version");
    d->kinds = kinds != NULL ? parse_kinds(kinds) : 0;
    d->verified = parse_bool(p, root, "verified");
    d->title = parse_content(p, parse_next_child(p, root, NULL, "title"));
    d->evidence = parse_content(p, parse_next_child(p, root, NULL, "evidence"));
    parse_detect(p, root);
    parse_section(p, root, "header", read_header_element);
    parse_section(p, root, "table", read_table_element);
    parse_section(p, root, "isotherms", read_isotherms_element);
    parse_section(p, root, "segments", read_segments_element);
    d->extent = DESCRIPTION_WHOLE;
    if (p->status == WT_OK)
        p->status = description_check_whole(d, p->name, p->err);
}

/* ---- schema ------------------------------------------------------------------------------- */

static const embedded_text *find_embedded_schema(void)
{
    const embedded_text *e = embedded_formats;
    while (e->name != NULL && strcmp(e->name, "weartrack-format.xsd") != 0)
        e++;
    return e;
}

const char *wt_formats_schema(void)
{
    return find_embedded_schema()->text;
}

static void note_memory_error(void *user, xmlErrorPtr error)
{
    (void)user;
    /* an internal error of libxml2 is also lack of memory */
    if (error != NULL && (error->code == XML_ERR_NO_MEMORY || error->code == XML_SCHEMAV_INTERNAL))
        resource_error_note(ENOMEM);
}

wt_status description_xsd_new(description_xsd **schema, wt_error *err)
{
    const embedded_text *text = find_embedded_schema();
    xmlSchemaParserCtxtPtr context = xmlSchemaNewMemParserCtxt(text->text, (int)text->length);
    if (context != NULL) {
        xmlSchemaSetParserStructuredErrors(context, note_memory_error, NULL);
        *schema = xmlSchemaParse(context);
        xmlSchemaFreeParserCtxt(context);
        if (*schema != NULL)
            return WT_OK;
    }
    /* The schema is part of the library and valid, so only memory can be missing. */
    return wt_fail(err, WT_E_MEMORY, "no memory for the schema of descriptions");
}

void description_xsd_free(description_xsd *schema)
{
    xmlSchemaFree(schema);
}

/* ---- document ----------------------------------------------------------------------------- */

static void record_xml_error(description_parser *p, const xmlError *error, const char *otherwise)
{
    char text[256];
    const char *message = error != NULL && error->message != NULL ? error->message : otherwise;
    size_t length = strcspn(message, "\r\n");
    if (p->status != WT_OK)
        return;
    snprintf(text, sizeof text, "%.*s", (int)(length < 255 ? length : 255), message);
    p->status = wt_fail(p->err, WT_E_SCHEMA, "%s", text);
    wt_error_file(p->err, p->name);
    if (error != NULL && error->line > 0)
        wt_error_place(p->err, "line %d", error->line);
    wt_error_advice(p->err, "see weartrack-format(5)");
}

static void record_first_error(void *user, xmlErrorPtr error)
{
    note_memory_error(NULL, error);
    record_xml_error(user, error, "not valid");
}

static void validate_document(description_parser *p, description_xsd *schema, xmlDocPtr document)
{
    xmlSchemaValidCtxtPtr context = xmlSchemaNewValidCtxt(schema);
    if (context == NULL) {
        parse_no_memory(p);
        return;
    }
    xmlSchemaSetValidStructuredErrors(context, record_first_error, p);
    if (xmlSchemaValidateDoc(context, document) != 0)
        record_xml_error(p, NULL, "the document does not follow the schema of descriptions");
    xmlSchemaFreeValidCtxt(context);
}

/* Parses a document with the function `parse`. With schema NULL the document
 * is assumed to be valid. */
static wt_status parse_document(description_xsd *schema, const char *xml, size_t length,
                                const char *name,
                                void (*parse)(description_parser *p, const xmlNode *root),
                                text_description **description, wt_error *err)
{
    const size_t max_length = (size_t)1 << 20;
    /* libxml2 prints encoding errors to standard error unless this thread has a handler. */
    const xmlStructuredErrorFunc previous = xmlStructuredError;
    void *const previous_context = xmlStructuredErrorContext;
    description_parser p = {.name = name, .status = WT_OK, .err = err};
    xmlParserCtxtPtr context = NULL;
    xmlDocPtr document = NULL;
    if (length > max_length) {
        wt_fail(err, WT_E_SCHEMA, "too long for a format description");
        wt_error_file(err, name);
        wt_error_expected(err, "at most 1 MiB");
        return WT_E_SCHEMA;
    }
    p.d = wt_alloc(1, sizeof *p.d);
    p.d->temperature_jump = (double)NAN;
    p.d->xml = arena_text(&p.d->memory, xml, length);
    context = xmlNewParserCtxt();
    if (context == NULL)
        parse_no_memory(&p);
    if (p.status == WT_OK) {
        xmlSetStructuredErrorFunc(NULL, note_memory_error);
        document = xmlCtxtReadMemory(context, xml, (int)length, NULL, NULL,
                                     XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING |
                                         XML_PARSE_NOCDATA);
        if (document == NULL)
            record_xml_error(&p, xmlCtxtGetLastError(context), "not well-formed XML");
        else if (document->intSubset != NULL)
            record_xml_error(&p, NULL,
                             "a document type or entities are not allowed in a description");
    }
    if (p.status == WT_OK && schema != NULL)
        validate_document(&p, schema, document);
    if (p.status == WT_OK)
        parse(&p, xmlDocGetRootElement(document));
    xmlSetStructuredErrorFunc(previous_context, previous);
    xmlFreeDoc(document);
    if (context != NULL)
        xmlFreeParserCtxt(context);
    p.status = resource_error_finish(p.status, p.err);
    if (p.status == WT_OK)
        *description = p.d;
    else
        description_free(p.d);
    return p.status;
}

wt_status description_parse(description_xsd *schema, const char *xml, size_t length,
                            const char *name, text_description **description, wt_error *err)
{
    resource_error_clear();
    return parse_document(schema, xml, length, name, parse_format, description, err);
}

wt_status description_parse_file(description_xsd *schema, const char *path,
                                 text_description **description, wt_error *err)
{
    wt_input *input = NULL;
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_status status = wt_input_open(path, &input, err);
    if (status == WT_OK) {
        wt_input_limit(input, WT_INPUT_SETTINGS_LIMIT);
        status = wt_input_bytes(input, &bytes, &length, err);
    }
    if (status == WT_OK)
        status = description_parse(schema, (const char *)bytes, length, path, description, err);
    wt_input_close(input);
    return status;
}

/* ---- embedded descriptions ------------------------------------------------------------------- */

/* Returns the text between a mark of the head and the next `end`. The heads have a plain form; a
 * test compares the result with that of the XML parser. */
static char *extract_text(text_description *d, const char *mark, char end)
{
    const char *const from = strstr(strstr(d->xml, "<format "), mark) + strlen(mark);
    return arena_text(&d->memory, from, (size_t)(strchrnul(from, end) - from));
}

text_description *description_from_library(const embedded_text *file)
{
    text_description *const d = wt_alloc(1, sizeof *d);
    d->xml = file->text;
    d->id = extract_text(d, " id=\"", '"');
    d->version = extract_text(d, " version=\"", '"');
    d->title = extract_text(d, "<title>", '<');
    d->evidence = extract_text(d, "<evidence>", '<');
    d->kinds = parse_kinds(extract_text(d, " kinds=\"", '"'));
    d->verified = strstr(d->xml, " verified=\"true\"") != NULL;
    return d;
}

/* Parses the document up to the description of the file content. */
static wt_status parse_detection_part(const text_description *d, const char *name,
                                      text_description **read, wt_error *err)
{
    const char *end = strstr(d->xml, "\n  <header>");
    end = end != NULL ? end : strstr(d->xml, "\n  <table");
    char *const text = format_text("%.*s</format>", (int)(end - d->xml), d->xml);
    const wt_status status =
        parse_document(NULL, text, strlen(text), name, parse_detect, read, err);
    free(text);
    return status;
}

wt_status description_load(text_description *d, description_extent extent,
                           const text_description **result, wt_error *err)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    wt_status status = WT_OK;
    char name[96];
    *result = d;
    if (d->extent >= extent)
        return WT_OK;
    (void)snprintf(name, sizeof name, "%s.xml of the library", d->id);
    (void)pthread_mutex_lock(&lock);
    text_description **const loaded = &d->loaded[extent];
    if (*loaded == NULL && extent == DESCRIPTION_DETECT)
        status = parse_detection_part(d, name, loaded, err);
    else if (*loaded == NULL)
        status = parse_document(NULL, d->xml, strlen(d->xml), name, parse_format, loaded, err);
    *result = *loaded;
    (void)pthread_mutex_unlock(&lock);
    if (status == WT_E_SCHEMA)
        wt_error_advice(err, "the library was built with this damaged description: install it "
                             "again, or replace the description by one of the same id (--formats)");
    return status;
}
