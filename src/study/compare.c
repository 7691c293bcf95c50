/* Comparison job: groups, their indentation rates, the modulus against the rate, and moduli of
 * curves against the DMA modulus at the equivalent frequency.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/compare.h"
#include "core/base/param.h"
#include "core/base/shared_params.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "dma/rubber.h"
#include "indentation/calibration_errors.h"
#include "job/inputs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Material at a temperature, with a statement on it. NULL if no shift law reaches it. */
static wt_status material_at(const wt_rubber *rubber, double temperature, const wt_job *work,
                             wt_material **material, char statement[256], wt_error *err)
{
    wt_error why = WT_ERROR_INIT;
    if (flow_rubber_can_shift(rubber, temperature, &why))
        return wt_rubber_material(rubber, temperature, work->seed, WT_NO_REPLICATE, material,
                                  statement, err);
    clocale_print(statement, 256, "none at %.2f °C: %s", temperature - WT_ZERO_CELSIUS,
                  why.message);
    return WT_OK;
}

/* ---- groups ---------------------------------------------------------------------------------- */

TABLE_ROW(modulus_groups, MODULUS_GROUPS, const char *group; wt_group data;
          wt_group_summary summary; wt_interval modulus;)

static wt_interval summary_interval(const wt_group_summary *s)
{
    return (wt_interval){s->geometric_mean, (double)NAN, s->low, s->high};
}

static void group_row(table_writer *t, const char *name, const wt_group_data *d)
{
    const double none = (double)NAN;
    wt_group_summary s = {0, 0, 0, none, none, none, none, none, none, none, none};
    if (d->group.n > 0 && t->status == WT_OK)
        t->status = modulus_budget_interval(d, &s, t->err);
    TABLE_ADD(modulus_groups, t, name, d->group, s, summary_interval(&s));
}

/* Returns the group name of an indentation table. */
static const char *group_name(const wt_table *indentation)
{
    const char *name = wt_table_name(indentation);
    const size_t prefix = strlen(indentation_schema.name);
    return strncmp(name, indentation_schema.name, prefix) == 0 ? name + prefix : name;
}

wt_status wt_modulus_groups_table(const wt_table *const *indentation, size_t n, wt_table **result,
                                  wt_error *err)
{
    if (result == NULL || (n > 0 && indentation == NULL))
        return wt_fail(err, WT_E_ARG, "no indentation tables");
    table_writer t = table_begin(&modulus_groups_schema, err);
    for (size_t i = 0; i < n; i++) {
        wt_group_data data = {0};
        if (t.status == WT_OK)
            t.status = wt_group_from_table(indentation[i], false, &data, err);
        group_row(&t, group_name(indentation[i]), &data);
        wt_group_data_clear(&data);
    }
    return table_end(&t, result);
}

wt_status wt_modulus_budget_table(const wt_table *const *indentation, size_t n, wt_table **table,
                                  wt_error *err)
{
    if (table == NULL || (n > 0 && indentation == NULL))
        return wt_fail(err, WT_E_ARG, "no indentation tables");
    wt_status status = WT_OK;
    wt_group_data *groups = wt_alloc(n, sizeof *groups);
    const char **names = wt_alloc(n, sizeof *names);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        names[i] = group_name(indentation[i]);
        status = wt_group_from_table(indentation[i], false, &groups[i], err);
    }
    if (status == WT_OK)
        status = modulus_budget_create(groups, names, n, table, err);
    for (size_t i = 0; i < n; i++)
        wt_group_data_clear(&groups[i]);
    free(groups);
    free(names);
    return status;
}

/* The groups are named bulk and track, whatever the names of their tables. */
static wt_status make_groups_table(const compare_pair *p, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&modulus_groups_schema, err);
    for (int g = 0; g < 2; g++)
        if (p->present[g])
            group_row(&t, compare_group_name[g], &p->data[g]);
    return table_end(&t, table);
}

/* ---- comparison by rate and with DMA --------------------------------------------------------- */

static wt_status rate_point_mean(compare_pair *p, int g, size_t bin, rate_point *point,
                                 wt_error *err)
{
    wt_group part = compare_select_curves(p, g, bin, 0, false);
    double log_rate = 0, log_frequency = 0;
    point->n = part.n;
    if (part.n == 0)
        return WT_OK;
    for (size_t i = 0; i < p->data[g].group.n; i++) {
        if (p->bin[g][i] != bin)
            continue;
        log_rate += log(p->data[g].indentation_rate[i]);
        log_frequency += log(p->data[g].equivalent_frequency[i]);
    }
    point->rate = exp(log_rate / (double)part.n);
    point->frequency = exp(log_frequency / (double)part.n);
    return wt_group_summarise(&part, &point->summary, err);
}

static wt_status find_rate_points(compare_pair *p, wt_error *err)
{
    wt_status status = WT_OK;
    for (int g = 0; status == WT_OK && g < 2; g++) {
        p->point[g] = arena_alloc(&p->memory, p->n_bins, sizeof *p->point[g]);
        for (size_t b = 0; status == WT_OK && b < p->n_bins; b++)
            status = rate_point_mean(p, g, b, &p->point[g][b], err);
    }
    return status;
}

