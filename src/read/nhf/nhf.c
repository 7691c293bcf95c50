/* Reads Nanosurf Studio files: measurements, segments and curves, and the descriptor.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/nhf/nhf.h"
#include "core/base/memory.h"
#include "core/store/hdf5_sandbox.h"
#include "read/force_assembler.h"
#include "read/text/curve_text.h"
#include "read/text/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Longest path through the graph of calibrations. */
enum { NODES_MAX = 8 };

/* ---- the range of the stored type -------------------------------------------------------------
 */

typedef struct element_type {
    const char *name;
    int number; /* number of the type in version 1 */
    double minimum, maximum;
} element_type;

/* Finds the type of the stored numbers. Version 2 reserves one number of each integer type for
 * missing values. */
static bool find_element_type(const nhf_file *f, hid_t data, element_type *type, double *missing)
{
    static const element_type types[] = {
        {"int32", 0, -0x1p31, 0x1p31 - 1}, {"uint8", 1, 0, 255},
        {"uint16", 2, 0, 65535},           {"uint32", 3, 0, 0x1p32 - 1},
        {"int16", 5, -0x1p15, 0x1p15 - 1}, {"double", 7, 0, 1},
    };
    char name[HDF5_TEXT];
    const double number = hdf5_number_attribute(data, "dataset_element_type", 0);
    (void)hdf5_text_attribute(data, "dataset_element_type", name);
    *missing = (double)NAN;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (f->old ? number != types[i].number : strcmp(name, types[i].name) != 0)
            continue;
        *type = types[i];
        if (f->old || types[i].number == 7)
            return true;
        if (types[i].minimum < 0)
            *missing = type->minimum++;
        else
            *missing = type->maximum--;
        return true;
    }
    return false;
}

/* ---- the graph of calibrations ----------------------------------------------------------------
 */

/* Reduces a unit such as "Meter (m)" to "m". */
static void strip_unit_name(char text[HDF5_TEXT])
{
    char *open = strchr(text, '(');
    char *close = open != NULL ? strchr(open, ')') : NULL;
    if (close == NULL)
        return;
    *close = '\0';
    memmove(text, open + 1, strlen(open + 1) + 1);
}

typedef struct calibration_node {
    char source[HDF5_TEXT], sink[HDF5_TEXT], unit[HDF5_TEXT];
    force_linear to_sink;
} calibration_node;

/* Reads a linear calibration node that starts at `from`; false for any other node. */
static bool read_calibration_node(hid_t data, const char *from, calibration_node *to)
{
    char type[HDF5_TEXT], direction[HDF5_TEXT];
    const double a = hdf5_number_attribute(data, "signal_mapping_parameters", 0);
    const double b = hdf5_number_attribute(data, "signal_mapping_parameters", 1);
    (void)hdf5_text_attribute(data, "signal_mapping_type", type);
    (void)hdf5_text_attribute(data, "signal_invertibility", direction);
    (void)hdf5_text_attribute(data, "signal_source_id", to->source);
    (void)hdf5_text_attribute(data, "signal_sink_id", to->sink);
    const bool forward = strcmp(to->source, from) == 0;
    const bool right = strcmp(direction, "right") == 0, both = strcmp(direction, "two_way") == 0;
    if (strncmp(type, "linear", 6) != 0 || strstr(type, "interpolation") != NULL || !isfinite(a) ||
        !isfinite(b) || a == 0 || (!forward && strcmp(to->sink, from) != 0))
        return false;
    if (forward ? !right && !both : right)
        return false;
    (void)hdf5_text_attribute(data, forward ? "signal_sink_unit" : "signal_source_unit", to->unit);
    strip_unit_name(to->unit);
    /* a two-way node defines the source as a function of the sink */
    to->to_sink = forward && both ? (force_linear){1 / a, -b / a} : (force_linear){a, b};
    if (!forward)
        memcpy(to->sink, to->source, sizeof to->sink);
    return true;
}

