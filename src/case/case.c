/* Creates, changes and frees a case, and parses its file: XML, schema, sections.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/case.h"

#include "case/case_node.h"
#include "case/case_schema.h"
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/param.h"
#include "core/base/text.h"
#include "dma/rubber.h"
#include "friction/counter_surface.h"

#include <libxml/parser.h>
#include <libxml/xmlschemas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *wt_case_schema(void)
{
    return case_schema[0].text;
}

/* Creates an empty case with default parameters; NULL when out of memory. */
static wt_case *case_new(void)
{
    wt_case *c = wt_alloc(1, sizeof *c);
    c->title = c->sample = c->condition = "";
    c->indent = wt_indent_job_defaults();
    c->compare = wt_compare_job_defaults();
    c->bulk.spring_constant = c->track.spring_constant = (wt_estimate){(double)NAN, 0, 0, "N/m"};
    c->bulk.sensitivity = c->track.sensitivity = (wt_estimate){(double)NAN, 0, 0, "m/V"};
    c->master = wt_master_job_defaults();
    c->ramp = wt_ramp_job_defaults();
    c->zener = flow_zener_defaults();
    c->transverse = wt_transverse_defaults();
    c->surface = flow_surface_defaults();
    c->topography = wt_topography_job_defaults();
    c->sliding = wt_sliding_defaults();
    c->layer = wt_layer_job_defaults();
    c->identify = wt_identify_job_defaults();
    c->records = wt_record_job_defaults();
    c->validation = wt_validation_job_defaults();
    c->report = wt_report_defaults();
    return c;
}

void wt_case_free(wt_case *c)
{
    if (c == NULL)
        return;
    for (case_setting *s = c->settings; s != NULL; s = s->next)
        wt_params_clear(s->params, s->structure, &s->given);
    arena_free(&c->memory);
    free(c);
}

const char *wt_case_title(const wt_case *c)
{
    return c->title;
}

const wt_report_options *wt_case_report_options(const wt_case *c)
{
    return &c->report;
}

