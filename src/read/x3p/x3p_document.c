/* Parses main.xml of an X3P file. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/x3p/x3p_document.h"

#include <libxml/parser.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void x3p_document_clear(x3p_document *document)
{
    free(document->list);
    document->list = NULL;
}

static bool is_element(const xmlNode *node, const char *name)
{
    return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

/* Returns the first child element with this name, or NULL. */
static const xmlNode *find_child(const xmlNode *of, const char *name)
{
    for (const xmlNode *c = of != NULL ? of->children : NULL; c != NULL; c = c->next)
        if (is_element(c, name))
            return c;
    return NULL;
}

/* Returns the text of an element without blanks at its ends; "" if there is none. */
static const char *element_text(const xmlNode *node, size_t *n)
{
    const xmlNode *inside = node != NULL ? node->children : NULL;
    while (inside != NULL && inside->type == XML_COMMENT_NODE)
        inside = inside->next;
    const char *text =
        inside != NULL && inside->type == XML_TEXT_NODE ? (const char *)inside->content : "";
    text += strspn(text, " \t\r\n");
    *n = strlen(text);
    while (*n > 0 && strchr(" \t\r\n", text[*n - 1]) != NULL)
        (*n)--;
    return text;
}

static double element_number(const xmlNode *node)
{
    size_t n;
    const char *text = element_text(node, &n);
    double value = (double)NAN;
    return wt_number_parse(text, n, '.', &value) ? value : (double)NAN;
}

static void copy_element_text(const xmlNode *node, char *to, size_t size)
{
    size_t n;
    const char *text = element_text(node, &n);
    snprintf(to, size, "%.*s", (int)(n < size ? n : size), text);
}

static wt_status fail_document(const char *what, const char *expected, wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "%s is missing or wrong", what);
    wt_error_place(err, "main.xml");
    wt_error_expected(err, "%s", expected);
    return WT_E_CORRUPT;
}

static wt_status read_x3p_axis(const xmlNode *axes, const char *name, x3p_axis *to, wt_error *err)
{
    static const struct {
        char letter;
        sample_type type;
    } types[] = {
        {'I', SAMPLE_INT16}, {'L', SAMPLE_INT32}, {'F', SAMPLE_FLOAT32}, {'D', SAMPLE_FLOAT64}};
    const xmlNode *axis = find_child(axes, name);
    size_t n;
    if (axis == NULL)
        return fail_document(name, "axes CX, CY and CZ", err);
    const char *kind = element_text(find_child(axis, "AxisType"), &n);
    to->incremental = n == 1 && kind[0] == 'I';
    to->increment = element_number(find_child(axis, "Increment"));
    to->offset = element_number(find_child(axis, "Offset"));
    const char *type = element_text(find_child(axis, "DataType"), &n);
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (n == 1 && type[0] == types[i].letter) {
            to->type = types[i].type;
            return WT_OK;
        }
    /* the type of x and y has no meaning for equally spaced points */
    return strcmp(name, "CZ") == 0 ? fail_document("DataType of CZ", "I, L, F or D", err) : WT_OK;
}

static size_t read_positive_integer(const xmlNode *node)
{
    const double value = element_number(node);
    return value >= 1 && value <= 1e9 && value == floor(value) ? (size_t)value : 0;
}