/* Finds a path of nodes from one signal to another, without a step back to the signal before. */
static bool find_node_path(const nhf_file *f, const char *from, const char *before,
                           const char *wanted, int depth, force_linear *scaling,
                           char unit[HDF5_TEXT])
{
    char name[HDF5_NAME];
    for (size_t i = 0; depth < NODES_MAX && hdf5_link_name(f->calibration, i, name); i++) {
        calibration_node n;
        const hid_t data = hdf5_open_data(f->calibration, name);
        const bool leads =
            data >= 0 && read_calibration_node(data, from, &n) && strcmp(n.sink, before) != 0;
        hdf5_close(data);
        if (!leads)
            continue;
        force_linear rest = {1, 0};
        const bool there = strcmp(n.sink, wanted) == 0;
        if (!there && !find_node_path(f, n.sink, from, wanted, depth + 1, &rest, unit))
            continue;
        if (there)
            memcpy(unit, n.unit, sizeof n.unit);
        *scaling = (force_linear){rest.multiplier * n.to_sink.multiplier,
                                  rest.multiplier * n.to_sink.offset + rest.offset};
        return true;
    }
    return false;
}

/* ---- channels ---------------------------------------------------------------------------------
 */

/* Finds the conversion from the stored numbers to the unit. */
static bool find_scaling(const nhf_file *f, hid_t data, const element_type *type,
                         force_linear *scaling, char unit[HDF5_TEXT])
{
    char selected[HDF5_TEXT], signal_id[HDF5_TEXT];
    const double low =
        hdf5_number_attribute(data, f->old ? "base_calibration_min" : "signal_calibration_min", 0);
    const double high =
        hdf5_number_attribute(data, f->old ? "base_calibration_max" : "signal_calibration_max", 0);
    (void)hdf5_text_attribute(data, f->old ? "base_calibration_unit" : "signal_calibration_unit",
                              unit);
    strip_unit_name(unit);
    if (!f->old && hdf5_text_attribute(data, "signal_selected", selected) &&
        hdf5_text_attribute(data, "signal_id", signal_id) && strcmp(selected, signal_id) != 0 &&
        f->calibration >= 0)
        return find_node_path(f, signal_id, "", selected, 0, scaling, unit);
    if (!(high > low))
        return false;
    const double multiplier = (high - low) / (type->maximum - type->minimum);
    *scaling = (force_linear){multiplier, low - multiplier * type->minimum};
    return true;
}

/* Finds the quantity of a channel. The unit decides if a deflection is a force, a length or a
 * voltage. */
static bool find_channel_quantity(const char *name, const char *unit, wt_quantity *quantity,
                                  double *factor)
{
    static const struct {
        const char *name;
        wt_quantity quantity;
    } known[] = {{"Deflection", WT_Q_FORCE},
                 {"Deflection", WT_Q_DEFLECTION},
                 {"Deflection", WT_Q_DEFLECTION_VOLTAGE},
                 {"Position Z", WT_Q_HEIGHT},
                 {"Time", WT_Q_TIME}};
    double offset = 0;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(name, known[i].name) == 0 &&
            wt_unit_to_si(unit, known[i].quantity, factor, &offset, NULL) == WT_OK) {
            *quantity = known[i].quantity;
            return true;
        }
    return false;
}

static void convert_to_units(double *values, size_t n, double missing, double factor,
                             force_linear scaling)
{
    for (size_t i = 0; i < n; i++)
        values[i] = values[i] == missing
                        ? (double)NAN
                        : factor * (scaling.multiplier * values[i] + scaling.offset);
}

static bool is_supported_channel(const char *name)
{
    return strcmp(name, "Deflection") == 0 || strcmp(name, "Position Z") == 0 ||
           strcmp(name, "Time") == 0;
}

static void nhf_channel_close(nhf_channel *c)
{
    hdf5_close(c->data);
    free(c->values);
    *c = (nhf_channel){.data = -1};
}

/* Opens a channel with a known name, type and unit; the caller closes it. Returns false otherwise,
 * and sets *problem if the channel is required but not understood. */