wt_status wt_case_request_tables(wt_case *c, const char *tables, wt_error *err)
{
    char *rest = NULL;
    flow_resource_set requested = 0;
    if (c == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no case, or no table");
    wt_status status = WT_OK;
    char *const names = wt_strdup(tables);
    for (const char *name = strtok_r(names, " ", &rest); status == WT_OK && name != NULL;
         name = strtok_r(NULL, " ", &rest)) {
        flow_resource_set resources = 0;
        if (!flow_table_resources(name, &resources) || resources == 0)
            status = wt_fail(err, WT_E_NOT_FOUND, "no table of a run is called \"%s\"", name);
        requested |= resources;
    }
    free(names);
    if (status == WT_OK && requested == 0)
        status = wt_fail(err, WT_E_NOT_FOUND, "no table of a run is called \"%s\"", tables);
    if (status != WT_OK)
        return status;
    c->is_explicit_request = c->has_requests = true;
    c->requested = requested;
    return WT_OK;
}

static void replace_records(wt_case *c, const char *const *records, size_t n)
{
    const bool known = c->record.n > 0;
    wt_file_set *const sets = arena_alloc(&c->memory, n, sizeof *sets);
    const char **const patterns = arena_alloc(&c->memory, n, sizeof *patterns);
    for (size_t i = 0; i < n; i++) {
        patterns[i] = arena_text(&c->memory, records[i], strlen(records[i]));
        sets[i] =
            (wt_file_set){.patterns = &patterns[i], .n_patterns = 1, .read = wt_read_defaults()};
    }
    c->record.sets = sets;
    c->record.n = n;
    if (!known) {
        c->record.next = c->roles;
        c->roles = &c->record;
    }
}

wt_status wt_case_set_validation(wt_case *c, const char *const *records, size_t n,
                                 const wt_validation_job *job, uint64_t given, wt_error *err)
{
    if (c == NULL || job == NULL || (n > 0 && records == NULL))
        return wt_fail(err, WT_E_ARG, "no case, or no validation job");
    param_copy(wt_validation_job_params(), job, given, &c->validation);
    if (n > 0)
        replace_records(c, records, n);
    return WT_OK;
}

/* ---- case file ------------------------------------------------------------------------------- */

/* Limit for the size of a case file, which is written by hand. */
#define MAX_CASE_BYTES ((size_t)4 << 20)

/* ---- schema messages ------------------------------------------------------------------------- */

/* Extracts the text between `begin` and `end` from a message; "" if they are missing. */
static void extract_between(const char *message, const char *begin, const char *end, char *out,
                            size_t size)
{
    out[0] = '\0';
    const char *from = strstr(message, begin);
    if (from == NULL)
        return;
    from += strlen(begin);
    const char *to = strstr(from, end);
    size_t length = to == NULL ? strlen(from) : (size_t)(to - from);
    if (length >= size)
        length = size - 1;
    memcpy(out, from, length);
    out[length] = '\0';
}

typedef struct schema_message {
    bool any;
    int code; /* xmlParserErrors */
    long line;
    char message[512];
} schema_message;

/* Stores the first message only, because the others follow from it. */
static void store_first_message(void *user, xmlErrorPtr error)
{
    schema_message *c = user;
    if (c->any || error == NULL)
        return;
    c->any = true;
    c->code = error->code;
    c->line = error->line;
    snprintf(c->message, sizeof c->message, "%s", error->message != NULL ? error->message : "");
    c->message[strcspn(c->message, "\n")] = '\0';
}

static wt_status schema_error(const schema_message *c, wt_error *err)
{
    char element[96], expected[160], value[96], detail[256];
    extract_between(c->message, "Element '", "'", element, sizeof element);
    extract_between(c->message, "Expected is ", ".", expected, sizeof expected);
    if (expected[0] == '\0')
        extract_between(c->message, "is not an element of the set {", "}", expected,
                        sizeof expected);
    extract_between(c->message, "The value '", "'", value, sizeof value);
    extract_between(c->message, "': ", " Expected is", detail, sizeof detail);
    const size_t length = strlen(detail);
    if (length > 0 && detail[length - 1] == '.') /* the error message continues after this text */
        detail[length - 1] = '\0';
    wt_fail(err, WT_E_SCHEMA, "%s", detail[0] != '\0' ? detail : c->message);
    wt_error_place(err, "line %ld", c->line);
    if (expected[0] != '\0')
        wt_error_expected(err, "%s", expected);
    if (value[0] != '\0')
        wt_error_found(err, "\"%s\" in <%s>", value, element);
    else if (element[0] != '\0')
        wt_error_found(err, "<%s>", element);
    const char *const instead = c->code == XML_SCHEMAV_ELEMENT_CONTENT
                                    ? removed_name_advice(element, strlen(element))
                                    : NULL;
    if (instead != NULL)
        wt_error_advice(err, "there is no <%s> any more: %s", element, instead);
    else
        wt_error_advice(err, "weartrack-case(5) lists the elements of every section");
    return WT_E_SCHEMA;
}

static wt_status validate_document(xmlDoc *doc, wt_error *err)
{
    schema_message c = {0};
    const char *text = wt_case_schema();
    xmlSchemaParserCtxt *parser = xmlSchemaNewMemParserCtxt(text, (int)strlen(text));
    xmlSchema *schema = parser == NULL ? NULL : xmlSchemaParse(parser);
    xmlSchemaValidCtxt *valid = schema == NULL ? NULL : xmlSchemaNewValidCtxt(schema);
    if (valid != NULL)
        xmlSchemaSetValidStructuredErrors(valid, store_first_message, &c);
    const int result = valid == NULL ? 0 : xmlSchemaValidateDoc(valid, doc);
    wt_status status = WT_OK;
    if (valid == NULL)
        status = wt_fail(err, WT_E_MEMORY, "no memory for the schema of case files");
    else if (result > 0 || c.any)
        status = schema_error(&c, err);
    else if (result < 0)
        status = wt_fail(err, WT_E_INTERNAL, "the case file could not be checked");
    xmlSchemaFreeValidCtxt(valid);
    xmlSchemaFree(schema);
    xmlSchemaFreeParserCtxt(parser);
    return status;
}

/* ---- values to be filled in ------------------------------------------------------------------ */

typedef struct open_values {
    size_t n;
    char list[sizeof((wt_error *)0)->place];
} open_values;

static void add_if_open(const char *text, const xmlNode *node, const char *name, open_values *open)
{
    if (strstr(text, WT_CASE_FILL_IN) == NULL)
        return;
    const size_t used = strlen(open->list);
    open->n++;
    if (used + strlen(name) + sizeof ", line 4294967295 <>, ..." < sizeof open->list)
        snprintf(open->list + used, sizeof open->list - used, "%sline %ld <%s>",
                 used > 0 ? ", " : "", xmlGetLineNo((xmlNode *)node), name);
    else if (used > 0 && open->list[used - 1] != '.')
        snprintf(open->list + used, sizeof open->list - used, ", ...");
}

static void find_open_values(const xmlNode *parent, open_values *open)
{
    for (const xmlNode *node = parent->children; node != NULL; node = node->next) {
        if (node->type == XML_TEXT_NODE && node->content != NULL)
            add_if_open((const char *)node->content, parent, (const char *)parent->name, open);
        if (node->type != XML_ELEMENT_NODE)
            continue;
        for (const xmlAttr *a = node->properties; a != NULL; a = a->next)
            if (a->children != NULL && a->children->content != NULL)
                add_if_open((const char *)a->children->content, node, (const char *)a->name, open);
        find_open_values(node, open);
    }
}

/* Reports all values at once, as the first one that a section rejects would hide the others. */
static wt_status check_filled_in(const xmlDoc *doc, wt_error *err)
{
    open_values open = {.n = 0};
    find_open_values((const xmlNode *)doc, &open);
    if (open.n == 0)
        return WT_OK;
    wt_fail(err, WT_E_MISSING, "%zu value%s of the case %s still to be filled in", open.n,
            open.n == 1 ? "" : "s", open.n == 1 ? "is" : "are");
    wt_error_place(err, "%s", open.list);
    wt_error_expected(err, "the value, with its unit, in place of " WT_CASE_FILL_IN);
    wt_error_advice(err, "weartrack-case(5) says what each element holds");
    return WT_E_MISSING;
}

/* ---- document -------------------------------------------------------------------------------- */

static wt_status read_case_document(const wt_case *c, xmlDoc **out, wt_error *err)
{
    const int options = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING;
    xmlParserCtxt *context = xmlNewParserCtxt();
    if (context == NULL)
        out_of_memory(sizeof *context);
    wt_status status = WT_OK;
    xmlDoc *doc = xmlCtxtReadMemory(context, c->xml, (int)c->xml_length, NULL, NULL, options);
    const size_t beginning = c->xml_length < 16 ? c->xml_length : 16; /* byte order mark, blanks */
    if (doc == NULL && memchr(c->xml, '<', beginning) == NULL) {
        status = wt_fail(err, WT_E_SCHEMA, "is no case file");
        wt_error_expected(err, "an XML file that begins with <?xml or <case");
        wt_error_advice(err, "`weartrack new-case FILE...` writes one for measured files; "
                             "`weartrack info FILE` says what this one is");
    } else if (doc == NULL) {
        const xmlError *last = xmlCtxtGetLastError(context);
        char message[200];
        snprintf(message, sizeof message, "%s",
                 last != NULL && last->message != NULL ? last->message : "not well-formed");
        message[strcspn(message, "\n")] = '\0';
        status = wt_fail(err, WT_E_SCHEMA, "not well-formed XML: %s", message);
        if (last != NULL)
            wt_error_place(err, "line %d", last->line);
        wt_error_advice(err, "`xmllint --noout FILE` shows all such places");
    } else if (doc->intSubset != NULL || doc->extSubset != NULL) {
        status = wt_fail(err, WT_E_SCHEMA, "a case file has no document type declaration");
        wt_error_found(err, "<!DOCTYPE ...>");
        wt_error_advice(err, "delete the declaration; entities are not used");
    }
    xmlFreeParserCtxt(context);
    if (status != WT_OK) {
        xmlFreeDoc(doc);
        return status;
    }
    *out = doc;
    return WT_OK;
}

/* Returns the present name of an element; NULL if it has no former name. Only these jobs have
 * elements with former names. */
static const char *current_element(const char *name)
{
    const wt_params *const tables[] = {wt_indent_job_params(), wt_compare_job_params(),
                                       wt_master_job_params(), wt_layer_job_params(),
                                       wt_identify_job_params()};
    for (size_t t = 0; t < COUNT_OF(tables); t++)
        for (size_t i = 0; i < wt_params_count(tables[t]); i++) {
            const wt_param *const param = wt_params_get(tables[t], i);
            if (param->former != NULL && strcmp(param->former, name) == 0)
                return param->name;
        }
    return NULL;
}

/* Gives elements the present names of their parameters, before the schema sees them. */
static void use_current_elements(xmlNode *parent)
{
    for (xmlNode *node = parent->children; node != NULL; node = node->next) {
        if (node->type != XML_ELEMENT_NODE)
            continue;
        const char *const name = current_element((const char *)node->name);
        if (name != NULL)
            xmlNodeSetName(node, (const xmlChar *)name);
        use_current_elements(node);
    }
}

static wt_status parse_case(wt_case *c, wt_error *err)
{
    static const struct {
        const char *name;
        wt_status (*read)(wt_case *c, const xmlNode *section, wt_error *err);
    } sections[] = {
        {"indentation", case_read_indentation},
        {"dma", case_read_dma},
        {"roughness", case_read_roughness},
        {"sliding", case_read_sliding},
        {"record", case_read_record}, /* before the layer, whose wear it may state */
        {"layer", case_read_layer},
        {"identify", case_read_identify},
        {"compare", case_read_compare},
        {"report", case_read_report},
    };
    xmlDoc *doc = NULL;
    wt_status status = read_case_document(c, &doc, err);
    if (status == WT_OK) {
        use_current_elements(xmlDocGetRootElement(doc));
        status = check_filled_in(doc, err);
    }
    if (status == WT_OK)
        status = validate_document(doc, err);
    const xmlNode *root = status == WT_OK ? xmlDocGetRootElement(doc) : NULL;
    const struct {
        const char *name;
        const char **text;
    } labels[] = {{"title", &c->title}, {"sample", &c->sample}, {"condition", &c->condition}};
    for (size_t i = 0; status == WT_OK && i < sizeof labels / sizeof labels[0]; i++) {
        const xmlNode *label = case_child(root, labels[i].name);
        if (label != NULL)
            *labels[i].text = case_node_text(c, label);
    }
    for (size_t i = 0; status == WT_OK && i < sizeof sections / sizeof sections[0]; i++) {
        const xmlNode *section = case_child(root, sections[i].name);
        if (section != NULL)
            status = sections[i].read(c, section, err);
    }
    xmlFreeDoc(doc);
    return status;
}

wt_status case_from_bytes(const void *bytes, size_t length, const char *path, wt_case **out,
                          wt_error *err)
{
    if (length == 0 || length > MAX_CASE_BYTES) {
        wt_fail(err, WT_E_SCHEMA, "this is no case file");
        wt_error_file(err, path);
        wt_error_expected(err, "XML of 1 byte to 4 MiB");
        wt_error_found(err, "%zu bytes", length);
        return WT_E_SCHEMA;
    }
    wt_case *c = case_new();
    char *folder = wt_path_folder(path);
    c->xml_length = length;
    c->path = arena_text(&c->memory, path, strlen(path));
    c->folder = arena_text(&c->memory, folder, strlen(folder));
    c->xml = arena_text(&c->memory, bytes, length);
    free(folder);
    const wt_status status = parse_case(c, err);
    if (status == WT_OK) {
        *out = c;
    } else {
        wt_error_file(err, path);
        wt_case_free(c);
    }
    return status;
}

wt_status wt_case_read(const char *path, wt_case **out, wt_error *err)
{
    if (path == NULL || out == NULL)
        return wt_fail(err, WT_E_ARG, "no case file");
    wt_input *input = NULL;
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_status status = wt_input_open(path, &input, err);
    if (status == WT_OK) {
        wt_input_limit(input, WT_INPUT_SETTINGS_LIMIT);
        status = wt_input_bytes(input, &bytes, &length, err);
    }
    if (status == WT_OK)
        status = case_from_bytes(bytes, length, path, out, err);
    else
        wt_error_file(err, path);
    wt_input_close(input);
    return status;
}
