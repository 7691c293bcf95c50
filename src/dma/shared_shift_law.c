/* The job of a shared shift law of several samples: its table and the verdict.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/inputs.h"
#include "weartrack/dma.h"

#include "core/base/clocale.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Significance level: the probability that samples of one law are reported as different. */
static const double level = 0.01;
/* Characters of the text of a sample in addition to its name. */
enum { MAX_SAMPLE_TEXT = 160 };

wt_shared_shift_law_job wt_shared_shift_law_job_defaults(void)
{
    return (wt_shared_shift_law_job){.reference = (double)NAN, .margin = 0.1};
}

static const wt_param rows[] = {
    {PARAM_CHOICE_OF("shared-shift-law", wt_shared_shift_law_job, common, "none|same|moved"),
     .former = "common-law", .flags = PARAM_NO_CASE,
     .help = "of several samples fit one law of the shift factors, too, and say whether they have "
             "one: same: the same constants at the same reference temperature; moved: the same "
             "constants, each sample at a reference temperature of its own, as rubbers of one kind "
             "whose glass transitions differ"},
    {PARAM("shared-shift-law-margin", wt_shared_shift_law_job, margin, WT_Q_NONE, ABOVE(0)),
     .former = "common-law-margin", .value = "X", .flags = PARAM_NO_CASE,
     .help = "decades of log a that do not matter: that samples have one law is said only if the "
             "intervals of what their own laws differ from it lie within them"},
};
PARAM_TABLE(wt_shared_shift_law_job_params, wt_shared_shift_law_job, rows,
            wt_shared_shift_law_job_defaults, NO_PARTS)

/* ---- the table ------------------------------------------------------------------------------- */

TABLE_ROW(shared_shift_law, SHARED_SHIFT_LAW, const char *sample, *note; wt_interval moved;
          wt_shared_law_point point;)

static void add_sample_rows(const wt_shared_shift_law_job *job, const wt_shared_shift_law *law,
                            size_t sample, table_writer *t)
{
    const double none = (double)NAN;
    const wt_interval unknown = {none, none, none, none};
    const wt_shared_law_member *m = &law->members[sample];
    const wt_interval moved = job->common == WT_SHARED_LAW_SHIFTED ? m->reference_offset : unknown;
    table_block(t);
    if (!m->used)
        TABLE_ADD(shared_shift_law, t, job->names[sample], m->reason, unknown,
                  {sample, none, none, none, unknown, unknown});
    for (size_t i = 0; i < law->n; i++)
        if (law->points[i].sample == sample)
            TABLE_ADD(shared_shift_law, t, job->names[sample], NULL, moved, law->points[i]);
}

/* ---- verdict and texts ----------------------------------------------------------------------- */

/* Returns the limit of a difference that is farthest from 0, or NaN if no difference is known. */
static double largest_difference(const wt_shared_shift_law *law, size_t *sample)
{
    double most = (double)NAN;
    for (size_t i = 0; i < law->n; i++) {
        const wt_interval *d = &law->points[i].difference;
        const double farthest = fmax(fabs(d->low), fabs(d->high));
        if (isfinite(d->low) && !(farthest <= most)) {
            most = farthest;
            *sample = law->points[i].sample;
        }
    }
    return most;
}

static void set_agreement_keys(const wt_shared_shift_law_job *job, const wt_shared_shift_law *law,
                               table_writer *t)
{
    size_t sample = 0;
    const double most = largest_difference(law, &sample);
    const char *const kind =
        job->common == WT_SHARED_LAW_SHIFTED ? ", moved along the temperature" : "";
    shared_shift_law_set_print(t, SHARED_SHIFT_LAW_KEY_MARGIN, "%g", job->margin);
    if (!isnan(most)) {
        shared_shift_law_set_value(t, SHARED_SHIFT_LAW_KEY_FURTHEST, most, (double)NAN,
                                   (double)NAN);
        shared_shift_law_set_print(t, SHARED_SHIFT_LAW_KEY_P, "%.3g", law->p);
    }
    if (isnan(most)) {
        shared_shift_law_set_text(t, SHARED_SHIFT_LAW_KEY_AGREE,
                                  "inconclusive: the isotherms do not tell a law of each sample");
        shared_shift_law_set_text(t, SHARED_SHIFT_LAW_KEY_SETTLED_BY,
                                  "more isotherms of each sample");
    } else if (most <= job->margin) {
        shared_shift_law_set_print(t, SHARED_SHIFT_LAW_KEY_AGREE,
                                   "yes: the laws of the samples are one%s within %.2g decade, the "
                                   "margin set (p %.2g)%s",
                                   kind, job->margin, law->p,
                                   law->p < level
                                       ? "; they differ by more than their errors, but not by "
                                         "more than that"
                                       : "");
    } else if (law->p < level) {
        shared_shift_law_set_print(
            t, SHARED_SHIFT_LAW_KEY_AGREE,
            "no: the samples have not one law%s (p %.2g); that of %s is off by up "
            "to %.2g decade",
            kind, law->p, job->names[sample], most);
    } else {
        shared_shift_law_set_print(
            t, SHARED_SHIFT_LAW_KEY_AGREE,
            "inconclusive: no difference is shown (p %.2g), but the law of %s may be "
            "off by %.2g decade",
            law->p, job->names[sample], most);
        shared_shift_law_set_print(
            t, SHARED_SHIFT_LAW_KEY_SETTLED_BY,
            "more isotherms of %s, or temperatures known better than +- %.2g K", job->names[sample],
            law->spread);
    }
}