static bool nhf_channel_open(const nhf_file *f, hid_t segment, const char *name, nhf_channel *c,
                             const char **problem)
{
    char title[HDF5_TEXT], unit[HDF5_TEXT];
    element_type type;
    *c = (nhf_channel){.data = hdf5_open_rows(segment, name), .scaling = {1, 0}};
    const bool wanted = c->data >= 0 &&
                        hdf5_text_attribute(c->data, f->old ? "name" : "signal_name", title) &&
                        is_supported_channel(title);
    if (!wanted)
        ; /* other data sets are ignored */
    else if (!find_element_type(f, c->data, &type, &c->missing) ||
             !find_scaling(f, c->data, &type, &c->scaling, unit))
        *problem = "the calibration of a channel is not understood";
    else if (!find_channel_quantity(title, unit, &c->quantity, &c->factor))
        *problem = "the unit of a channel is not understood";
    else if ((c->n = hdf5_value_count(c->data, f->size)) == 0)
        *problem = "the numbers of a channel cannot be read";
    if (c->n == 0)
        nhf_channel_close(c);
    return c->n > 0;
}

/* Reads the numbers [from, from + n), which exist, into `values`, in SI units. */
static wt_status nhf_channel_read(nhf_channel *c, size_t from, size_t n, wt_error *err)
{
    if (n > c->capacity) {
        free(c->values);
        c->values = try_alloc(n, sizeof *c->values);
        c->capacity = c->values != NULL ? n : 0;
        if (c->values == NULL)
            return wt_fail(err, WT_E_MEMORY, "no memory for the numbers of a channel");
    }
    if (n > 0 && !hdf5_read_rows(c->data, from, n, c->values)) {
        wt_fail(err, WT_E_CORRUPT, "the numbers of a channel cannot be read");
        wt_error_expected(err, "as many as the file says");
        return WT_E_CORRUPT;
    }
    convert_to_units(c->values, n, c->missing, c->factor, c->scaling);
    return WT_OK;
}

/* Reads lateral positions [m]; the caller frees them. NULL if the numbers are not understood.
 * Counts have a type and a calibration like those of a channel; a plain double is in metres. */
static double *nhf_read_positions(const nhf_file *f, hid_t data, size_t *n)
{
    char unit[HDF5_TEXT];
    element_type type;
    force_linear scaling = {1, 0};
    double missing = (double)NAN, factor = 1, offset = 0;
    const hid_t stored = H5Dget_type(data);
    const bool whole = H5Tget_class(stored) != H5T_FLOAT;
    hdf5_close(stored);
    const bool known =
        find_element_type(f, data, &type, &missing) && find_scaling(f, data, &type, &scaling, unit);
    if (known ? wt_unit_to_si(unit, WT_Q_LENGTH, &factor, &offset, NULL) != WT_OK : whole)
        return NULL;
    double *values = hdf5_read_values(data, f->size, n);
    if (values != NULL && known)
        convert_to_units(values, *n, missing, factor, scaling);
    return values;
}

enum { CHANNELS = 3, SEGMENTS = 16 };

typedef struct nhf_segment {
    wt_segment_kind kind;
    double order; /* number of the segment, or of its link */
    nhf_channel channels[CHANNELS];
    size_t n_channels;
    double *sizes;         /* [n_curves] samples of each curve */
    size_t n_curves, from; /* first sample of the current curve */
} nhf_segment;

typedef struct nhf_measurement {
    nhf_segment segments[SEGMENTS];
    size_t n_segments, n_curves;
    wt_cantilever cantilever;
    double *x, *y; /* [n_curves], or NULL */
} nhf_measurement;

static wt_status fail_measurement(const char *place, const char *message, const char *expected,
                                  wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_place(err, "%s", place);
    wt_error_expected(err, "%s", expected);
    return WT_E_CORRUPT;
}

static void clear_measurement(nhf_measurement *m)
{
    for (size_t s = 0; s < m->n_segments; s++) {
        for (size_t c = 0; c < m->segments[s].n_channels; c++)
            nhf_channel_close(&m->segments[s].channels[c]);
        free(m->segments[s].sizes);
    }
    free(m->x);
    free(m->y);
    *m = (nhf_measurement){.n_segments = 0};
}

