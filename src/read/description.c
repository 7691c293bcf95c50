/* From the XML of a format description to what the engine runs.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/description.h"

#include "read/embedded_formats.h"

#include <libxml/parser.h>
#include <libxml/tree.h>
#include <libxml/xmlschemas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- schema ------------------------------------------------------------------------------- */

struct wt_description_schema {
    xmlSchemaPtr schema;
};

static const wt_embedded *embedded_schema(void)
{
    const wt_embedded *e = embedded_formats;
    while (e->name != NULL && strcmp(e->name, "weartrack-format.xsd") != 0)
        e++;
    return e;
}

const char *wt_formats_schema(void)
{
    return embedded_schema()->text;
}

static void keep_quiet(void *user, xmlErrorPtr error)
{
    (void)user;
    (void)error;
}

wt_status wt_description_schema_new(wt_description_schema **schema, wt_error *err)
{
    const wt_embedded *text = embedded_schema();
    wt_status status = WT_E_INTERNAL;
    wt_description_schema *made = calloc(1, sizeof *made);
    xmlSchemaParserCtxtPtr context = NULL;
    if (made == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the schema of descriptions");
    context = xmlSchemaNewMemParserCtxt(text->text, (int)text->length);
    if (context != NULL) {
        xmlSchemaSetParserStructuredErrors(context, keep_quiet, NULL);
        made->schema = xmlSchemaParse(context);
        xmlSchemaFreeParserCtxt(context);
    }
    if (made->schema != NULL) {
        *schema = made;
        return WT_OK;
    }
    free(made);
    return wt_fail(err, status, "the schema of descriptions cannot be compiled");
}

void wt_description_schema_free(wt_description_schema *schema)
{
    if (schema == NULL)
        return;
    xmlSchemaFree(schema->schema);
    free(schema);
}

/* ---- reading ------------------------------------------------------------------------------ */

/* One reading: the first failure stays. */
typedef struct parse {
    wt_description *d;
    const char *name;
    wt_status status;
    wt_error *err;
} parse;

static void out_of_memory(parse *p)
{
    if (p->status == WT_OK)
        p->status = wt_fail(p->err, WT_E_MEMORY, "no memory for a format description");
}

/* "FILE: line 12, element column: MESSAGE; expected ...; found ..." */
static void complain(parse *p, const xmlNode *node, const char *message, const char *expected,
                     const char *found)
{
    if (p->status != WT_OK)
        return;
    p->status = wt_fail(p->err, WT_E_SCHEMA, "%s", message);
    wt_error_file(p->err, p->name);
    wt_error_place(p->err, "line %ld, element %s", xmlGetLineNo(node), (const char *)node->name);
    if (expected != NULL)
        wt_error_expected(p->err, "%s", expected);
    if (found != NULL)
        wt_error_found(p->err, "%s", found);
    wt_error_advice(p->err, "see weartrack-format(5)");
}

static char *copy_xml(parse *p, xmlChar *text)
{
    char *copy = NULL;
    if (text != NULL) {
        copy = strdup((const char *)text);
        if (copy == NULL)
            out_of_memory(p);
        xmlFree(text);
    }
    return copy;
}

/* NULL if the attribute is absent. */
static char *attribute(parse *p, const xmlNode *node, const char *name)
{
    return copy_xml(p, xmlGetNoNsProp(node, (const xmlChar *)name));
}

static char *content(parse *p, const xmlNode *node)
{
    return copy_xml(p, xmlNodeGetContent(node));
}

static char *normalised(parse *p, char *text)
{
    char name[WT_NAME_MAX];
    char *copy = NULL;
    if (text == NULL)
        return NULL;
    wt_name_normalise(text, strlen(text), name);
    free(text);
    copy = strdup(name);
    if (copy == NULL)
        out_of_memory(p);
    return copy;
}

static bool is_true(parse *p, const xmlNode *node, const char *name)
{
    char *text = attribute(p, node, name);
    bool yes = text != NULL && (strcmp(text, "true") == 0 || strcmp(text, "1") == 0);
    free(text);
    return yes;
}

/* Of texts that the schema has checked, so the list is complete. */
static size_t one_of(parse *p, const xmlNode *node, const char *name, const char *const words[],
                     size_t n, size_t absent)
{
    char *text = attribute(p, node, name);
    size_t i = absent;
    if (text != NULL)
        for (i = 0; i + 1 < n && strcmp(text, words[i]) != 0;)
            i++;
    free(text);
    return i;
}

static size_t count_attribute(parse *p, const xmlNode *node, const char *name, size_t absent)
{
    char *text = attribute(p, node, name);
    size_t value = text != NULL ? (size_t)strtoul(text, NULL, 10) : absent;
    free(text);
    return value;
}

static bool is_element(const xmlNode *node, const char *name)
{
    return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

static const xmlNode *child(const xmlNode *node, const char *name)
{
    const xmlNode *c = node->children;
    while (c != NULL && !is_element(c, name))
        c = c->next;
    return c;
}

/* Room for as many items as `node` has children of that name. */
static void *room(parse *p, const xmlNode *node, const char *name, size_t size)
{
    size_t n = 0;
    for (const xmlNode *c = node->children; c != NULL; c = c->next)
        n += name == NULL || is_element(c, name);
    void *items = calloc(n + 1, size);
    if (items == NULL)
        out_of_memory(p);
    return items;
}

/* ---- regular expressions ------------------------------------------------------------------ */

bool wt_pattern_match(const wt_pattern *pattern, const char *line, size_t length,
                      regmatch_t *groups, size_t n)
{
    if (length > WT_PATTERN_LINE_MAX || (pattern->first != '\0' && line[0] != pattern->first))
        return false;
    return regexec(&pattern->regex, line, n, groups, 0) == 0;
}

/* Counts and back references make the cost of a match explode, and no description needs them. */
static const char *forbidden(const char *source)
{
    bool set = false;
    for (const char *c = source; *c != '\0'; c++) {
        if (*c == '\\' && c[1] != '\0') {
            c++;
            if (*c >= '1' && *c <= '9')
                return "a back reference";
        } else if (set) {
            set = *c != ']';
        } else if (*c == '[') {
            set = true;
            c += c[1] == '^';
            c += c[1] == ']';
        } else if (*c == '{') {
            return "a repeat count {...}; write \\{ for the character";
        }
    }
    return NULL;
}

/* \t stands for the tabulator, which an attribute of XML cannot hold as it is. */
static void tabulators(char *source)
{
    char *to = source;
    for (const char *from = source; *from != '\0'; from++) {
        if (from[0] == '\\' && from[1] == 't') {
            *to++ = '\t';
            from++;
        } else if (from[0] == '\\' && from[1] != '\0') {
            *to++ = *from++;
            *to++ = *from;
        } else {
            *to++ = *from;
        }
    }
    *to = '\0';
}

static char first_byte(const char *source)
{
    char c = source[0] == '^' ? source[1] : '\0';
    char after = c != '\0' ? source[2] : '\0';
    if (c == '\\') {
        c = source[2];
        after = c != '\0' ? source[3] : '\0';
        if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'))
            return '\0';
    } else if (c != '\0' && strchr(".[]()*+?{}|^$", c) != NULL) {
        return '\0';
    }
    if ((after != '\0' && strchr("*?{|", after) != NULL) || strchr(source, '|') != NULL)
        return '\0';
    return c;
}

static void compile(parse *p, const xmlNode *node, const char *name, wt_pattern *pattern,
                    size_t groups)
{
    char *source = attribute(p, node, name);
    char message[128];
    if (source == NULL)
        return;
    const char *what = forbidden(source);
    if (what != NULL) {
        complain(p, node, "regular expression not accepted", "an extended POSIX expression", what);
        free(source);
        return;
    }
    tabulators(source);
    int code = regcomp(&pattern->regex, source, REG_EXTENDED | (groups == 0 ? REG_NOSUB : 0));
    if (code != 0) {
        regerror(code, &pattern->regex, message, sizeof message);
        complain(p, node, message, "an extended POSIX regular expression", source);
    } else {
        pattern->compiled = true;
        pattern->first = first_byte(source);
        if (pattern->regex.re_nsub < groups)
            complain(p, node, "regular expression without a group",
                     "parentheses around the part that is the value", source);
    }
    free(source);
}

/* ---- parts of the document ---------------------------------------------------------------- */

static wt_quantity quantity_attribute(parse *p, const xmlNode *node)
{
    char *id = attribute(p, node, "quantity");
    wt_quantity quantity = WT_Q_NONE;
    if (id != NULL && !wt_quantity_find(id, &quantity))
        complain(p, node, "unknown quantity", "a quantity of the schema", id);
    free(id);
    return quantity;
}

static void check_unit(parse *p, const xmlNode *node, const char *unit, wt_quantity quantity)
{
    double factor = 1, offset = 0;
    char expected[128];
    if (p->status != WT_OK || unit == NULL ||
        wt_unit_to_si(unit, quantity, &factor, &offset, NULL) == WT_OK)
        return;
    snprintf(expected, sizeof expected, "a unit of %s, such as %s", wt_quantity_id(quantity),
             wt_quantity_unit(quantity));
    complain(p, node, "the unit does not fit the quantity", expected, unit);
}

static void read_detect(parse *p, const xmlNode *detect)
{
    static const char *const kinds[] = {"require", "hint", "forbid", "names"};
    wt_description *d = p->d;
    bool decides = false;
    int score = 0;
    d->probes = room(p, detect, NULL, sizeof *d->probes);
    for (const xmlNode *c = detect->children; c != NULL && p->status == WT_OK; c = c->next) {
        if (c->type != XML_ELEMENT_NODE)
            continue;
        wt_probe *probe = &d->probes[d->n_probes++];
        for (size_t k = 0; k < 4; k++)
            if (is_element(c, kinds[k]))
                probe->kind = (wt_probe_kind)k;
        decides |= probe->kind == WT_PROBE_REQUIRE || probe->kind == WT_PROBE_NAMES;
        probe->within = count_attribute(p, c, "within", 100);
        probe->score = (int)count_attribute(p, c, "score", 0);
        score += probe->kind == WT_PROBE_FORBID ? 0 : probe->score;
        if (probe->kind == WT_PROBE_NAMES)
            continue;
        probe->text = attribute(p, c, "text");
        compile(p, c, "regex", &probe->pattern, 0);
        if ((probe->text != NULL) == probe->pattern.compiled)
            complain(p, c, "what is looked for must be said once", "either text or regex",
                     probe->text != NULL ? "both" : "neither");
    }
    if (!decides)
        complain(p, detect, "nothing tells a file of this format from others",
                 "at least one require or names element", NULL);
    if (score < 1)
        complain(p, detect, "a match would count nothing", "a score of 1 to 100",
                 "no score in any element");
}

static void read_list(parse *p, const xmlNode *node, const char *name, char ***items, size_t *n)
{
    char *text = attribute(p, node, name);
    char *rest = NULL;
    size_t most = 1;
    if (text == NULL)
        return;
    for (const char *c = text; *c != '\0'; c++)
        most += *c == ' ';
    *items = calloc(most, sizeof **items);
    if (*items == NULL)
        out_of_memory(p);
    else
        for (char *word = strtok_r(text, " ", &rest); word != NULL;
             word = strtok_r(NULL, " ", &rest)) {
            (*items)[*n] = strdup(word);
            if ((*items)[*n] == NULL) {
                out_of_memory(p);
                break;
            }
            (*n)++;
        }
    free(text);
}

static void read_text(parse *p, const xmlNode *node)
{
    static const char *const encodings[] = {"auto", "utf-8", "latin-1", "utf-16"};
    static const char *const separators[] = {"auto",  "tab",        "semicolon",
                                             "comma", "whitespace", "fixed"};
    static const char *const decimals[] = {"auto", "point", "comma"};
    static const char marks[] = {'\0', '.', ','};
    wt_description *d = p->d;
    char **widths = NULL;
    size_t n = 0;
    d->encoding = (wt_encoding)one_of(p, node, "encoding", encodings, 4, 0);
    d->separator = (wt_separator)one_of(p, node, "separator", separators, 6, 0);
    d->names_separator =
        (wt_separator)one_of(p, node, "names-separator", separators, 6, (size_t)d->separator);
    d->decimal = marks[one_of(p, node, "decimal", decimals, 3, 0)];
    d->comment = attribute(p, node, "comment");
    read_list(p, node, "missing", &d->missing, &d->n_missing);
    read_list(p, node, "widths", &widths, &n);
    d->widths = calloc(n + 1, sizeof *d->widths);
    if (d->widths == NULL)
        out_of_memory(p);
    for (size_t i = 0; i < n; i++) {
        if (d->widths != NULL)
            d->widths[d->n_widths++] = (size_t)strtoul(widths[i], NULL, 10);
        free(widths[i]);
    }
    free(widths);
    bool fixed = d->separator == WT_SEPARATOR_FIXED || d->names_separator == WT_SEPARATOR_FIXED;
    if (fixed != (n > 0))
        complain(p, node, "fixed columns and their widths belong together",
                 "separator=\"fixed\" with widths=\"...\"", fixed ? "no widths" : "only widths");
    if (d->separator == WT_SEPARATOR_COMMA && d->decimal == ',')
        complain(p, node, "a comma cannot be both", "another separator or decimal=\"point\"",
                 "separator and decimal mark are commas");
}

static void read_header(parse *p, const xmlNode *node)
{
    static const char *const sets[] = {"decimal", "separator"};
    wt_description *d = p->d;
    d->fields = room(p, node, "field", sizeof *d->fields);
    for (const xmlNode *c = node->children; c != NULL && p->status == WT_OK; c = c->next) {
        if (!is_element(c, "field"))
            continue;
        wt_field *field = &d->fields[d->n_fields++];
        field->name = attribute(p, c, "name");
        field->group = count_attribute(p, c, "group", 1);
        field->unit_group = count_attribute(p, c, "unit-group", 0);
        compile(p, c, "regex", &field->pattern,
                field->group > field->unit_group ? field->group : field->unit_group);
        field->quantity = quantity_attribute(p, c);
        field->unit = attribute(p, c, "unit");
        field->fallback = is_true(p, c, "fallback");
        field->sets = (wt_field_sets)(one_of(p, c, "sets", sets, 2, (size_t)-1) + 1);
        if (field->quantity == WT_Q_NONE)
            continue;
        if (wt_header_of(field->quantity) == WT_HEADER_COUNT)
            complain(p, c, "a header line cannot give this quantity",
                     "temperature, spring_constant, sensitivity, position_x, position_y, velocity, "
                     "time (duration) or force (set-point)",
                     wt_quantity_id(field->quantity));
        check_unit(p, c, field->unit, field->quantity);
        if ((field->unit != NULL) == (field->unit_group > 0))
            complain(p, c, "the unit of a header value must be said once",
                     "either unit or unit-group", field->unit != NULL ? "both" : "neither");
    }
}

static int compare_names(const void *a, const void *b)
{
    const wt_column_name *x = a, *y = b;
    int order = strcmp(x->name, y->name);
    if (order != 0)
        return order;
    return (x->rule > y->rule) - (x->rule < y->rule);
}

static void read_columns(parse *p, const xmlNode *table)
{
    wt_description *d = p->d;
    size_t n = 0;
    d->rules = room(p, table, "column", sizeof *d->rules);
    for (const xmlNode *c = table->children; c != NULL; c = c->next)
        if (is_element(c, "column"))
            for (const xmlNode *name = c->children; name != NULL; name = name->next)
                n += is_element(name, "name");
    d->names = calloc(n + 1, sizeof *d->names);
    if (d->names == NULL)
        out_of_memory(p);
    for (const xmlNode *c = table->children; c != NULL && p->status == WT_OK; c = c->next) {
        static const char *const kinds[] = {"approach", "retract", "dwell", "modulation", "other"};
        if (!is_element(c, "column"))
            continue;
        wt_column_rule *rule = &d->rules[d->n_rules];
        size_t kind = one_of(p, c, "segment", kinds, 5, 5);
        rule->quantity = quantity_attribute(p, c);
        rule->unit = attribute(p, c, "unit");
        rule->with = normalised(p, attribute(p, c, "with"));
        rule->has_segment = kind < 5;
        rule->segment = kind < 5 ? (wt_segment_kind)kind : WT_SEGMENT_OTHER;
        rule->negate = is_true(p, c, "negate");
        check_unit(p, c, rule->unit, rule->quantity);
        for (const xmlNode *name = c->children; name != NULL && p->status == WT_OK;
             name = name->next) {
            if (!is_element(name, "name"))
                continue;
            d->names[d->n_names].rule = d->n_rules;
            d->names[d->n_names].name = normalised(p, content(p, name));
            if (p->status == WT_OK)
                d->n_names++;
        }
        d->n_rules++;
    }
    qsort(d->names, d->n_names, sizeof *d->names, compare_names);
}

static void read_table(parse *p, const xmlNode *table)
{
    static const char *const units[] = {"row", "name", "name-or-row", "line", "none"};
    static const char *const titles[] = {"same", "next"};
    static const char *const blanks[] = {"skip", "block"};
    wt_description *d = p->d;
    compile(p, table, "names", &d->names_line, 1);
    d->has_names_line = d->names_line.compiled;
    d->units = (wt_units_where)one_of(p, table, "units", units, 5, 0);
    compile(p, table, "units-line", &d->units_line, 1);
    if ((d->units == WT_UNITS_LINE) != d->units_line.compiled)
        complain(p, table, "a line of units must be described", "units=\"line\" with units-line",
                 d->units_line.compiled ? "only units-line" : "no units-line");
    if (d->units == WT_UNITS_LINE && !d->has_names_line)
        complain(p, table, "a line of units goes with a line of names", "an attribute names", NULL);
    d->row_prefix = normalised(p, attribute(p, table, "row-prefix"));
    d->blank_is_block = one_of(p, table, "blank", blanks, 2, 0) == 1;
    d->steps = room(p, table, "step", sizeof *d->steps);
    d->ends = room(p, table, "end", sizeof *d->ends);
    d->aliases = room(p, table, "unit", sizeof *d->aliases);
    for (const xmlNode *c = table->children; c != NULL && p->status == WT_OK; c = c->next) {
        if (is_element(c, "step")) {
            wt_step *step = &d->steps[d->n_steps++];
            step->title_next = one_of(p, c, "title", titles, 2, 0) == 1;
            compile(p, c, "regex", &step->pattern, step->title_next ? 0 : 1);
        } else if (is_element(c, "end")) {
            compile(p, c, "regex", &d->ends[d->n_ends++], 0);
        } else if (is_element(c, "unit")) {
            wt_unit_alias *alias = &d->aliases[d->n_aliases++];
            alias->found = attribute(p, c, "found");
            alias->means = attribute(p, c, "means");
        }
    }
    if (p->status == WT_OK)
        read_columns(p, table);
}

static void read_isotherms(parse *p, const xmlNode *node)
{
    char *jump = attribute(p, node, "temperature-jump");
    p->d->group = normalised(p, attribute(p, node, "group"));
    if (jump != NULL && (wt_quantity_parse(jump, WT_Q_TEMPERATURE_DIFFERENCE,
                                           &p->d->temperature_jump, NULL) != WT_OK ||
                         !(p->d->temperature_jump > 0)))
        complain(p, node, "not a temperature difference", "a positive one with its unit, \"5 K\"",
                 jump);
    free(jump);
}

static void read_segments(parse *p, const xmlNode *node)
{
    static const char *const kinds[] = {"approach", "retract", "dwell", "modulation", "other"};
    wt_description *d = p->d;
    d->segment_column = normalised(p, attribute(p, node, "column"));
    d->curve_column = normalised(p, attribute(p, node, "curve"));
    d->turning_point = is_true(p, node, "turning-point");
    d->markers = room(p, node, "marker", sizeof *d->markers);
    d->values = room(p, node, "value", sizeof *d->values);
    for (const xmlNode *c = node->children; c != NULL && p->status == WT_OK; c = c->next) {
        if (is_element(c, "marker")) {
            wt_marker *marker = &d->markers[d->n_markers++];
            marker->kind = (wt_segment_kind)one_of(p, c, "kind", kinds, 5, 4);
            compile(p, c, "regex", &marker->pattern, 0);
        } else if (is_element(c, "value")) {
            wt_marker *value = &d->values[d->n_values++];
            value->kind = (wt_segment_kind)one_of(p, c, "kind", kinds, 5, 4);
            value->text = attribute(p, c, "text");
        }
    }
    if ((d->segment_column != NULL) != (d->n_values > 0))
        complain(p, node, "a segment column and its values belong together",
                 "column=\"NAME\" with value elements",
                 d->n_values > 0 ? "only values" : "no values");
}

static unsigned read_kinds(parse *p, const xmlNode *root)
{
    char *text = attribute(p, root, "kinds");
    unsigned kinds = 0;
    if (text != NULL) {
        kinds |= strstr(text, "force") != NULL ? WT_KIND_FORCE : 0u;
        kinds |= strstr(text, "sweep") != NULL ? WT_KIND_SWEEP : 0u;
        kinds |= strstr(text, "spectrum") != NULL ? WT_KIND_SPECTRUM : 0u;
    }
    free(text);
    return kinds;
}

static void read_format(parse *p, const xmlNode *root)
{
    static const struct {
        const char *name;
        void (*read)(parse *p, const xmlNode *node);
    } parts[] = {{"detect", read_detect},       {"text", read_text},
                 {"header", read_header},       {"table", read_table},
                 {"isotherms", read_isotherms}, {"segments", read_segments}};
    wt_description *d = p->d;
    d->id = attribute(p, root, "id");
    d->version = attribute(p, root, "version");
    d->kinds = read_kinds(p, root);
    d->verified = is_true(p, root, "verified");
    d->title = content(p, child(root, "title"));
    d->evidence = content(p, child(root, "evidence"));
    for (size_t i = 0; i < sizeof parts / sizeof *parts && p->status == WT_OK; i++) {
        const xmlNode *node = child(root, parts[i].name);
        if (node != NULL)
            parts[i].read(p, node);
    }
    if (p->status == WT_OK)
        p->status = wt_description_check_whole(d, p->name, p->err);
}

/* ---- document ----------------------------------------------------------------------------- */

static void explain(parse *p, const xmlError *error, const char *otherwise)
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

static void first_complaint(void *user, xmlErrorPtr error)
{
    explain(user, error, "not valid");
}

static void validate(parse *p, const wt_description_schema *schema, xmlDocPtr document)
{
    xmlSchemaValidCtxtPtr context = xmlSchemaNewValidCtxt(schema->schema);
    if (context == NULL) {
        out_of_memory(p);
        return;
    }
    xmlSchemaSetValidStructuredErrors(context, first_complaint, p);
    if (xmlSchemaValidateDoc(context, document) != 0)
        explain(p, NULL, "the document does not follow the schema of descriptions");
    xmlSchemaFreeValidCtxt(context);
}

wt_status wt_description_parse(const wt_description_schema *schema, const char *xml, size_t length,
                               const char *name, wt_description **description, wt_error *err)
{
    const size_t most = (size_t)1 << 20;
    parse p = {.name = name, .status = WT_OK, .err = err};
    xmlParserCtxtPtr context = NULL;
    xmlDocPtr document = NULL;
    if (length > most) {
        wt_fail(err, WT_E_SCHEMA, "too long for a format description");
        wt_error_file(err, name);
        wt_error_expected(err, "at most 1 MiB");
        return WT_E_SCHEMA;
    }
    p.d = calloc(1, sizeof *p.d);
    context = xmlNewParserCtxt();
    if (p.d == NULL || context == NULL) {
        out_of_memory(&p);
        goto done;
    }
    p.d->temperature_jump = NAN;
    p.d->xml = strndup(xml, length);
    if (p.d->xml == NULL) {
        out_of_memory(&p);
        goto done;
    }
    document = xmlCtxtReadMemory(context, xml, (int)length, NULL, NULL,
                                 XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING |
                                     XML_PARSE_NOCDATA);
    if (document == NULL) {
        explain(&p, xmlCtxtGetLastError(context), "not well-formed XML");
        goto done;
    }
    if (document->intSubset != NULL) {
        explain(&p, NULL, "a document type or entities are not allowed in a description");
        goto done;
    }
    validate(&p, schema, document);
    if (p.status == WT_OK)
        read_format(&p, xmlDocGetRootElement(document));
done:
    xmlFreeDoc(document);
    if (context != NULL)
        xmlFreeParserCtxt(context);
    if (p.status == WT_OK)
        *description = p.d;
    else
        wt_description_free(p.d);
    return p.status;
}

static void free_pattern(wt_pattern *pattern)
{
    if (pattern->compiled)
        regfree(&pattern->regex);
}

void wt_description_free(wt_description *d)
{
    if (d == NULL)
        return;
    for (size_t i = 0; i < d->n_probes; i++) {
        free(d->probes[i].text);
        free_pattern(&d->probes[i].pattern);
    }
    for (size_t i = 0; i < d->n_fields; i++) {
        free(d->fields[i].name);
        free(d->fields[i].unit);
        free_pattern(&d->fields[i].pattern);
    }
    for (size_t i = 0; i < d->n_steps; i++)
        free_pattern(&d->steps[i].pattern);
    for (size_t i = 0; i < d->n_ends; i++)
        free_pattern(&d->ends[i]);
    for (size_t i = 0; i < d->n_aliases; i++) {
        free(d->aliases[i].found);
        free(d->aliases[i].means);
    }
    for (size_t i = 0; i < d->n_rules; i++) {
        free(d->rules[i].unit);
        free(d->rules[i].with);
    }
    for (size_t i = 0; i < d->n_names; i++)
        free(d->names[i].name);
    for (size_t i = 0; i < d->n_markers; i++)
        free_pattern(&d->markers[i].pattern);
    for (size_t i = 0; i < d->n_values; i++)
        free(d->values[i].text);
    for (size_t i = 0; i < d->n_missing; i++)
        free(d->missing[i]);
    free_pattern(&d->names_line);
    free_pattern(&d->units_line);
    void *const parts[] = {d->id,          d->title,  d->evidence, d->version, d->xml,
                           d->probes,      d->widths, d->comment,  d->missing, d->fields,
                           d->steps,       d->ends,   d->aliases,  d->rules,   d->names,
                           d->row_prefix,  d->group,  d->markers,  d->values,  d->segment_column,
                           d->curve_column};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        free(parts[i]);
    free(d);
}

bool wt_description_find_name(const wt_description *d, const char *name, size_t *first, size_t *n)
{
    size_t low = 0, high = d->n_names;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (strcmp(d->names[middle].name, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    *first = low;
    *n = 0;
    while (low + *n < d->n_names && strcmp(d->names[low + *n].name, name) == 0)
        (*n)++;
    return *n > 0;
}
