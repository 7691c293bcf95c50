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
static bool find_type(const nhf_file *f, hid_t data, element_type *type, double *missing)
{
    static const element_type types[] = {
        {"int32", 0, -0x1p31, 0x1p31 - 1}, {"uint8", 1, 0, 255},
        {"uint16", 2, 0, 65535},           {"uint32", 3, 0, 0x1p32 - 1},
        {"int16", 5, -0x1p15, 0x1p15 - 1}, {"double", 7, 0, 1},
    };
    char name[HDF5_TEXT];
    const double number = hdf5_number(data, "dataset_element_type", 0);
    (void)hdf5_text(data, "dataset_element_type", name);
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
static void unit_of(char text[HDF5_TEXT])
{
    char *open = strchr(text, '(');
    char *close = open != NULL ? strchr(open, ')') : NULL;
    if (close == NULL)
        return;
    *close = '\0';
    memmove(text, open + 1, strlen(open + 1) + 1);
}

typedef struct node {
    char source[HDF5_TEXT], sink[HDF5_TEXT], unit[HDF5_TEXT];
    force_linear to_sink;
} node;

/* Reads a linear calibration node that starts at `from`; false for any other node. */
static bool read_node(hid_t data, const char *from, node *to)
{
    char type[HDF5_TEXT], ways[HDF5_TEXT];
    const double a = hdf5_number(data, "signal_mapping_parameters", 0);
    const double b = hdf5_number(data, "signal_mapping_parameters", 1);
    (void)hdf5_text(data, "signal_mapping_type", type);
    (void)hdf5_text(data, "signal_invertibility", ways);
    (void)hdf5_text(data, "signal_source_id", to->source);
    (void)hdf5_text(data, "signal_sink_id", to->sink);
    const bool forward = strcmp(to->source, from) == 0;
    const bool right = strcmp(ways, "right") == 0, both = strcmp(ways, "two_way") == 0;
    if (strncmp(type, "linear", 6) != 0 || strstr(type, "interpolation") != NULL || !isfinite(a) ||
        !isfinite(b) || a == 0 || (!forward && strcmp(to->sink, from) != 0))
        return false;
    if (forward ? !right && !both : right)
        return false;
    (void)hdf5_text(data, forward ? "signal_sink_unit" : "signal_source_unit", to->unit);
    unit_of(to->unit);
    /* a two-way node defines the source as a function of the sink */
    to->to_sink = forward && both ? (force_linear){1 / a, -b / a} : (force_linear){a, b};
    if (!forward)
        memcpy(to->sink, to->source, sizeof to->sink);
    return true;
}

/* Finds a path of nodes from one signal to another, without a step back to the signal before. */
static bool walk_nodes(const nhf_file *f, const char *from, const char *before, const char *wanted,
                       int depth, force_linear *scaling, char unit[HDF5_TEXT])
{
    char name[HDF5_NAME];
    for (size_t i = 0; depth < NODES_MAX && hdf5_link(f->calibration, i, name); i++) {
        node n;
        const hid_t data = hdf5_open_data(f->calibration, name);
        const bool leads = data >= 0 && read_node(data, from, &n) && strcmp(n.sink, before) != 0;
        hdf5_close(data);
        if (!leads)
            continue;
        force_linear rest = {1, 0};
        const bool there = strcmp(n.sink, wanted) == 0;
        if (!there && !walk_nodes(f, n.sink, from, wanted, depth + 1, &rest, unit))
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
    char selected[HDF5_TEXT], own[HDF5_TEXT];
    const double low =
        hdf5_number(data, f->old ? "base_calibration_min" : "signal_calibration_min", 0);
    const double high =
        hdf5_number(data, f->old ? "base_calibration_max" : "signal_calibration_max", 0);
    (void)hdf5_text(data, f->old ? "base_calibration_unit" : "signal_calibration_unit", unit);
    unit_of(unit);
    if (!f->old && hdf5_text(data, "signal_selected", selected) &&
        hdf5_text(data, "signal_id", own) && strcmp(selected, own) != 0 && f->calibration >= 0)
        return walk_nodes(f, own, "", selected, 0, scaling, unit);
    if (!(high > low))
        return false;
    const double multiplier = (high - low) / (type->maximum - type->minimum);
    *scaling = (force_linear){multiplier, low - multiplier * type->minimum};
    return true;
}

/* Finds the quantity of a channel. The unit decides if a deflection is a force, a length or a
 * voltage. */
static bool find_quantity(const char *name, const char *unit, wt_quantity *quantity, double *factor)
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

static void to_units(double *values, size_t n, double missing, double factor, force_linear scaling)
{
    for (size_t i = 0; i < n; i++)
        values[i] = values[i] == missing
                        ? (double)NAN
                        : factor * (scaling.multiplier * values[i] + scaling.offset);
}

static bool is_wanted(const char *name)
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
                        hdf5_text(c->data, f->old ? "name" : "signal_name", title) &&
                        is_wanted(title);
    if (!wanted)
        ; /* other data sets are ignored */
    else if (!find_type(f, c->data, &type, &c->missing) ||
             !find_scaling(f, c->data, &type, &c->scaling, unit))
        *problem = "the calibration of a channel is not understood";
    else if (!find_quantity(title, unit, &c->quantity, &c->factor))
        *problem = "the unit of a channel is not understood";
    else if ((c->n = hdf5_count(c->data, f->size)) == 0)
        *problem = "the numbers of a channel cannot be read";
    if (c->n == 0)
        nhf_channel_close(c);
    return c->n > 0;
}

wt_status nhf_channel_take(nhf_channel *c, size_t from, size_t n, wt_error *err)
{
    if (n > c->room) {
        double *const values = realloc(c->values, n * sizeof *values);
        if (values == NULL)
            return wt_fail(err, WT_E_MEMORY, "no memory for the numbers of a channel");
        c->values = values;
        c->room = n;
    }
    if (n > 0 && !hdf5_rows(c->data, from, n, c->values)) {
        wt_fail(err, WT_E_CORRUPT, "the numbers of a channel cannot be read");
        wt_error_expected(err, "as many as the file says");
        return WT_E_CORRUPT;
    }
    to_units(c->values, n, c->missing, c->factor, c->scaling);
    return WT_OK;
}

void nhf_channel_close(nhf_channel *c)
{
    hdf5_close(c->data);
    free(c->values);
    *c = (nhf_channel){.data = -1};
}

/* Counts have a type and a calibration like those of a channel; a plain double is in metres. */
double *nhf_places_read(const nhf_file *f, hid_t data, size_t *n)
{
    char unit[HDF5_TEXT];
    element_type type;
    force_linear scaling = {1, 0};
    double missing = (double)NAN, factor = 1, offset = 0;
    const hid_t stored = H5Dget_type(data);
    const bool whole = H5Tget_class(stored) != H5T_FLOAT;
    hdf5_close(stored);
    const bool known =
        find_type(f, data, &type, &missing) && find_scaling(f, data, &type, &scaling, unit);
    if (known ? wt_unit_to_si(unit, WT_Q_LENGTH, &factor, &offset, NULL) != WT_OK : whole)
        return NULL;
    double *values = hdf5_values(data, f->size, n);
    if (values != NULL && known)
        to_units(values, *n, missing, factor, scaling);
    return values;
}