TABLE_ROW(modulus_rate, MODULUS_RATE, const char *group; rate_point point; wt_interval modulus;)

TABLE_ROW(dma_comparison, DMA_COMPARISON, const char *group;
          double frequency, storage, ratio, extrapolated; wt_interval modulus; wt_estimate dma;)

/* error: relative, of |E*|. material: NULL if the DMA does not reach the temperature. */
static void dma_row(table_writer *t, int g, const rate_point *point, const wt_material *material,
                    double error)
{
    const double none = (double)NAN, frequency = point->frequency;
    double loss = none;
    dma_comparison_row row = {
        compare_group_name[g],   frequency, none, none, none, summary_interval(&point->summary),
        {none, none, none, NULL}};
    if (frequency > 0 && material != NULL) {
        material->law->modulus(material, &frequency, 1, &row.storage, &loss);
        row.dma.value = hypot(row.storage, loss);
        row.dma.standard_error = error * row.dma.value;
        row.ratio = row.modulus.value / row.dma.value;
        row.extrapolated =
            frequency < material->frequency_min || frequency > material->frequency_max;
    }
    dma_comparison_add_row(t, &row);
}

/* Each group is a block. */
static wt_status make_rate_table(const compare_pair *p, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&modulus_rate_schema, err);
    for (int g = 0; g < 2; g++) {
        table_block(&t);
        for (size_t b = 0; b < p->n_bins; b++)
            if (p->point[g][b].n > 0)
                TABLE_ADD(modulus_rate, &t, compare_group_name[g], p->point[g][b],
                          summary_interval(&p->point[g][b].summary));
    }
    return table_end(&t, table);
}

/* Adds the rows of a group at its temperature. */
static wt_status dma_rows(table_writer *t, const compare_pair *p, int g, const wt_rubber *rubber,
                          wt_estimate given, const wt_job *work, char statement[256], bool *lacks,
                          wt_error *err)
{
    wt_material *material = NULL;
    wt_status status = material_at(rubber, given.value, work, &material, statement, err);
    for (size_t b = 0; status == WT_OK && b < p->n_bins; b++) {
        const rate_point *point = &p->point[g][b];
        const material_state at = {given.value, point->frequency};
        wt_estimate modulus = {0};
        double by_temperature = 0;
        if (point->n == 0)
            continue;
        if (point->frequency > 0 && material != NULL) {
            status = compare_material(rubber, &at, 1, work, &modulus, err);
            if (status == WT_OK)
                status = compare_temperature_error(rubber, at, given.standard_error, work,
                                                   &by_temperature, err);
        }
        *lacks = *lacks || isnan(by_temperature);
        dma_row(t, g, point, material, hypot(modulus.standard_error, by_temperature));
    }
    wt_material_free(material);
    return status;
}

TABLE_KEYS(dma_comparison, DMA_COMPARISON, wt_estimate temperature, track_temperature;
           const char *ratio_of, *lacks, *statement;)

/* Each group with a separate temperature is a block. */
static wt_status make_dma_table(const compare_pair *p, const wt_compare_job *job,
                                const wt_job *work, wt_table **table, wt_error *err)
{
    char statement[2][256] = {"", ""};
    const wt_estimate given[2] = {compare_temperature(job, 0), compare_temperature(job, 1)};
    const bool apart = given[1].value != given[0].value;
    bool lacks = false;
    table_writer t = table_begin(&dma_comparison_schema, err);
    for (int g = 0; t.status == WT_OK && g < 2; g++) {
        if (apart)
            table_block(&t);
        t.status = dma_rows(&t, p, g, job->rubber, given[g], work, statement[g], &lacks, err);
    }
    char both[512];
    const bool differ = statement[0][0] != '\0' && !wt_text_repeats(statement[1], statement[0]);
    clocale_print(both, sizeof both, "%s%s%s", statement[0],
                  differ && statement[1][0] != '\0' ? "; " : "",
                  differ || statement[0][0] == '\0' ? statement[1] : "");
    const bool no_draws = job->rubber->n_draws == 0, own = !isnan(job->track_temperature.value);
    TABLE_SET(dma_comparison, &t, given[0], own ? given[1] : job->track_temperature,
              "indentation modulus over |E*| of the DMA",
              no_draws || lacks ? compare_missing_errors(no_draws, lacks) : NULL, both);
    return table_end(&t, table);
}

wt_compare_job wt_compare_job_defaults(void)
{
    const wt_estimate unset = {(double)NAN, (double)NAN, 0, "K"};
    return (wt_compare_job){.temperature = unset,
                            .track_temperature = unset,
                            .temperature_slope = {(double)NAN, (double)NAN, 0, "1/K"},
                            .margin = 0.2,
                            .expected_thickness = {(double)NAN, (double)NAN, 0, "m"},
                            .rates = true};
}