/* ---- segments ---------------------------------------------------------------------------------
 */

static wt_segment_kind segment_kind_from_name(const char *name)
{
    static const struct {
        const char *word;
        wt_segment_kind kind;
    } keywords[] = {{"advance", WT_SEGMENT_APPROACH}, {"approach", WT_SEGMENT_APPROACH},
                    {"forward", WT_SEGMENT_APPROACH}, {"retract", WT_SEGMENT_RETRACT},
                    {"backward", WT_SEGMENT_RETRACT}, {"wait", WT_SEGMENT_DWELL},
                    {"pause", WT_SEGMENT_DWELL},      {"sweep", WT_SEGMENT_MODULATION}};
    for (size_t i = 0; i < sizeof keywords / sizeof *keywords; i++)
        if (strcasestr(name, keywords[i].word) != NULL)
            return keywords[i].kind;
    return WT_SEGMENT_OTHER;
}

/* Returns the data set of a group whose attribute has this text; -1 if there is none. */
static hid_t find_data_set(hid_t group, const char *attribute, const char *text)
{
    char name[HDF5_NAME], found[HDF5_TEXT];
    for (size_t i = 0; hdf5_link_name(group, i, name); i++) {
        const hid_t data = hdf5_open_data(group, name);
        if (data >= 0 && hdf5_text_attribute(data, attribute, found) && strcmp(found, text) == 0)
            return data;
        hdf5_close(data);
    }
    return -1;
}

/* Reads the number of samples of each curve: from the data set to which the channel refers, in
 * version 1 from a channel. Without either there is one curve. */
static wt_status read_curve_sizes(const nhf_file *f, hid_t group, const char *source,
                                  nhf_segment *s, const char *place, wt_error *err)
{
    const size_t n = s->channels[0].n;
    double sum = 0;
    const hid_t data = f->old ? find_data_set(group, "name", "number_of_datapoints_acquired")
                              : find_data_set(group, "dataset_block_size_id", source);
    s->sizes = data >= 0 ? hdf5_read_values(data, f->size, &s->n_curves) : NULL;
    hdf5_close(data);
    if (s->sizes == NULL && (f->old || source[0] == '\0')) {
        s->sizes = wt_alloc(1, sizeof *s->sizes);
        s->sizes[0] = (double)n;
        s->n_curves = 1;
    }
    for (size_t i = 0; s->sizes != NULL && i < s->n_curves; i++) {
        if (!(s->sizes[i] >= 0 && s->sizes[i] <= (double)n) || s->sizes[i] != floor(s->sizes[i]))
            sum = (double)NAN;
        sum += s->sizes[i];
    }
    if (s->sizes == NULL || !(sum <= (double)n))
        return fail_measurement(place,
                                "the numbers of samples of the curves contradict the channel",
                                "integers that add up to the length of the channel", err);
    return WT_OK;
}

static wt_status read_nhf_segment(const nhf_file *f, hid_t group, const char *place, nhf_segment *s,
                                  wt_error *err)
{
    char name[HDF5_NAME], source[HDF5_TEXT] = "";
    const char *problem = NULL;
    wt_status status = WT_OK;
    for (size_t i = 0;
         status == WT_OK && hdf5_link_name(group, i, name) && s->n_channels < CHANNELS; i++) {
        nhf_channel *c = &s->channels[s->n_channels];
        if (nhf_channel_open(f, group, name, c, &problem)) {
            if (s->n_channels++ == 0)
                (void)hdf5_text_attribute(c->data, "dataset_block_size_source", source);
            if (c->n != s->channels[0].n)
                problem = "channels of different length";
        }
        if (problem != NULL)
            status = fail_measurement(place, problem,
                                      "a type and a linear calibration that are known", err);
    }
    return status == WT_OK && s->n_channels > 0 ? read_curve_sizes(f, group, source, s, place, err)
                                                : status;
}

static int compare_segment_order(const void *a, const void *b)
{
    const nhf_segment *x = a, *y = b;
    return x->order < y->order ? -1 : x->order > y->order;
}

