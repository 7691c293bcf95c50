/* Reads HDF5 files of afmformats (.h5). Each curve is a group with a data set for each column,
 * among them the segment number. The metadata are attributes. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/store/hdf5_sandbox.h"
#include "read/hierarchy/curves_hdf5.h"
#include "read/text/curve_text.h"
#include "read/text/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- in the sandbox -------------------------------------------------------------------------- */

enum { COLUMNS = 4, MISSING_MAX = 10000 };
static const struct {
    const char *name, *unit;
    wt_quantity quantity;
} known_columns[COLUMNS] = {{"time", "s", WT_Q_TIME},
                            {"height (piezo)", "m", WT_Q_HEIGHT},
                            {"height (measured)", "m", WT_Q_MEASURED_HEIGHT},
                            {"force", "N", WT_Q_FORCE}};

static wt_status fail_afm_curve(const char *name, const char *message, wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "%s", message);
    wt_error_place(err, "group %s", name);
    wt_error_expected(err, "columns of one length, and segment numbers that rise by one");
    return WT_E_CORRUPT;
}

/* The first segment is the approach and the last one the retract. Segments between them are
 * dwells. */
static wt_segment_kind segment_kind_from_number(size_t segment, size_t n)
{
    return segment == 0       ? WT_SEGMENT_APPROACH
           : segment == n - 1 ? WT_SEGMENT_RETRACT
                              : WT_SEGMENT_DWELL;
}

static wt_status print_rows(FILE *out, const curve_text *curve, const double *segments, size_t n,
                            const char *name, wt_error *err)
{
    if (segments[0] != 0 || !(segments[n - 1] < 64))
        return fail_afm_curve(name, "the numbers of the segments are not understood", err);
    for (size_t i = 1; i < n; i++)
        if (segments[i] != segments[i - 1] && segments[i] != segments[i - 1] + 1)
            return fail_afm_curve(name, "the numbers of the segments are not understood", err);
    const size_t n_segments = (size_t)segments[n - 1] + 1;
    for (size_t from = 0, to = 0; from < n; from = to) {
        while (to < n && segments[to] == segments[from])
            to++;
        curve_text_rows(out, curve, segment_kind_from_number((size_t)segments[from], n_segments),
                        from, to - from, false);
    }
    return WT_OK;
}

/* Reads a column of the expected length and unit; NULL if there is none. A damaged column sets
 * *wrong: to skip it would lose data without a message. */
static double *read_afm_column(hid_t group, const char *name, const char *unit, size_t size,
                               size_t n, const char **wrong)
{
    char text[HDF5_TEXT];
    size_t own = 0;
    const hid_t data = hdf5_open_data(group, name);
    double *values = data >= 0 ? hdf5_read_values(data, size, &own) : NULL;
    if (values == NULL && H5Lexists(group, name, H5P_DEFAULT) > 0)
        *wrong = "the numbers of a column cannot be read";
    else if (values != NULL &&
             (own != n || (hdf5_text_attribute(data, "unit", text) && strcmp(text, unit) != 0)))
        *wrong = "a column has another length or unit";
    hdf5_close(data);
    return values;
}

static wt_status print_afm_curve(hid_t group, const char *name, size_t number, size_t size,
                                 FILE *out, wt_error *err)
{
    curve_text curve = {
        .number = number,
        .x = hdf5_number_attribute(group, "position x", 0),
        .y = hdf5_number_attribute(group, "position y", 0),
        .cantilever = {.spring_constant = hdf5_number_attribute(group, "spring constant", 0),
                       .sensitivity = hdf5_number_attribute(group, "sensitivity", 0)}};
    double *values[COLUMNS] = {NULL};
    const char *wrong = NULL;
    size_t n = 0;
    const hid_t data = hdf5_open_data(group, "segment");
    double *segments = data >= 0 ? hdf5_read_values(data, size, &n) : NULL;
    hdf5_close(data);
    for (size_t i = 0; i < COLUMNS && segments != NULL; i++) {
        values[i] =
            read_afm_column(group, known_columns[i].name, known_columns[i].unit, size, n, &wrong);
        if (values[i] == NULL)
            continue;
        curve.columns[curve.n_columns].quantity = known_columns[i].quantity;
        curve.columns[curve.n_columns++].values = values[i];
    }
    wt_status status = WT_OK;
    if (segments == NULL || wrong != NULL) {
        status =
            fail_afm_curve(name, wrong != NULL ? wrong : "there are no numbers of segments", err);
    } else {
        curve_text_begin(out, &curve);
        status = print_rows(out, &curve, segments, n, name, err);
        curve_text_end(out);
    }
    for (size_t i = 0; i < COLUMNS; i++)
        free(values[i]);
    free(segments);
    return status;
}

/* A search for the smallest link name at or above `from` that is a number; HUGE_VAL if there is
 * none. */
typedef struct number_search {
    double from, least;
} number_search;

static herr_t find_next_number(hid_t group, const char *name, const H5L_info_t *info, void *user)
{
    (void)group;
    (void)info;
    number_search *search = user;
    double number;
    if (strspn(name, "0123456789") == strlen(name) &&
        wt_number_parse(name, strlen(name), '.', &number) && number >= search->from)
        search->least = fmin(search->least, number);
    return 0;
}

/* Fails if curves exist after the position at which the search stopped. */
static wt_status check_remaining_curves(hid_t file, size_t from, wt_error *err)
{
    number_search search = {(double)from, HUGE_VAL};
    (void)H5Literate(file, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, find_next_number, &search);
    if (isinf(search.least))
        return WT_OK;
    wt_fail(err, WT_E_UNSUPPORTED, "too many curves are missing before curve %.0f", search.least);
    wt_error_expected(err, "curves numbered from 0 on, less than %d numbers of them missing",
                      MISSING_MAX);
    wt_error_advice(err, "store those that there are with afmformats in a file of their own");
    return WT_E_UNSUPPORTED;
}

/* Prints all curves. Their groups are named by number, and some numbers may be missing. */
static wt_status print_curves(hid_t file, size_t size, FILE *out, wt_error *err)
{
    char name[HDF5_NAME];
    wt_status status = WT_OK;
    size_t n = 0, missing = 0, number = 0;
    const size_t links = hdf5_link_count(file);
    for (; n < links && missing < MISSING_MAX && status == WT_OK; number++) {
        snprintf(name, sizeof name, "%zu", number);
        const hid_t group = hdf5_open_group(file, name);
        missing += group < 0;
        if (group < 0)
            continue;
        n++;
        status = print_afm_curve(group, name, number, size, out, err);
        hdf5_close(group);
    }
    if (status == WT_OK && n < links)
        status = check_remaining_curves(file, number, err);
    if (status == WT_OK && n == 0) {
        status = wt_fail(err, WT_E_EMPTY, "the file holds no force curve");
        wt_error_expected(err, "groups \"0\", \"1\", ...");
    }
    return status;
}

static const hdf5_curves curves = {.keywords = "afmformats", .print = print_curves};

const file_reader reader_afmformats = {
    .info = {.id = "afmformats-h5",
             .title = "HDF5 files of afmformats (.h5)",
             .kinds = WT_KIND_FORCE,
             .verified = true,
             .evidence = "a file of afmformats 0.13.3",
             .version = "1"},
    HDF5_CURVES_READER(curves),
};
