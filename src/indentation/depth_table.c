/* Table of the modulus against depth, with text on the change and on its possible causes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/clocale.h"
#include "core/base/number.h"
#include "core/table/table_rows.h"
#include "indentation/curve_tables.h"

#include <math.h>

TABLE_ROW(modulus_depth, MODULUS_DEPTH, const char *group; double depth; wt_interval modulus;
          size_t n, n_units;)

TABLE_KEYS(modulus_depth, MODULUS_DEPTH, const char *changes, *reading; wt_interval ratio;
           double chance, misfit_p;)

typedef struct depth_text {
    char text[48];
} depth_text;

static depth_text format_si_value(double value, const char *unit)
{
    depth_text w;
    wt_format_si(value, unit, 3, w.text, sizeof w.text);
    return w;
}

/* Returns advice on how to decide. The flag states that the residual is not a change with depth. */
static const char *depth_advice(const wt_modulus_profile *d, bool other_misfit)
{
    if (d->loss_share > 0.5 || (other_misfit && d->loss_share > 0))
        return "the DMA of the rubber would tell";
    if (d->curvature_share > 0.5 || (other_misfit && d->curvature_share > 0))
        return "the baselines are bent: a straight piezo, or one that has settled, would tell";
    return other_misfit ? "another tip or rate would tell" : "more curves would tell";
}

static void describe_depth_change(const wt_modulus_profile *d, char text[320])
{
    const depth_text shallow = format_si_value(d->depth[0], "m"),
                     deep = format_si_value(d->depth[WT_DEPTHS - 1], "m");
    const double margin = 100 * WT_DEPTH_MARGIN;
    const bool is_small = fabs(log(d->change.low)) < log1p(WT_DEPTH_MARGIN) &&
                          fabs(log(d->change.high)) < log1p(WT_DEPTH_MARGIN);
    char range[96];
    clocale_print(range, sizeof range, "%.3f, 95 %% interval %.3f to %.3f", d->change.value,
                  d->change.low, d->change.high);
    if (d->n_excluded_by_loss > 0 && d->n_excluded_by_loss >= d->n)
        clocale_print(
            text, 320,
            "inconclusive: %zu of %zu curves lose work on the way out, and what that does "
            "to their moduli is not known; the DMA of the rubber would tell",
            d->n_excluded_by_loss, d->n + d->n_excluded_by_loss);
    else if (isnan(d->change.value))
        clocale_print(text, 320,
                      "inconclusive: %zu curves without adhesion do not tell, 12 are "
                      "needed that differ by noise alone",
                      d->n);
    else if (d->verdict == WT_DEPTH_OTHER_RESIDUAL)
        clocale_print(
            text, 320,
            "inconclusive: the curves have a residual in common that no modulus that changes "
            "with depth leaves (chance %s); %s",
            format_probability(d->misfit_p).text, depth_advice(d, true));
    else if (d->verdict == WT_DEPTH_CHANGES && d->change.low < 1 && d->change.high > 1)
        clocale_print(text, 320,
                      "yes: between %s and %s the modulus changes, by how much and which way the "
                      "curves do not tell (factor %s)",
                      shallow.text, deep.text, range);
    else if (d->verdict == WT_DEPTH_CHANGES)
        clocale_print(text, 320,
                      "yes%s: at %s the modulus is another than at %s, by a factor of %s",
                      is_small ? ", but hardly" : "", deep.text, shallow.text, range);
    else if (d->verdict == WT_DEPTH_SAME)
        clocale_print(text, 320,
                      "no: between %s and %s the modulus changes by less than %g %% (factor %s)",
                      shallow.text, deep.text, margin, range);
    else
        clocale_print(
            text, 320,
            "inconclusive: between %s and %s the modulus may be the same or change by more "
            "than %g %% (factor %s); %s",
            shallow.text, deep.text, margin, range, depth_advice(d, false));
}

/* Describes the layer that would cause such a change, and other possible causes. */
static void describe_layer_reading(const wt_modulus_profile *d, char text[640])
{
    char numbers[256] = "";
    if (!isnan(d->thickness.value))
        clocale_print(numbers, sizeof numbers,
                      "; one of %s (%s to %s) with %s on %s would look like that",
                      format_si_value(d->thickness.value, "m").text,
                      format_si_value(d->thickness.low, "m").text,
                      format_si_value(d->thickness.high, "m").text,
                      format_si_value(d->layer_modulus.value, "Pa").text,
                      format_si_value(d->substrate_modulus.value, "Pa").text);
    clocale_print(text, 640,
                  "if a layer thinner than the indentation makes it, the layer is %s than what is "
                  "below; then shallow indentations tell the layer, deep ones what is below, and "
                  "the modulus of a whole curve is that of neither%s; another radius of the tip, "
                  "loss, adhesion and an uneven piezo do the same, which a second rate, a second "
                  "tip or the untouched bulk tells apart",
                  d->change.low > 1    ? "softer"
                  : d->change.high < 1 ? "stiffer"
                                       : "softer or stiffer",
                  numbers);
}

wt_status flow_depth_table_add(wt_indent_tables *tables, const char *group,
                               const wt_modulus_profile *d, wt_error *err)
{
    table_writer t = {0};
    char text[320], reading[640];
    if (tables->modulus_depth == NULL) {
        t = table_begin(&modulus_depth_schema, err);
        if (table_end(&t, &tables->modulus_depth) != WT_OK)
            return t.status;
    }
    t = table_continue(tables->modulus_depth, &modulus_depth_schema, group, err);
    table_block(&t);
    describe_depth_change(d, text);
    modulus_depth_keys keys = {text, NULL, d->change, (double)NAN, (double)NAN};
    if (d->verdict == WT_DEPTH_CHANGES) {
        describe_layer_reading(d, reading);
        keys.reading = reading;
    }
    if (!isnan(d->change.value)) {
        keys.chance = d->change_p;
        keys.misfit_p = d->misfit_p;
    }
    modulus_depth_set_keys(&t, &keys);
    for (size_t i = 0; i < WT_DEPTHS && !isnan(d->change.value); i++)
        TABLE_ADD(modulus_depth, &t, group, d->depth[i], d->modulus[i], d->n, d->n_units);
    return table_end(&t, NULL);
}
