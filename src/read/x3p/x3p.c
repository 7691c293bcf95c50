/* Reads X3P files (ISO 25178-72, ISO 5436-2): height maps and profiles in a ZIP archive of
 * main.xml, the heights and a validity bit for each. All of them are in one folder or at the top.
 *
 * Integers are scaled: z = raw * Increment + Offset. Floating-point numbers are used directly,
 * since the programs that write them do not apply the increment. The first line is at the bottom,
 * as y increases with its index. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/system/temporary.h"
#include "read/bytes/samples.h"
#include "read/bytes/zip.h"
#include "read/images.h"
#include "read/reader.h"

#include <libxml/parser.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct x3p_axis {
    bool incremental;
    sample_type type;         /* data type; used for Z only */
    double increment, offset; /* [m]; NaN if absent */
} x3p_axis;

enum { X3P_LINK = 128 };

typedef struct x3p_document {
    char feature[8]; /* SUR or PRF */
    x3p_axis axis[3];
    size_t size[3];                         /* size of the matrix: x, y, layers */
    char points[X3P_LINK], valid[X3P_LINK]; /* entries relative to main.xml; "" if absent */
    char points_md5[40];                    /* MD5 checksum of `points`; "" if absent */
    double *list;                           /* [n_list] raw heights in the document itself */
    size_t n_list;
} x3p_document;

static void x3p_document_clear(x3p_document *document)
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
    to->list = wt_alloc(n, sizeof *to->list);
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
            return fail_document(names[i], "an integer from 1 on", err);
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
        wt_error_advice(err,
                        "resample the points to a grid in the program that wrote the file, and "
                        "export them as .x3p, .gwy or .gsf");
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

/* Parses a document; the caller clears it, also after a failure. WT_E_UNSUPPORTED for other data
 * than a matrix of heights. */
static wt_status x3p_document_parse(const void *xml, size_t length, x3p_document *document,
                                    wt_error *err)
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

static const char document_name[] = "main.xml";
/* Maximum size of main.xml [byte]. A document with a list of heights is large; at 30 bytes each it
 * fits half a million. */
#define DOCUMENT_MAX ((size_t)1 << 24)
/* Maximum size of the heights, eight bytes for each pixel that images_add allows [byte]. */
#define DATA_MAX ((size_t)1 << 31)

typedef struct x3p_file {
    zip_archive *archive;
    char folder[64]; /* folder of main.xml with its '/', or "" */
    x3p_document document;
    byte_buffer data;
} x3p_file;

/* Finds main.xml at the top or in a folder, except for folders that macOS adds. */
static bool find_document(x3p_file *f, size_t *at)
{
    for (size_t i = 0; i < f->archive->n; i++) {
        const char *name = archive_name(f->archive, i), *slash = strchr(name, '/');
        const size_t n = slash != NULL ? (size_t)(slash - name) + 1 : 0;
        if (strcmp(name + n, document_name) != 0 || n >= sizeof f->folder ||
            strncmp(name, "__MACOSX", 8) == 0)
            continue;
        snprintf(f->folder, sizeof f->folder, "%.*s", (int)n, name);
        *at = i;
        return true;
    }
    return false;
}

static wt_status read_main_document(x3p_file *f, wt_error *err)
{
    size_t at = 0;
    if (!find_document(f, &at)) {
        wt_fail(err, WT_E_CORRUPT, "the archive holds no main.xml");
        wt_error_expected(err, "main.xml at the top or in one folder");
        return WT_E_CORRUPT;
    }
    wt_status status = archive_read(f->archive, at, DOCUMENT_MAX, &f->data, err);
    if (status == WT_OK)
        status = x3p_document_parse(f->data.data, f->data.length, &f->document, err);
    return status;
}

/* Reads an entry that the document names, relative to its folder. */
static wt_status read_linked_entry(x3p_file *f, const char *link, size_t length, wt_error *err)
{
    char name[sizeof f->folder + X3P_LINK];
    size_t at = 0;
    snprintf(name, sizeof name, "%s%s", f->folder, link + (strncmp(link, "./", 2) == 0 ? 2 : 0));
    if (!archive_find(f->archive, name, &at)) {
        wt_fail(err, WT_E_CORRUPT, "an entry is missing");
        wt_error_expected(err, "%s, which main.xml names", name);
        return WT_E_CORRUPT;
    }
    wt_status status = archive_read(f->archive, at, DATA_MAX, &f->data, err);
    if (status == WT_OK && f->data.length != length) {
        status = wt_fail(err, WT_E_CORRUPT, "the size of an entry contradicts main.xml");
        wt_error_place(err, "%s", name);
        wt_error_expected(err, "%zu bytes", length);
        wt_error_found(err, "%zu", f->data.length);
    }
    return status;
}

/* Checks the MD5 checksum of the heights. */
static wt_status check_md5(const x3p_file *f, wt_error *err)
{
    char hex[33];
    if (f->document.points_md5[0] == '\0')
        return WT_OK;
    digest_md5(f->data.data, f->data.length, hex);
    if (strcasecmp(hex, f->document.points_md5) == 0)
        return WT_OK;
    wt_fail(err, WT_E_CORRUPT,
            "the heights are not those that were written: their checksum differs");
    wt_error_place(err, "%s", f->document.points);
    wt_error_expected(err, "MD5 %s, as main.xml says", f->document.points_md5);
    wt_error_found(err, "%s", hex);
    wt_error_advice(err, "copy or export the file again");
    return WT_E_CORRUPT;
}

