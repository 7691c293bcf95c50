/* Checks a description as a whole. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/description/description.h"

#include <math.h>
#include <string.h>

static bool alias_is_unit(const text_description *d, const char *unit)
{
    double factor, offset;
    for (size_t i = 0; i < d->n_rules; i++)
        if (wt_unit_to_si(unit, d->rules[i].quantity, &factor, &offset, NULL) == WT_OK)
            return true;
    for (size_t i = 0; i < d->n_fields; i++)
        if (d->fields[i].quantity != WT_Q_NONE &&
            wt_unit_to_si(unit, d->fields[i].quantity, &factor, &offset, NULL) == WT_OK)
            return true;
    return false;
}

static wt_status fail_element(wt_error *err, const char *name, const char *element)
{
    wt_error_file(err, name);
    wt_error_place(err, "element %s", element);
    wt_error_advice(err, "see weartrack-format(5)");
    return WT_E_SCHEMA;
}

wt_status description_check_whole(const text_description *d, const char *name, wt_error *err)
{
    wt_quantity_set set = 0;
    for (size_t i = 0; i < d->n_rules; i++)
        set |= WT_Q_BIT(d->rules[i].quantity);
    if (d->matrix && (d->kinds != WT_KIND_IMAGE || d->n_rules != 1)) {
        wt_fail(err, WT_E_SCHEMA, "the rows of a matrix are lines of an image");
        wt_error_expected(err, "kinds=\"image\" and one column, that of the values");
        return fail_element(err, name, "table");
    }
    for (unsigned kind = 1; kind <= WT_KIND_RECORD && !d->matrix; kind *= 2)
        if ((d->kinds & kind) != 0 && !quantities_suffice(set, kind)) {
            wt_fail(err, WT_E_SCHEMA, "the columns do not make %s %s",
                    kind == WT_KIND_IMAGE ? "an" : "a", kind_name(kind));
            wt_error_expected(err, "%s", describe_required_columns(kind));
            return fail_element(err, name, "table");
        }
    for (size_t i = 0; i < d->n_aliases; i++)
        if (!alias_is_unit(d, d->aliases[i].means)) {
            wt_fail(err, WT_E_SCHEMA, "not a unit of any column");
            wt_error_expected(err, "a unit of one of the quantities");
            wt_error_found(err, "means=\"%s\"", d->aliases[i].means);
            return fail_element(err, name, "unit");
        }
    for (size_t i = 1; i < d->n_names; i++) {
        const column_name *a = &d->names[i - 1], *b = &d->names[i];
        if (strcmp(a->name, b->name) == 0 && a->rule == b->rule) {
            wt_fail(err, WT_E_SCHEMA, "a name stands twice in one column");
            wt_error_found(err, "\"%s\" (compared in lower case without blanks)", b->name);
            return fail_element(err, name, "column");
        }
    }
    if ((d->kinds & WT_KIND_SWEEP) == 0 && (d->group != NULL || d->n_samples > 0 ||
                                            d->n_repeating > 0 || !isnan(d->temperature_jump))) {
        wt_fail(err, WT_E_SCHEMA, "isotherms without a sweep");
        wt_error_expected(err, "kinds with sweep in it");
        return fail_element(err, name, "isotherms");
    }
    if (((d->kinds & WT_KIND_FORCE) == 0 &&
         (d->n_markers > 0 || d->n_values > 0 || d->turning_point)) ||
        ((d->kinds & (WT_KIND_FORCE | WT_KIND_RECORD)) == 0 && d->curve_column != NULL)) {
        wt_fail(err, WT_E_SCHEMA, "segments without a force curve");
        wt_error_expected(err, "kinds with force in it");
        return fail_element(err, name, "segments");
    }
    return WT_OK;
}