/* Formats the law at a reference temperature in the syntax of --shift-law. */
static void format_shift_law_option(const wt_shared_shift_law *law, double reference, char *text,
                                    size_t size)
{
    if (law->kind == WT_LAW_WLF)
        clocale_print(text, size, "wlf:reference-temperature=%.6gdegC,c1=%.6g,c2=%.6gK",
                      reference - WT_ZERO_CELSIUS, law->c1.value, law->c2.value);
    else
        clocale_print(text, size, "arrhenius:activation-energy=%.6gkJ/mol",
                      law->activation_energy.value / 1000);
}

/* Returns the size of a text with an item for each sample. */
static size_t list_size(const wt_shared_shift_law_job *job)
{
    size_t size = 1;
    for (size_t i = 0; i < job->n; i++)
        size += strlen(job->names[i]) + MAX_SAMPLE_TEXT;
    return size;
}

static void set_sample_keys(const wt_shared_shift_law_job *job, const wt_shared_shift_law *law,
                            table_writer *t)
{
    char one[MAX_SAMPLE_TEXT];
    const bool each = job->common == WT_SHARED_LAW_SHIFTED;
    const size_t size = list_size(job);
    char *moved = wt_alloc(size, 1), *given = wt_alloc(size, 1), *without = wt_alloc(size, 1);
    for (size_t i = 0; i < law->n_members; i++) {
        const wt_shared_law_member *m = &law->members[i];
        if (!m->used) {
            clocale_append(without, size, "%s%s: %s", without[0] != '\0' ? ", " : "", job->names[i],
                           m->reason);
            continue;
        }
        const double reference = law->reference + m->reference_offset.value;
        clocale_append(moved, size, "%s%s %.2f °C", moved[0] != '\0' ? ", " : "", job->names[i],
                       reference - WT_ZERO_CELSIUS);
        if (m->reference_offset.standard_error > 0)
            clocale_append(moved, size, " ± %.2g K", m->reference_offset.standard_error);
        format_shift_law_option(law, reference, one, sizeof one);
        if (each || given[0] == '\0')
            clocale_append(given, size, "%s%s%s%s", given[0] != '\0' ? "; " : "",
                           each ? job->names[i] : "", each ? " " : "", one);
    }
    shared_shift_law_set_text(t, SHARED_SHIFT_LAW_KEY_MOVED, moved);
    shared_shift_law_set_text(t, SHARED_SHIFT_LAW_KEY_SHIFT_LAW, given);
    if (without[0] != '\0')
        shared_shift_law_set_text(t, SHARED_SHIFT_LAW_KEY_LEFT_OUT, without);
    free(moved);
    free(given);
    free(without);
}

static void set_constant_keys(const wt_shared_shift_law *law, table_writer *t)
{
    const bool wlf = law->kind == WT_LAW_WLF;
    shared_shift_law_set_text(t, SHARED_SHIFT_LAW_KEY_LAW, wlf ? "WLF" : "Arrhenius");
    shared_shift_law_set_value(t, SHARED_SHIFT_LAW_KEY_REFERENCE_TEMPERATURE, law->reference, 0, 0);
    if (wlf) {
        shared_shift_law_set_value(t, SHARED_SHIFT_LAW_KEY_WLF_C1, law->c1.value,
                                   law->c1.standard_error, 0);
        shared_shift_law_set_value(t, SHARED_SHIFT_LAW_KEY_WLF_C2, law->c2.value,
                                   law->c2.standard_error, 0);
        shared_shift_law_set_print(t, SHARED_SHIFT_LAW_KEY_WLF_CORRELATION, "%.6g",
                                   law->c_correlation);
    } else {
        shared_shift_law_set_value(t, SHARED_SHIFT_LAW_KEY_ACTIVATION_ENERGY,
                                   law->activation_energy.value,
                                   law->activation_energy.standard_error, 0);
    }
    shared_shift_law_set_value(t, SHARED_SHIFT_LAW_KEY_TEMPERATURE_SPREAD, law->spread, (double)NAN,
                               0);
}

wt_status wt_shared_shift_law_compute(const wt_shared_shift_law_job *job, wt_table **table,
                                      wt_error *err)
{
    if (job == NULL || table == NULL || job->names == NULL)
        return wt_fail(err, WT_E_ARG, "no samples for a shared shift law");
    wt_shared_shift_law law = {0};
    wt_status status = param_check(wt_shared_shift_law_job_params(), job, err);
    if (status == WT_OK)
        status = wt_shared_shift_law_fit(job->fits, job->n, job->common, job->reference, &law, err);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&shared_shift_law_schema, err);
    for (size_t i = 0; i < job->n; i++)
        add_sample_rows(job, &law, i, &t);
    set_agreement_keys(job, &law, &t);
    set_constant_keys(&law, &t);
    set_sample_keys(job, &law, &t);
    wt_shared_shift_law_clear(&law);
    return table_end(&t, table);
}