/* Reads heights in the document itself; an empty one is missing. */
static wt_status read_height_list(const xmlNode *list, x3p_document *to, wt_error *err)
{
    size_t n = 0;
    for (const xmlNode *c = list->children; c != NULL; c = c->next)
        n += is_element(c, "Datum") ? 1 : 0;
    to->list = malloc((n + 1) * sizeof *to->list);
    if (to->list == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for %zu heights", n);
    for (const xmlNode *c = list->children; c != NULL; c = c->next) {
        size_t length;
        if (!is_element(c, "Datum"))
            continue;
        const char *text = element_text(c, &length);
        double value = (double)NAN;
        if (length > 0 && !wt_number_parse(text, length, '.', &value)) {
            fail_document("a Datum", "one height, or nothing where it is missing", err);
            wt_error_found(err, "%.*s", (int)(length < 40 ? length : 40), text);
            return WT_E_CORRUPT;
        }
        to->list[to->n_list++] = value;
    }
    return WT_OK;
}

static wt_status read_matrix(const xmlNode *record, x3p_document *to, wt_error *err)
{
    const xmlNode *matrix = find_child(record, "MatrixDimension"),
                  *link = find_child(record, "DataLink"), *list = find_child(record, "DataList");
    static const char *const names[] = {"SizeX", "SizeY", "SizeZ"};
    if (matrix == NULL) {
        wt_fail(err, WT_E_UNSUPPORTED, "a cloud of points, not a matrix of heights");
        wt_error_place(err, "main.xml");
        wt_error_advice(err, "export the surface as a matrix (FeatureType SUR)");
        return WT_E_UNSUPPORTED;
    }
    for (size_t i = 0; i < 3; i++) {
        to->size[i] = read_positive_integer(find_child(matrix, names[i]));
        if (to->size[i] == 0)
            return fail_document(names[i], "a whole number from 1 on", err);
    }
    copy_element_text(find_child(link, "PointDataLink"), to->points, sizeof to->points);
    copy_element_text(find_child(link, "ValidPointsLink"), to->valid, sizeof to->valid);
    copy_element_text(find_child(link, "MD5ChecksumPointData"), to->points_md5,
                      sizeof to->points_md5);
    if (to->points[0] == '\0' && list == NULL)
        return fail_document("the heights", "a PointDataLink or a DataList", err);
    return to->points[0] == '\0' ? read_height_list(list, to, err) : WT_OK;
}

static wt_status read_root(const xmlNode *root, x3p_document *to, wt_error *err)
{
    const xmlNode *axes = find_child(find_child(root, "Record1"), "Axes");
    static const char *const names[] = {"CX", "CY", "CZ"};
    wt_status status = WT_OK;
    copy_element_text(find_child(find_child(root, "Record1"), "FeatureType"), to->feature,
                      sizeof to->feature);
    for (size_t i = 0; status == WT_OK && i < 3; i++)
        status = read_x3p_axis(axes, names[i], &to->axis[i], err);
    const bool profile = strcmp(to->feature, "PRF") == 0;
    if (status == WT_OK && !(to->axis[0].incremental && (to->axis[1].incremental || profile))) {
        status = wt_fail(err, WT_E_UNSUPPORTED, "the points are not equally spaced");
        wt_error_place(err, "main.xml");
        wt_error_expected(err, "incremental axes CX and CY");
    }
    if (status == WT_OK)
        status = read_matrix(find_child(root, "Record3"), to, err);
    if (status == WT_OK && profile && to->size[1] != 1)
        status = fail_document("SizeY", "1 of a profile", err);
    return status;
}

/* Suppresses messages and records if memory was missing. */
static void note_xml_memory_error(void *user, xmlErrorPtr error)
{
    bool *const is_out_of_memory = user;
    *is_out_of_memory = *is_out_of_memory || (error != NULL && error->code == XML_ERR_NO_MEMORY);
}

wt_status x3p_document_parse(const void *xml, size_t length, x3p_document *document, wt_error *err)
{
    /* libxml2 prints encoding errors to standard error unless this thread has a handler. */
    const xmlStructuredErrorFunc previous = xmlStructuredError;
    void *const previous_context = xmlStructuredErrorContext;
    wt_status status = WT_OK;
    bool is_out_of_memory = false;
    *document = (x3p_document){.list = NULL};
    xmlSetStructuredErrorFunc(&is_out_of_memory, note_xml_memory_error);
    const xmlDocPtr tree = xmlReadMemory(xml, (int)length, NULL, NULL,
                                         XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING |
                                             XML_PARSE_NOCDATA);
    if (is_out_of_memory) {
        status = wt_fail(err, WT_E_MEMORY, "no memory for main.xml");
    } else if (tree == NULL) {
        status = wt_fail(err, WT_E_CORRUPT, "main.xml is not well-formed");
    } else if (tree->intSubset != NULL) {
        status = wt_fail(err, WT_E_UNSUPPORTED, "main.xml has a document type or entities");
    } else {
        status = read_root(xmlDocGetRootElement(tree), document, err);
    }
    xmlSetStructuredErrorFunc(previous_context, previous);
    xmlFreeDoc(tree);
    return status;
}
