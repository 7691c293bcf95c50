/* The files of a case and how they are read.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/case/case_sections.h"

#include <math.h>
#include <string.h>

/* "NAME=UNIT; NAME=UNIT" to an array owned by the case. */
static wt_status split_units(wt_case *c, const xmlNode *node, const char *text,
                             wt_read_options *read, wt_error *err)
{
    size_t n = 1;
    for (const char *p = text; *p != '\0'; p++)
        n += *p == ';';
    const char **units = case_alloc(c, n * sizeof *units);
    if (units == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    const char *begin = text;
    for (size_t i = 0; i < n; i++) {
        size_t length = strcspn(begin, ";"), skip = strspn(begin, " \t\r\n");
        if (skip > length)
            skip = length;
        char *unit = case_text(c, begin + skip, length - skip);
        if (unit == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        if (strchr(unit, '=') == NULL) {
            wt_fail(err, WT_E_UNIT, "a unit of a column is NAME=UNIT");
            wt_error_expected(err, "units=\"Force=nN; Height=um\"");
            wt_error_found(err, "\"%s\"", unit);
            return case_at(node, "units", WT_E_UNIT, err);
        }
        units[i] = unit;
        begin += length + (begin[length] == ';');
    }
    read->units = units;
    read->n_units = n;
    return WT_OK;
}

/* What the attributes of a node say on top of what is there. */
static wt_status read_attributes(wt_case *c, const xmlNode *node, wt_file_set *set,
                                 wt_estimate *spring_constant, wt_error *err)
{
    wt_estimate k = *spring_constant;
    double sensitivity = set->read.sensitivity, temperature = set->read.temperature;
    const char *units = NULL;
    wt_status status = case_get_attribute(c, node, "format", &set->read.format, err);
    if (status == WT_OK)
        status = case_get_attribute(c, node, "units", &units, err);
    if (status == WT_OK && units != NULL)
        status = split_units(c, node, units, &set->read, err);
    if (status == WT_OK)
        status = case_get_attribute(c, node, "spot", &set->spot, err);
    if (status == WT_OK)
        status =
            case_get_attribute_estimate(c, node, "spring-constant", WT_Q_SPRING_CONSTANT, &k, err);
    if (status == WT_OK)
        status =
            case_get_attribute_number(c, node, "sensitivity", WT_Q_SENSITIVITY, &sensitivity, err);
    if (status == WT_OK)
        status =
            case_get_attribute_number(c, node, "temperature", WT_Q_TEMPERATURE, &temperature, err);
    if (status != WT_OK)
        return status;
    if (k.value <= 0 || sensitivity <= 0) {
        wt_fail(err, WT_E_RANGE, "a calibration is not positive");
        return case_at(node, k.value <= 0 ? "spring-constant" : "sensitivity", WT_E_RANGE, err);
    }
    set->read.spring_constant = k.value;
    set->read.sensitivity = sensitivity;
    set->read.temperature = temperature;
    *spring_constant = k;
    return WT_OK;
}

static bool same(double a, double b)
{
    return !(a < b) && !(a > b) && !isnan(a) && !isnan(b);
}

wt_status case_read_files(wt_case *c, const xmlNode *parent, const char *name, case_files *files,
                          wt_error *err)
{
    size_t n = 0;
    for (const xmlNode *node = case_child(parent, name); node != NULL; node = case_next(node, name))
        n++;
    wt_file_set defaults = {.folder = c->folder, .read = wt_read_defaults()};
    wt_estimate common = {(double)NAN, 0, 0, "N/m"};
    wt_status status = read_attributes(c, parent, &defaults, &common, err);
    files->sets = case_alloc(c, n * sizeof *files->sets);
    const char **patterns = case_alloc(c, n * sizeof *patterns);
    if (status == WT_OK && (files->sets == NULL || patterns == NULL))
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    files->n = n;
    const xmlNode *node = case_child(parent, name);
    for (size_t i = 0; status == WT_OK && i < n; i++, node = case_next(node, name)) {
        wt_file_set *set = &files->sets[i];
        wt_estimate k = common;
        *set = defaults;
        status = read_attributes(c, node, set, &k, err);
        if (status == WT_OK)
            status = case_node_text(c, node, &patterns[i], err);
        set->patterns = &patterns[i];
        set->n_patterns = 1;
        /* one value for the group, or none if its files differ */
        if (i == 0)
            files->spring_constant = k;
        else if (!same(files->spring_constant.value, k.value))
            files->spring_constant.value = (double)NAN;
    }
    return status;
}
