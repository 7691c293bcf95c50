/* Parses the XML of a format description. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"
#include "read/description/description_xml.h"
#include "read/embedded_formats.h"

#include <errno.h>
#include <libxml/parser.h>
#include <libxml/xmlschemas.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