static const wt_param rows[] = {
    {PARAM("indentation-temperature", wt_compare_job, temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .unset = "that of indent, or the reference temperature of the DMA",
     .help = SUCH_AS("at which the sample was indented, ", "\"23degC +- 1K\"",
                     "; for the comparison with DMA")},
    {PARAM("track-temperature", wt_compare_job, track_temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .unset = "that of indent, or of the bulk",
     .help = "at which the track was indented, if it was not that of the bulk"},
    {PARAM("temperature-slope", wt_compare_job, temperature_slope, WT_Q_NONE, ANY_NUMBER),
     .value = "X", .unset = "that of the DMA",
     .help = SUCH_AS("of ln E against temperature per kelvin, ", "\"-0.012 +- 0.002\"",
                     "; brings the track to the temperature of the bulk")},
    {PARAM_CHOICE_OF("cantilevers", wt_compare_job, cantilevers, "auto|one|two"),
     .help = "whether bulk and track were indented with one cantilever, whose errors cancel in the "
             "ratio, or with two, whose errors enter it; auto: one if spring constants and "
             "tips are equal"},
    {PARAM("spring-constant-error", wt_compare_job, lever_error, WT_Q_NONE, FROM_BELOW(0, 1)),
     .value = "X",
     .help = SUCH_AS("relative standard error of a spring constant whose curves state none, ",
                     "0.1", "")},
    {PARAM("sensitivity-error", wt_compare_job, sensitivity_error, WT_Q_NONE, FROM_BELOW(0, 1)),
     .value = "X",
     .help = SUCH_AS("relative standard error of a deflection sensitivity, ", "0.05", "")},
    {PARAM("tip-error", wt_compare_job, tip_error, WT_Q_NONE, FROM_BELOW(0, 1)), .value = "X",
     .help = "relative standard error of a modulus by the shape of its tip"},
    {PARAM_FLAG_OF("map-spots", wt_compare_job, map_spots),
     .help = "each place of a map is a spot of its own; else a map whose spots are not named is "
             "one, for its places are near to each other"},
    {PARAM("between-spot-sd", wt_compare_job, spot_scatter, WT_Q_NONE, FROM_BELOW(0, 1)),
     .former = "spot-scatter", .value = "X", .unset = "not known",
     .help = SUCH_AS("relative standard deviation of the modulus from spot to spot, as known of "
                     "other samples, ",
                     "15%", "; for one spot against one or two, which do not determine it")},
    {PARAM("expected-thickness", wt_compare_job, expected_thickness, WT_Q_LENGTH, ABOVE(0)),
     .value = "D", .unset = "that of the theory, where the case has a layer",
     .help = SUCH_AS("thickness of the layer known otherwise, ", "\"3um +- 20%\"",
                     " of a section, for the comparison with what the curves allow")},
    EQUIVALENCE_MARGIN(wt_compare_job),
};
PARAM_TABLE(wt_compare_job_params, wt_compare_job, rows, wt_compare_job_defaults, NO_PARTS)

/* Takes the temperatures that both groups state. A temperature of the job is that of both; one that
 * a single group states says nothing of the other. */
static void add_group_temperatures(const compare_pair *p, const wt_job *work, wt_compare_job *job)
{
    const wt_estimate bulk = p->data[0].temperature, track = p->data[1].temperature;
    if (!p->present[0] || !p->present[1] || !isnan(job->temperature.value))
        return;
    if (isnan(bulk.value) != isnan(track.value)) {
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "only the curves of the %s state the temperature of indentation, so it is not "
                   "used; give --indentation-temperature, and --track-temperature if the track "
                   "differs",
                   compare_group_name[isnan(bulk.value)]);
        return;
    }
    job->temperature = bulk;
    if (isnan(job->track_temperature.value) && track.value != bulk.value)
        job->track_temperature = track;
}

wt_status wt_compare_groups(const wt_compare_job *job, const wt_job *work,
                            wt_compare_tables *tables, wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL || (job->bulk == NULL && job->track == NULL))
        return wt_fail(err, WT_E_ARG, "nothing to compare");
    compare_pair p = {0};
    wt_compare_tables t = {0};
    wt_compare_job with_temperatures = *job;
    wt_status status = param_check(wt_compare_job_params(), job, err);
    if (status == WT_OK)
        status = compare_read_groups(job, &p, err);
    if (status == WT_OK)
        add_group_temperatures(&p, work, &with_temperatures);
    job = &with_temperatures;
    if (status == WT_OK)
        status = make_groups_table(&p, &t.modulus_groups, err);
    if (status == WT_OK)
        status = modulus_budget_create(p.data, compare_group_name, 2, &t.modulus_budget, err);
    if (status == WT_OK && p.present[0] && p.present[1] && !job->groups_only)
        status = compare_tabulate(&p, job, work, &t.comparison, err);
    if (job->rates && p.n_bins > 0) {
        if (status == WT_OK)
            status = find_rate_points(&p, err);
        if (status == WT_OK)
            status = make_rate_table(&p, &t.modulus_rate, err);
        if (status == WT_OK && job->rubber != NULL)
            status = make_dma_table(&p, job, work, &t.dma_comparison, err);
    }
    if (status == WT_OK) {
        *tables = t;
        t = (wt_compare_tables){0};
    }
    wt_tables_clear(&t, sizeof t);
    compare_pair_clear(&p);
    return status;
}
