/* Contributions to the error of measured over predicted friction, with remedies.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/validation.h"

#include "core/base/array.h"
#include "core/base/text.h"
#include "core/table/table_rows.h"
#include "record/numerics/agreement.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

TABLE_ROW(validation_sources, VALIDATION_SOURCES, validation_source source; const char *remedy;
          double error, share, needed_share;)

/* Sources of the random draws. Draws with the same source have one row. */
static const struct {
    flow_draw draw;
    validation_source source;
    const char *remedy;
} drawn[] = {
    {FLOW_DRAW_SHIFT_LAW, VALIDATION_SOURCE_SHIFT_LAW,
     "a DMA sweep at the temperature of the record"},
    {FLOW_DRAW_PRESSURE, VALIDATION_SOURCE_PRESSURE, "the load and the nominal area known better"},
    {FLOW_DRAW_TEMPERATURE, VALIDATION_SOURCE_TEMPERATURE, "the temperature in sliding measured"},
    {FLOW_DRAW_SHEAR_STRESS, VALIDATION_SOURCE_SHEAR_STRESS,
     "the shear stress measured on a smooth counter surface"},
    {FLOW_DRAW_DENSITY, VALIDATION_SOURCE_ROUGHNESS, "more scans of the counter surface"},
    {FLOW_DRAW_SOFT_STORAGE, VALIDATION_SOURCE_SOFTENING, "more strain sweeps"},
    {FLOW_DRAW_SOFT_LOSS, VALIDATION_SOURCE_SOFTENING, "more strain sweeps"},
    {FLOW_DRAW_THICKNESS, VALIDATION_SOURCE_THICKNESS, "the layer measured at more places"},
    {FLOW_DRAW_RATIO, VALIDATION_SOURCE_RATIO,
     "more spots indented, one cantilever for bulk and track"},
    {FLOW_DRAW_RATIO_SLOPE, VALIDATION_SOURCE_RATIO_SLOPE,
     "bulk and track indented at rates further apart"},
    {FLOW_DRAW_WEAR, VALIDATION_SOURCE_WEAR, "the track profiled or the sample weighed"},
    {FLOW_DRAW_CRITICAL_ENERGY, VALIDATION_SOURCE_CRITICAL_ENERGY,
     "the layer measured at more places"},
    {FLOW_DRAW_OBSERVED, VALIDATION_SOURCE_OBSERVED, "the layer measured at more places"},
};

static size_t find_drawn(flow_draw draw)
{
    size_t i = 0;
    while (i + 1 < COUNT_OF(drawn) && drawn[i].draw != draw)
        i++;
    return i;
}

typedef struct source {
    validation_source kind;
    const char *remedy;
    double variance, needed; /* variances of ln(measured/predicted) and of the required shear
                                stress */
} source;

typedef struct source_list {
    source of[VALIDATION_SOURCE_UNKNOWN];
    size_t n;
    double all, all_needed;
} source_list;

static source *find_source(source_list *list, validation_source kind, const char *remedy)
{
    for (size_t i = 0; i < list->n; i++)
        if (list->of[i].kind == kind)
            return &list->of[i];
    source *const s = &list->of[list->n++];
    *s = (source){.kind = kind, .remedy = remedy};
    return s;
}

/* ---- variance by source ---------------------------------------------------------------------- */

/* Returns the source of the variance that is not attributed to a single draw. */
static validation_source other_sources(const wt_sliding *sliding, bool split)
{
    if (!split)
        return VALIDATION_SOURCE_ALL_DRAWN;
    return sliding->surface->modes_error != NULL ? VALIDATION_SOURCE_MATERIAL_AND_SURFACE
                                                 : VALIDATION_SOURCE_MATERIAL;
}

static void add_other_sources(source_list *list, const wt_sliding *sliding, bool split,
                              const variance_components *parts, const variance_components *needed)
{
    const struct {
        validation_source kind;
        const char *remedy;
        double variance, needed;
    } rest[] = {{other_sources(sliding, split),
                 !split ? "more replicates, which separate the errors"
                 : sliding->surface->modes_error != NULL
                     ? "a second DMA run; more scans of the counter surface"
                     : "a second DMA run; temperatures known better",
                 parts->material, needed->material},
                {VALIDATION_SOURCE_RECORD, "longer records, or more of them", parts->record,
                 needed->record},
                {VALIDATION_SOURCE_SCATTER,
                 "more records at each velocity: the steps scatter by more than their errors",
                 parts->scatter, needed->scatter}};
    for (size_t i = 0; i < COUNT_OF(rest); i++)
        if (rest[i].variance > 0 || rest[i].needed > 0) {
            source *const s = find_source(list, rest[i].kind, rest[i].remedy);
            s->variance = rest[i].variance;
            s->needed = rest[i].needed;
        }
}

