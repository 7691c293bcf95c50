/* Converts the channels of Nanosurf Studio files to SI units.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/nhf/nhf.h"

#include "core/store/hdf5_scope.h"
#include "read/force_assembler.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

bool nhf_channel_open(const nhf_file *f, hid_t segment, const char *name, nhf_channel *c,
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

wt_status nhf_channel_read(nhf_channel *c, size_t from, size_t n, wt_error *err)
{
    if (n > c->capacity) {
        double *const values = realloc(c->values, n * sizeof *values);
        if (values == NULL)
            return wt_fail(err, WT_E_MEMORY, "no memory for the numbers of a channel");
        c->values = values;
        c->capacity = n;
    }
    if (n > 0 && !hdf5_read_rows(c->data, from, n, c->values)) {
        wt_fail(err, WT_E_CORRUPT, "the numbers of a channel cannot be read");
        wt_error_expected(err, "as many as the file says");
        return WT_E_CORRUPT;
    }
    convert_to_units(c->values, n, c->missing, c->factor, c->scaling);
    return WT_OK;
}

void nhf_channel_close(nhf_channel *c)
{
    hdf5_close(c->data);
    free(c->values);
    *c = (nhf_channel){.data = -1};
}

/* Counts have a type and a calibration like those of a channel; a plain double is in metres. */
double *nhf_read_positions(const nhf_file *f, hid_t data, size_t *n)
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