static double read_positive_attribute(hid_t group, const char *attribute)
{
    const double value = hdf5_number_attribute(group, attribute, 0);
    return value > 0 ? value : (double)NAN;
}

/* Reads the positions of the curves: a channel of the measurement with one number for each
 * curve. */
static void read_positions(const nhf_file *f, hid_t group, nhf_measurement *m)
{
    const char *key = f->old ? "name" : "signal_name";
    double **const positions[] = {&m->x, &m->y};
    static const char *const names[] = {"Position X", "Position Y"};
    for (size_t i = 0; i < 2; i++) {
        size_t n = 0;
        const hid_t data = find_data_set(group, key, names[i]);
        *positions[i] = data >= 0 ? nhf_read_positions(f, data, &n) : NULL;
        hdf5_close(data);
        if (n != m->n_curves) {
            free(*positions[i]);
            *positions[i] = NULL;
        }
    }
}

static wt_status read_measurement(const nhf_file *f, hid_t group, nhf_measurement *m, wt_error *err)
{
    char name[HDF5_NAME], title[HDF5_TEXT];
    wt_status status = WT_OK;
    m->cantilever = (wt_cantilever){
        .spring_constant = read_positive_attribute(group, "spm_probe_calibration_spring_constant"),
        .sensitivity =
            read_positive_attribute(group, "spm_probe_calibration_deflection_sensitivity")};
    for (size_t i = 0; status == WT_OK && hdf5_link_name(group, i, name); i++) {
        const hid_t inner = hdf5_open_group(group, name);
        if (inner >= 0 && hdf5_text_attribute(inner, f->old ? "name" : "segment_name", title)) {
            if (m->n_segments == SEGMENTS) {
                hdf5_close(inner);
                return fail_measurement(name, "a measurement of more segments than any has",
                                        "16 or fewer", err);
            }
            nhf_segment *s = &m->segments[m->n_segments];
            const double order = hdf5_number_attribute(inner, "segment_index", 0);
            *s = (nhf_segment){.kind = segment_kind_from_name(title),
                               .order = isfinite(order) ? order : (double)i};
            m->n_segments++;
            status = read_nhf_segment(f, inner, name, s, err);
            m->n_curves = s->n_curves > m->n_curves ? s->n_curves : m->n_curves;
        }
        hdf5_close(inner);
    }
    if (status == WT_OK) {
        qsort(m->segments, m->n_segments, sizeof *m->segments, compare_segment_order);
        read_positions(f, group, m);
    }
    return status;
}

/* ---- curves -----------------------------------------------------------------------------------
 */

/* Returns the change from the first to the last valid number; 0 if there are less than two. */
static double height_rise(const double *values, size_t n)
{
    size_t first = 0;
    while (first < n && isnan(values[first]))
        first++;
    while (n > first && isnan(values[n - 1]))
        n--;
    return n > first ? values[n - 1] - values[first] : 0;
}

/* Sets the sign of the heights from the first approach, since the sign is known from other programs
 * only. */
static wt_status orient_heights(nhf_measurement *m, wt_error *err)
{
    double rise = 0;
    for (size_t s = 0; s < m->n_segments && rise == 0; s++)
        for (size_t c = 0; c < m->segments[s].n_channels; c++) {
            nhf_channel *channel = &m->segments[s].channels[c];
            const size_t n = m->segments[s].n_curves > 0 ? (size_t)m->segments[s].sizes[0] : 0;
            if (m->segments[s].kind != WT_SEGMENT_APPROACH || channel->quantity != WT_Q_HEIGHT)
                continue;
            const wt_status status = nhf_channel_read(channel, 0, n, err);
            if (status != WT_OK)
                return status;
            rise = height_rise(channel->values, n);
        }
    for (size_t s = 0; s < m->n_segments && rise > 0; s++)
        for (size_t c = 0; c < m->segments[s].n_channels; c++)
            if (m->segments[s].channels[c].quantity == WT_Q_HEIGHT)
                m->segments[s].channels[c].factor *= -1;
    return WT_OK;
}

/* Prints a curve. Each segment has its own columns and a time that begins at 0; the printed time
 * runs on through the curve. */