static void list_sources(const validation *v, bool split, const variance_components *parts,
                         const variance_components *needed, source_list *list)
{
    *list = (source_list){.all = parts->all, .all_needed = needed->all};
    for (size_t u = 0; split && u < v->p.n_lines; u++) {
        const size_t k = find_drawn(v->p.line[u]);
        source *const s = find_source(list, drawn[k].source, drawn[k].remedy);
        s->variance += parts->line[u];
        s->needed += needed->line[u];
    }
    add_other_sources(list, v->job->sliding, split, parts, needed);
}

/* ---- advice ---------------------------------------------------------------------------------- */

static int compare_variances(const void *a, const void *b)
{
    const source *x = a, *y = b;
    return (x->variance < y->variance) - (x->variance > y->variance);
}

/* Number of sources, the largest first, that must vanish until the interval no longer contains the
 * bound of the margin. Returns the number of sources + 1 if all of them do not suffice. */
static size_t count_required_sources(const validation *v, const model_variant *t,
                                     const source_list *list)
{
    const agreement *const fit = &t->fit;
    const size_t at = fit->deciding_step;
    const double off = fabs(fabs(fit->fitted_value[at]) - validation_margin(v)),
                 wanted = off / agreement_quantile(fit->df[at]);
    double left = list->all;
    size_t n = 0;
    while (n < list->n && sqrt(fmax(left, 0)) > wanted)
        left -= list->of[n++].variance;
    return sqrt(fmax(left, 0)) > wanted ? list->n + 1 : n;
}

/* Advice that names more sources at once is not useful. */
enum { MOST_NAMED = 2 };

static void write_advice(const validation *v, const model_variant *t, const source_list *list,
                         source_advice *advice)
{
    const source *const first = &list->of[0];
    const double share = first->variance / list->all;
    clocale_print(advice->narrows, sizeof advice->narrows, "%s: %.0f %% of the variance is the %s",
                  first->remedy, 100 * share, validation_source_text(first->kind));
    if (t->fit.verdict != AGREEMENT_INCONCLUSIVE)
        return;
    const size_t n = count_required_sources(v, t, list);
    char words[200] = "";
    for (size_t i = 0, used = 0; i < n && i < list->n && used < sizeof words; i++)
        used += (size_t)snprintf(words + used, sizeof words - used, "%s%s", i > 0 ? ", " : "",
                                 validation_source_text(list->of[i].kind));
    if (n > MOST_NAMED)
        clocale_print(advice->settles, sizeof advice->settles,
                      "hardly anything, because the ratio is near the end of the margin; the "
                      "largest gain is from %s",
                      first->remedy);
    else
        clocale_print(advice->settles, sizeof advice->settles, "%s known better%s%s", words,
                      n == 1 ? ": " : "", n == 1 ? first->remedy : "");
}

/* ---- table ----------------------------------------------------------------------------------- */

wt_status error_sources_tabulate(const validation *v, source_advice *advice, wt_table **table,
                                 wt_error *err)
{
    const model_variant *const t = v->has_shear ? &v->ratio[v->layered] : &v->shear;
    double *const row = wt_alloc(t->n, sizeof *row);
    source_list list;
    *advice = (source_advice){.narrows = ""};
    agreement_weights(&t->fit, t->fit.deciding_step, row);
    const variance_components parts = model_variant_components(t, row);
    agreement_weights(&v->shear.fit, 0, row);
    const variance_components needed = model_variant_components(&v->shear, row);
    free(row);
    const bool split = t->split || v->p.n_draws == 0; /* without draws there is nothing to
                                                         attribute */
    list_sources(v, split, &parts, &needed, &list);
    qsort(list.of, list.n, sizeof *list.of, compare_variances);
    write_advice(v, t, &list, advice);
    table_writer w = table_begin(&validation_sources_schema, err);
    for (size_t i = 0; i < list.n; i++) {
        const source *const s = &list.of[i];
        TABLE_ADD(validation_sources, &w, s->kind, s->remedy, sqrt(s->variance),
                  s->variance / list.all,
                  list.all_needed > 0 ? s->needed / list.all_needed : (double)NAN);
    }
    validation_sources_set_text(&w, VALIDATION_SOURCES_KEY_ADVICE, advice->narrows);
    return table_end(&w, table);
}