/* ---- layers ---------------------------------------------------------------------------------- */

static wt_status add_layers(const x3p_document *d, image_list *list, wt_error *err)
{
    const size_t nx = d->size[0], ny = d->size[1];
    wt_status status = WT_OK;
    for (size_t layer = 0; status == WT_OK && layer < d->size[2]; layer++) {
        wt_image head = {.n_columns = nx, .n_rows = ny, .unit = "m", .x_unit = "m"};
        double *values = NULL;
        char name[40];
        snprintf(name, sizeof name, d->size[2] > 1 ? "height, layer %zu" : "height", layer);
        images_set_name(&head, name);
        head.width = d->axis[0].increment * (double)(nx - 1);
        head.height = ny > 1 ? d->axis[1].increment * (double)(ny - 1) : 0;
        status = images_add(list, &head, &values, err);
    }
    return status;
}

/* Fills the layers from the entry, or from the list in the document. */
static wt_status fill_layers(x3p_file *f, const image_list *list, wt_error *err)
{
    const x3p_document *d = &f->document;
    const x3p_axis *z = &d->axis[2];
    const bool whole = z->type == SAMPLE_INT16 || z->type == SAMPLE_INT32;
    const double increment = whole && !isnan(z->increment) ? z->increment : 1,
                 offset = whole && !isnan(z->offset) ? z->offset : 0;
    const size_t n = d->size[0] * d->size[1], width = sample_width(z->type);
    if (d->points[0] != '\0') {
        wt_status status = read_linked_entry(f, d->points, n * d->size[2] * width, err);
        if (status == WT_OK)
            status = check_md5(f, err);
        if (status != WT_OK)
            return status;
    } else if (d->n_list != n * d->size[2]) {
        wt_fail(err, WT_E_CORRUPT, "the list of heights contradicts its size");
        wt_error_expected(err, "%zu", n * d->size[2]);
        wt_error_found(err, "%zu", d->n_list);
        return WT_E_CORRUPT;
    }
    for (size_t layer = 0; layer < list->n; layer++) {
        double *to = list->images[layer].values;
        if (d->points[0] != '\0') {
            samples_decode(z->type, false, f->data.data + layer * n * width, n, increment, offset,
                           to);
            continue;
        }
        for (size_t i = 0; i < n; i++)
            to[i] = increment * d->list[layer * n + i] + offset;
    }
    return WT_OK;
}

/* Marks invalid heights as missing: one bit for each height, the lowest bit first. */
static wt_status mark_invalid_heights(x3p_file *f, const image_list *list, wt_error *err)
{
    const x3p_document *d = &f->document;
    const size_t n = d->size[0] * d->size[1];
    if (d->valid[0] == '\0')
        return WT_OK;
    const wt_status status = read_linked_entry(f, d->valid, (n * d->size[2] + 7) / 8, err);
    for (size_t layer = 0; status == WT_OK && layer < list->n; layer++)
        for (size_t i = 0; i < n; i++) {
            const size_t bit = layer * n + i;
            if ((f->data.data[bit / 8] >> (bit % 8) & 1) == 0)
                list->images[layer].values[i] = (double)NAN;
        }
    return status;
}

/* ---- the reader ------------------------------------------------------------------------------ */

static wt_status x3p_images(const file_reader *self, wt_input *input,
                            const wt_read_options *options, wt_log *log, wt_image **images,
                            size_t *n_images, wt_error *err)
{
    x3p_file f = {.archive = NULL};
    image_list list = {NULL, 0};
    (void)self;
    (void)options;
    wt_status status = archive_open(input, &f.archive, err);
    if (status == WT_OK)
        status = read_main_document(&f, err);
    const x3p_document *d = &f.document;
    /* checked before any product is computed */
    if (status == WT_OK && (d->size[1] > DATA_MAX / 8 / d->size[0] ||
                            d->size[2] > DATA_MAX / 8 / (d->size[0] * d->size[1])))
        status = wt_fail(err, WT_E_CORRUPT, "impossible size of the matrix: %zu x %zu x %zu",
                         d->size[0], d->size[1], d->size[2]);
    if (status == WT_OK)
        status = add_layers(d, &list, err);
    if (status == WT_OK)
        status = fill_layers(&f, &list, err);
    if (status == WT_OK)
        status = mark_invalid_heights(&f, &list, err);
    x3p_document_clear(&f.document);
    free(f.data.data);
    archive_close(f.archive);
    return images_finish(&list, status, wt_input_name(input), log, images, n_images, err);
}

/* Entry names are not packed in the archive. Spreadsheets have none of these names. A JPK file
 * shows one of its own names at once, which spares the search of each force curve. */
static recognition detect(const file_reader *self, file_peek *peek)
{
    static const char jpk_name[] = "header.properties";
    (void)self;
    if (!PEEK_BEGINS(peek, "PK\3\4") ||
        memmem(peek->bytes, peek->length, jpk_name, sizeof jpk_name - 1) != NULL)
        return recognition_result(false, 0);
    return recognition_result(input_contains(peek->input, document_name) &&
                                  (input_contains(peek->input, "md5checksum.hex") ||
                                   input_contains(peek->input, "bindata/")),
                              95);
}

const file_reader reader_x3p = {
    .info = {.id = "x3p",
             .title = "X3P (ISO 25178-72), height maps and profiles",
             .kinds = WT_KIND_IMAGE,
             .verified = true,
             .evidence = "measured files and those of the standard's authors",
             .version = "1"},
    .detect = detect,
    .read_images = x3p_images,
    .describe = images_describe,
};