static wt_status print_nhf_curve(nhf_measurement *m, size_t number, size_t curve, FILE *out,
                                 wt_error *err)
{
    double end = 0;
    bool begun = false;
    for (size_t i = 0; i < m->n_segments; i++) {
        nhf_segment *s = &m->segments[i];
        const size_t n = curve < s->n_curves ? (size_t)s->sizes[curve] : 0;
        curve_text text = {.number = number,
                           .x = m->x != NULL ? m->x[curve] : (double)NAN,
                           .y = m->y != NULL ? m->y[curve] : (double)NAN,
                           .cantilever = m->cantilever,
                           .n_columns = s->n_channels};
        for (size_t c = 0; c < s->n_channels; c++) {
            const wt_status status = nhf_channel_read(&s->channels[c], s->from, n, err);
            if (status != WT_OK)
                return status;
            double *const values = s->channels[c].values;
            text.columns[c].quantity = s->channels[c].quantity;
            text.columns[c].values = values;
            if (s->channels[c].quantity != WT_Q_TIME || n == 0)
                continue;
            const double shift = values[0] < end ? end : 0;
            for (size_t k = 0; k < n; k++)
                values[k] += shift;
            end = values[n - 1];
        }
        if (n > 0) {
            (begun ? curve_text_names : curve_text_begin)(out, &text);
            curve_text_rows(out, &text, s->kind, 0, n, false);
            begun = true;
        }
        s->from += n;
    }
    if (begun)
        curve_text_end(out);
    return WT_OK;
}

static wt_status print_curves(hid_t file, size_t size, FILE *out, wt_error *err)
{
    char name[HDF5_NAME], type[HDF5_TEXT];
    nhf_file f = {.file = file, .size = size, .calibration = -1};
    size_t number = 0;
    wt_status status = WT_OK;
    const double version = hdf5_number_attribute(file, "nsf_file_version_major", 0);
    if (version != 1 && version != 2) {
        wt_fail(err, WT_E_UNSUPPORTED, "this version of Nanosurf files is not known");
        wt_error_expected(err, "nsf_file_version_major 1 or 2");
        return WT_E_UNSUPPORTED;
    }
    f.old = version == 1;
    for (size_t i = 0; f.calibration < 0 && hdf5_link_name(file, i, name); i++) {
        const hid_t group = hdf5_open_group(file, name);
        if (group >= 0 && hdf5_text_attribute(group, "group_type", type) &&
            strcmp(type, "calibration") == 0)
            f.calibration = group;
        else
            hdf5_close(group);
    }
    for (size_t i = 0; status == WT_OK && hdf5_link_name(file, i, name); i++) {
        nhf_measurement m = {.n_segments = 0};
        const hid_t group = hdf5_open_group(file, name);
        if (group >= 0 &&
            hdf5_text_attribute(group, f.old ? "measurement_type" : "group_type", type) &&
            strncmp(type, "spectroscopy", 12) == 0)
            status = read_measurement(&f, group, &m, err);
        if (status == WT_OK)
            status = orient_heights(&m, err);
        for (size_t curve = 0; status == WT_OK && curve < m.n_curves; curve++)
            status = print_nhf_curve(&m, number++, curve, out, err);
        clear_measurement(&m);
        hdf5_close(group);
    }
    hdf5_close(f.calibration);
    if (status == WT_OK && number == 0) {
        status = wt_fail(err, WT_E_EMPTY, "the file holds no force curve");
        wt_error_expected(err, "a group of spectroscopy with Deflection and Position Z");
    }
    return status;
}

static const hdf5_curves curves = {
    .keywords = "nsf_file_version_major",
    .print = print_curves,
    .note = "force curves of this format were not verified on a genuine file: compare one with the "
            "instrument's own software"};

const file_reader reader_nhf = {
    .info = {.id = "nhf",
             .title = "Nanosurf Studio force curves and maps (.nhf)",
             .kinds = WT_KIND_FORCE,
             .verified = false,
             .evidence = "two other programs that read it; no measured file",
             .version = "1"},
    HDF5_CURVES_READER(curves),
};
