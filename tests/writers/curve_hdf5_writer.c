/* HDF5 files of force curves for tests.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/curve_hdf5_writer.h"

#include <hdf5.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures;

static void check(long long result)
{
    failures += result < 0;
}

static void put_attribute(hid_t object, const char *name, hid_t type, size_t n, const void *value)
{
    const hsize_t size = n;
    const hid_t space = n > 1 ? H5Screate_simple(1, &size, NULL) : H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    check(H5Awrite(attribute, type, value));
    check(H5Aclose(attribute));
    check(H5Sclose(space));
}

static void put_number(hid_t object, const char *name, double value)
{
    put_attribute(object, name, H5T_NATIVE_DOUBLE, 1, &value);
}

static void put_text(hid_t object, const char *name, const char *text, bool fixed)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    check(H5Tset_size(type, fixed ? strlen(text) + 1 : H5T_VARIABLE));
    put_attribute(object, name, type, 1, fixed ? (const void *)text : (const void *)&text);
    check(H5Tclose(type));
}

/* The object is left open for attributes. */
static hid_t put_data(hid_t group, const char *name, hid_t type, size_t n, const void *values,
                      bool packed)
{
    const hsize_t size = n;
    const hid_t space = H5Screate_simple(1, &size, NULL), list = H5Pcreate(H5P_DATASET_CREATE);
    check(H5Pset_obj_track_times(list, false)); /* makes the bytes reproducible */
    if (packed) {
        check(H5Pset_chunk(list, 1, &size));
        check(H5Pset_deflate(list, 6));
    }
    const hid_t data = H5Dcreate2(group, name, type, space, H5P_DEFAULT, list, H5P_DEFAULT);
    check(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
    check(H5Pclose(list));
    check(H5Sclose(space));
    return data;
}

static hid_t make_group(hid_t parent, const char *name)
{
    return H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

static void put_column(hid_t group, const char *name, const double *values, size_t n,
                       const char *unit, bool packed)
{
    if (values == NULL)
        return;
    const hid_t data = put_data(group, name, H5T_NATIVE_DOUBLE, n, values, packed);
    put_text(data, "unit", unit, false);
    check(H5Dclose(data));
}

int afmformats_write(const afmformats_writer_file *f)
{
    failures = 0;
    const hid_t file = H5Fcreate(f->path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    put_text(file, "software", "afmformats", false);
    put_text(file, "software version", "0.13.3", false);
    for (size_t i = 0; i < f->n_curves; i++) {
        char name[32];
        snprintf(name, sizeof name, "%zu", f->number_step > 0 ? i * f->number_step : i);
        const hid_t group = make_group(file, name);
        put_number(group, "position x", 1e-6 * (double)i);
        put_number(group, "position y", 2e-6);
        put_number(group, "spring constant", f->spring_constant);
        put_number(group, "sensitivity", 5e-8);
        put_column(group, "time", f->time != NULL ? f->time + i * f->n : NULL, f->n, "s",
                   f->packed);
        put_column(group, "height (measured)", f->height + i * f->n, f->n, "m", f->packed);
        put_column(group, "force", f->force + i * f->n, f->n, f->force_unit, f->packed);
        check(H5Dclose(put_data(group, "segment", H5T_NATIVE_UCHAR, f->n, f->segments, f->packed)));
        check(H5Gclose(group));
    }
    check(H5Fclose(file));
    return failures == 0 ? 0 : -1;
}

/* ---- Nanosurf ---------------------------------------------------------------------------------
 */

static void put_channel(const nhf_writer_file *f, hid_t group, size_t number, size_t n,
                        const nhf_writer_channel *c)
{
    const bool old = f->version == 1;
    const double low = old ? -0x1p31 : -0x1p31 + 1, high = 0x1p31 - 1;
    const double step = (c->maximum - c->minimum) / (high - low);
    char name[32];
    int32_t *counts = calloc(n, sizeof *counts);
    if (counts == NULL)
        abort();
    for (size_t i = 0; i < n; i++)
        counts[i] = isnan(c->values[i]) ? INT32_MIN
                                        : (int32_t)rint((c->values[i] - c->minimum) / step + low);
    snprintf(name, sizeof name, "dataset_%04zu", number);
    const hid_t data = put_data(group, name, H5T_NATIVE_INT32, n, counts, false);
    put_text(data, old ? "name" : "signal_name", c->name, !old);
    put_text(data, old ? "base_calibration_unit" : "signal_calibration_unit", c->unit, old);
    put_number(data, old ? "base_calibration_min" : "signal_calibration_min", c->minimum);
    put_number(data, old ? "base_calibration_max" : "signal_calibration_max", c->maximum);
    if (old)
        put_number(data, "dataset_element_type", 0);
    else
        put_text(data, "dataset_element_type", "int32", false);
    if (!old)
        put_text(data, "dataset_block_size_source", "blocks", false);
    if (f->newtons_per_count > 0 && strcmp(c->name, "Deflection") == 0) {
        put_text(data, "signal_id", "raw", false);
        put_text(data, "signal_selected", "force", false);
    }
    check(H5Dclose(data));
    free(counts);
}

static void put_segment(const nhf_writer_file *f, hid_t parent, size_t number)
{
    const nhf_writer_segment *s = &f->segments[number];
    size_t n = 0;
    char name[32];
    for (size_t i = 0; i < f->n_curves; i++)
        n += (size_t)s->sizes[i];
    /* The alphabetical order of the links is the reverse of the time order. */
    snprintf(name, sizeof name, "segment_%04zu", f->n_segments - number);
    const hid_t group = make_group(parent, name);
    put_text(group, f->version == 1 ? "name" : "segment_name", s->name, false);
    put_number(group, "segment_index", (double)number);
    for (size_t c = 0; c < s->n_channels; c++)
        put_channel(f, group, c, n, &s->channels[c]);
    const hid_t sizes = put_data(group, "sizes", H5T_NATIVE_INT, f->n_curves, s->sizes, false);
    if (f->version == 1)
        put_text(sizes, "name", "number_of_datapoints_acquired", false);
    else
        put_text(sizes, "dataset_block_size_id", "blocks", false);
    check(H5Dclose(sizes));
    check(H5Gclose(group));
}

/* From counts to volts, and from force back to volts: this node is written in reverse. */
static void put_calibration(const nhf_writer_file *f, hid_t file)
{
    static const double zero = 0;
    const hid_t group = make_group(file, "group_0001");
    put_text(group, "group_type", "calibration", false);
    const double to_volts[] = {2, zero}, to_counts[] = {2 / f->newtons_per_count, zero};
    const struct {
        const char *source, *sink, *unit, *ways;
        const double *parameters;
    } nodes[] = {{"raw", "volts", "Volt (V)", "right", to_volts},
                 {"volts", "force", "Newton (N)", "two_way", to_counts}};
    for (size_t i = 0; i < 2; i++) {
        char name[32];
        snprintf(name, sizeof name, "dataset_%04zu", i);
        const hid_t data = put_data(group, name, H5T_NATIVE_DOUBLE, 1, &zero, false);
        put_text(data, "signal_source_id", nodes[i].source, false);
        put_text(data, "signal_sink_id", nodes[i].sink, false);
        put_text(data, "signal_sink_unit", nodes[i].unit, false);
        put_text(data, "signal_source_unit", "Volt (V)", false);
        put_text(data, "signal_mapping_type", "linear", false);
        put_text(data, "signal_invertibility", nodes[i].ways, false);
        put_attribute(data, "signal_mapping_parameters", H5T_NATIVE_DOUBLE, 2, nodes[i].parameters);
        check(H5Dclose(data));
    }
    check(H5Gclose(group));
}

int nhf_write(const nhf_writer_file *f)
{
    failures = 0;
    const bool old = f->version == 1;
    const hid_t file = H5Fcreate(f->path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    put_number(file, "nsf_file_version_major", f->version);
    put_number(file, "nsf_file_version_minor", 1);
    const hid_t group = make_group(file, old ? "measurement_0" : "group_0000");
    put_text(group, old ? "measurement_type" : "group_type", f->type, false);
    put_number(group, "spm_probe_calibration_spring_constant", f->spring_constant);
    put_number(group, "spm_probe_calibration_deflection_sensitivity", f->sensitivity);
    for (size_t i = 0; i < 2; i++) {
        const hid_t data = put_data(group, i == 0 ? "dataset_0000" : "dataset_0001",
                                    H5T_NATIVE_DOUBLE, f->n_curves, i == 0 ? f->x : f->y, false);
        put_text(data, old ? "name" : "signal_name", i == 0 ? "Position X" : "Position Y", false);
        check(H5Dclose(data));
    }
    for (size_t i = 0; f->places_range > 0 && i < 2; i++) {
        const nhf_writer_channel places = {i == 0 ? "Position X" : "Position Y", "Meter (m)",
                                           -f->places_range, f->places_range, i == 0 ? f->x : f->y};
        check(H5Ldelete(group, i == 0 ? "dataset_0000" : "dataset_0001", H5P_DEFAULT));
        put_channel(f, group, i, f->n_curves, &places);
    }
    for (size_t i = 0; i < f->n_segments; i++)
        put_segment(f, group, i);
    check(H5Gclose(group));
    if (f->newtons_per_count > 0)
        put_calibration(f, file);
    check(H5Fclose(file));
    return failures == 0 ? 0 : -1;
}
