/* The DMA job: reads the sweeps, fits one spectrum to them and creates the rubber.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/master.h"

#include "core/base/param.h"
#include "core/table/table_rows.h"
#include "dma/law/material.h"
#include "dma/sweep_input.h"
#include "job/cost.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

wt_master_job wt_master_job_defaults(void)
{
    return (wt_master_job){.fit = wt_master_options_defaults(),
                           .poisson_ratio = 0.5,
                           .reduction = wt_reduction_defaults()};
}

static wt_status check_shift_law(const void *member, wt_error *err)
{
    wt_shift_law law;
    return flow_parse_shift_law(*(const char *const *)member, &law, err);
}

static wt_status check_exclusions(const void *member, wt_error *err)
{
    const char *at = member;
    const wt_master_job *job = (const void *)(at - offsetof(wt_master_job, leave_out));
    return flow_exclusions_check(job->leave_out, job->n_leave_out, err);
}

static wt_status check_hand_shifts(const void *member, wt_error *err)
{
    const char *at = member;
    const wt_master_job *job = (const void *)(at - offsetof(wt_master_job, hand_shifts));
    return flow_hand_shifts_check(job->hand_shifts, job->n_hand_shifts, err);
}

static const wt_param rows[] = {
    POISSON_RATIO(wt_master_job),
    {PARAM_TEXTS_OF("exclude", wt_master_job, leave_out, n_leave_out), .former = "leave-out",
     .value = "WHAT", .unset = "",
     .help = "leave out isotherms and points of the DMA: temperature:LOW..HIGH or "
             "frequency:LOW..HIGH, such as temperature:..-20degC, or one value, such as "
             "frequency:50Hz; of relaxation and creep time:LOW..HIGH; repeatable",
     .check = check_exclusions},
    {PARAM_TEXT_OF("shift-law", wt_master_job, shift_law), .value = "LAW", .unset = "fitted",
     .help = "law that gives all horizontal shifts of the DMA: "
             "wlf:reference-temperature=20degC,c1=8.86,c2=101.6K or "
             "arrhenius:activation-energy=80kJ/mol; no interval contains its errors",
     .check = check_shift_law},
    {PARAM_TEXTS_OF("shift", wt_master_job, hand_shifts, n_hand_shifts), .value = "T=LOG_AT",
     .unset = "fitted",
     .help = "log10 aT of one isotherm of the DMA by hand, against the isotherm nearest to the "
             "reference temperature, such as 25degC=-1.2; it has no error, and the others are "
             "fitted; repeatable",
     .check = check_hand_shifts},
};
PARAM_TABLE(wt_master_job_params, wt_master_job, rows, wt_master_job_defaults,
            PARAM_PART(wt_master_options_params, wt_master_job, fit))

void wt_master_tables_clear(wt_master_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->shift_factors);
    wt_table_free(tables->master_curve);
    wt_table_free(tables->prony);
    wt_table_free(tables->prony_reduced);
    wt_table_free(tables->relaxation_spectrum);
    wt_table_free(tables->influences);
    wt_table_free(tables->material_draws);
    wt_table_free(tables->series_draws);
    wt_master_clear(tables->fit);
    free(tables->fit);
    *tables = (wt_master_tables){0};
}

/* ---- the job --------------------------------------------------------------------------------- */

/* Strain sweeps contain no information about the spectrum. The function warns if they are
 * skipped and fails if there is no other data. */
static wt_status check_strain_sweeps(const wt_sweep *sweep, const wt_job *work, wt_error *err)
{
    const size_t n = sweep->n_strain_sweeps;
    if (n > 0 && sweep->n_isotherms + sweep->n_ramps > 0)
        wt_log_action(work->log, WT_WARNING, WT_LEFT_OUT, n, "weartrack payne",
                      sweep->strain_sweeps[0].source, NULL,
                      "%zu strain sweep%s left out of the master curve: see `weartrack payne`", n,
                      n > 1 ? "s are" : " is");
    if (n == 0 || sweep->n_isotherms + sweep->n_ramps > 0)
        return WT_OK;
    wt_fail(err, WT_E_EMPTY, "a master curve needs isotherms");
    wt_error_found(err, "strain sweeps: %zu", n);
    wt_error_advice(err, "`weartrack payne FILE` reports how the rubber softens with strain");
    return WT_E_EMPTY;
}

/* Removes the excluded data from the sweeps and sets the stated shifts. */
static wt_status prepare_sweep(const wt_master_job *job, const wt_job *work, wt_shift_law *law,
                               wt_sweep *sweep, wt_error *err)
{
    wt_status status = flow_sweep_exclude(job->leave_out, job->n_leave_out, sweep, work->log, err);
    if (status == WT_OK)
        status = flow_parse_shift_law(job->shift_law, law, err);
    if (status == WT_OK && law->kind != WT_LAW_NONE && job->shifts != NULL)
        status = wt_fail(err, WT_E_ARG, "shifts are given by a law and by a table; give one");
    if (status == WT_OK) {
        status = flow_set_stated_shifts(law, job->shifts, job->fit.vertical, sweep, work->log, err);
        if (status != WT_OK && job->shifts != NULL)
            wt_error_file(err, job->shifts_file);
    }
    if (status == WT_OK && job->n_hand_shifts > 0 &&
        job->fit.reference_at == WT_REFERENCE_TAN_DELTA_PEAK) {
        status = wt_fail(err, WT_E_ARG,
                         "shifts by hand need a reference temperature that is known "
                         "before the fit");
        wt_error_advice(err, "give --reference-temperature in place of --reference-at");
        wt_error_options(err, "reference-temperature reference-at");
    }
    if (status == WT_OK)
        status = flow_set_hand_shifts(job->hand_shifts, job->n_hand_shifts, sweep, work->log, err);
    if (status == WT_OK && law->kind != WT_LAW_NONE)
        wt_log_add(work->log, WT_NOTE, NULL, NULL,
                   "the shifts are those of the law that is given: no interval contains its "
                   "errors");
    return status;
}

static bool needs_master_curve(const wt_job *work)
{
    return (work->left_out & WT_EXTRA_MASTER_CURVE) == 0;
}

static wt_master_options fit_options(const wt_master_job *job, const wt_job *work)
{
    wt_master_options options = job->fit;
    options.skip_fitted_moduli = options.skip_fitted_moduli || !needs_master_curve(work);
    options.keep_isotherms =
        job->n_sets > 0 && job->sets[0].read.conditioning == WT_CONDITIONING_KEEP;
    return options;
}

/* Fits the sweeps. Temperature sweeps are converted to isotherms of `sweep`. */
static wt_status fit_master_curve(const wt_master_job *job, const wt_job *work, wt_sweep *sweep,
                                  wt_master *master, wt_error *err)
{
    wt_shift_law law;
    const wt_master_options options = fit_options(job, work);
    wt_status status = prepare_sweep(job, work, &law, sweep, err);
    if (status != WT_OK)
        return status;
    status = sweep->n_ramps > 0 ? flow_ramps_fit(sweep, &options, &law, work->log, master, err)
                                : wt_master_fit(sweep, &options, work->log, master, err);
    if (status == WT_OK)
        return WT_OK;
    /* the fit does not know the files, so the error gets them here */
    const size_t n = sweep->n_isotherms;
    if (job->n_sets > 0 && job->sets[0].n_patterns > 0)
        wt_error_file(err, job->sets[0].patterns[0]);
    if (err != NULL && err->place[0] == '\0' && n > 0)
        wt_error_place(err, "%zu isotherm%s from %s", n, n == 1 ? "" : "s",
                       sweep->isotherms[0].source);
    return status;
}

/* Returns true if the data determine the level of the moduli. Without it there is no series. */
static bool has_modulus_level(const wt_master *m)
{
    const wt_shift_quantity by = wt_master_shift_quantity(m);
    return by == WT_SHIFT_MODULI || by == WT_SHIFT_STORAGE;
}

static wt_status fail_no_modulus_level(const wt_master *m, wt_error *err)
{
    wt_fail(err, WT_E_MISSING,
            "the %s alone does not determine the level of the moduli, which "
            "friction needs",
            wt_master_shift_quantity(m) == WT_SHIFT_LOSS ? "loss modulus" : "loss factor");
    wt_error_expected(err, "isotherms with storage and loss modulus");
    return WT_E_MISSING;
}

/* Returns the sample name if all sweeps have the same one, otherwise NULL. */
static const char *common_sample_name(const wt_sweep *sweep)
{
    const char *name = sweep->n_isotherms > 0 ? sweep->isotherms[0].sample
                       : sweep->n_ramps > 0   ? sweep->ramps[0].sample
                                              : NULL;
    bool same = name != NULL;
    for (size_t i = 0; i < sweep->n_isotherms && same; i++)
        same = sweep->isotherms[i].sample != NULL && strcmp(sweep->isotherms[i].sample, name) == 0;
    for (size_t i = 0; i < sweep->n_ramps && same; i++)
        same = sweep->ramps[i].sample != NULL && strcmp(sweep->ramps[i].sample, name) == 0;
    return same ? name : NULL;
}

static wt_status store_sample_name(const wt_sweep *sweep, wt_table *shift_factors, wt_error *err)
{
    const char *const sample = common_sample_name(sweep);
    if (sample == NULL)
        return WT_OK;
    table_writer t = table_continue(shift_factors, &shift_factors_schema, "", err);
    shift_factors_set_text(&t, SHIFT_FACTORS_KEY_SAMPLE, sample);
    return table_end(&t, NULL);
}

/* Builds all tables except the master curve. */
static wt_status build_fit_tables(const wt_master *m, size_t n_draws, const wt_job *work,
                                  wt_master_tables *t, wt_error *err)
{
    t->n_isotherms = m->n_shifts;
    wt_status status = flow_shift_table(m, &t->shift_factors, err);
    if (status != WT_OK || !has_modulus_level(m))
        return status;
    if (status == WT_OK)
        status = flow_prony_table(m, &t->prony, err);
    return status == WT_OK && (work->left_out & WT_EXTRA_DRAWS) == 0
               ? flow_draw_tables(m, n_draws, t, err)
               : status;
}

wt_status flow_rubber_fit(const wt_sweep *sweep, const wt_master_options *options,
                          double poisson_ratio, size_t n_draws, const wt_job *work, wt_master *fit,
                          wt_rubber *rubber, wt_error *err)
{
    wt_master_tables t = {0};
    wt_master_options own = *options;
    own.series_only = true;
    wt_status status = wt_master_fit(sweep, &own, NULL, fit, err);
    if (status == WT_OK)
        status = build_fit_tables(fit, n_draws, work, &t, err);
    const wt_rubber_tables of = {.prony = t.prony,
                                 .shift_factors = t.shift_factors,
                                 .material_draws = t.material_draws,
                                 .series_draws = t.series_draws};
    if (status == WT_OK)
        status = wt_rubber_from_tables(&of, poisson_ratio, rubber, err);
    wt_master_tables_clear(&t);
    return status;
}

wt_status wt_rubber_refit(const wt_rubber *rubber, wt_vertical_shift vertical, wt_rubber *refitted,
                          wt_error *err)
{
    if (rubber == NULL || refitted == NULL)
        return wt_fail(err, WT_E_ARG, "no rubber");
    if (rubber->sweep.n_isotherms == 0)
        return wt_fail(err, WT_E_MISSING, "there are no isotherms to be fitted again");
    const wt_job work = {.left_out = WT_EXTRA_ALL};
    wt_master_options options = rubber->fit;
    wt_master fit = {0};
    options.vertical = vertical;
    const wt_status status = flow_rubber_fit(&rubber->sweep, &options, rubber->poisson_ratio, 0,
                                             &work, &fit, refitted, err);
    if (status == WT_OK) {
        refitted->is_transverse = rubber->is_transverse;
        refitted->transverse = rubber->transverse;
    }
    wt_master_clear(&fit);
    return status;
}

static wt_status build_influences(const wt_master_job *job, const wt_job *work,
                                  const wt_sweep *sweep, const wt_master *m, wt_table **table,
                                  wt_error *err)
{
    const wt_master_options options = fit_options(job, work);
    return flow_influence_table(sweep, &options, m, work->log, table, err);
}

static void warn_unconverged(const wt_master *m, const wt_job *work)
{
    if (!flow_fit_has_converged(m))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the fit ended before it converged: a further iteration would change a "
                   "number by up to %.2g of its standard error",
                   m->step_bound);
}

/* Returns the standard error [decade] of the fitted E' if it exists, otherwise of E'' or tan
 * delta. */
static double fitted_modulus_error(const wt_master *m, size_t i)
{
    return !isnan(m->fitted_storage[i].value) ? m->fitted_storage[i].standard_error
           : !isnan(m->fitted_loss[i].value)  ? m->fitted_loss[i].standard_error
                                              : m->fitted_loss_factor[i].standard_error;
}

/* Returns the mean standard error of the determined shifts [decade]. */
static double mean_shift_error(const wt_master *m)
{
    double sum = 0;
    size_t n = 0;
    for (size_t i = 0; i < m->n_shifts; i++)
        if (m->shifts[i].determined) {
            sum += m->shifts[i].log_a.standard_error;
            n++;
        }
    return n > 0 ? sum / (double)n : 0;
}

/* Reports the cost. The reported number is the mean relative standard error of E', or of aT if the
 * fitted moduli are not computed. */
static void report_fit_cost(const wt_master *m, const wt_job *work)
{
    double error = needs_master_curve(work) ? 0 : M_LN10 * mean_shift_error(m);
    for (size_t i = 0; i < m->n && needs_master_curve(work); i++)
        error += M_LN10 * fitted_modulus_error(m, i) / (double)m->n;
    cost_add_nodes(work->cost, m->evaluations);
    cost_report(work, (cost_summary){.items = (double)m->n_shifts,
                                     .tolerance_asked = m->step_tolerance * error,
                                     .error_estimated = m->step_bound * error,
                                     .number = {1, error, 0, "1"}});
}

wt_status wt_master_compute(const wt_master_job *job, const wt_job *work, wt_master_tables *tables,
                            wt_rubber *rubber, wt_error *err)
{
    if (job == NULL || work == NULL)
        return wt_fail(err, WT_E_ARG, "no DMA job");
    wt_sweep sweep = {0};
    wt_master master = {0};
    wt_master_tables t = {0};
    wt_status status = param_check(wt_master_job_params(), job, err);
    if (status == WT_OK)
        status = param_check(wt_job_params(), work, err);
    if (status == WT_OK)
        status = flow_sweeps_read(job->sets, job->n_sets, work, &sweep, err);
    if (status == WT_OK)
        status = check_strain_sweeps(&sweep, work, err);
    if (status == WT_OK)
        status = flow_require_one_sample(&sweep, job->sets, job->n_sets, work->log, err);
    if (status == WT_OK)
        status = flow_select_amplitude(&sweep, job->sets, job->n_sets, work->log, err);
    if (status == WT_OK)
        status = fit_master_curve(job, work, &sweep, &master, err);
    if (status == WT_OK)
        status = build_fit_tables(&master, FLOW_STORED_DRAWS, work, &t, err);
    if (status == WT_OK)
        status = store_sample_name(&sweep, t.shift_factors, err);
    if (status == WT_OK && needs_master_curve(work))
        status = flow_master_curve_table(&master, &t.master_curve, err);
    if (status == WT_OK && has_modulus_level(&master) && (work->left_out & WT_EXTRA_SPECTRUM) == 0)
        status = flow_spectrum_table(&master, &t.relaxation_spectrum, err);
    if (status == WT_OK && has_modulus_level(&master) &&
        (work->left_out & WT_EXTRA_REDUCED_SERIES) == 0)
        status = flow_reduced_table(&master, job, work, &t.prony_reduced, err);
    if (status == WT_OK && (work->left_out & WT_EXTRA_INFLUENCES) == 0)
        status = build_influences(job, work, &sweep, &master, &t.influences, err);
    if (status == WT_OK && rubber != NULL && !has_modulus_level(&master))
        status = fail_no_modulus_level(&master, err);
    if (status == WT_OK && rubber != NULL) {
        const wt_rubber_tables of = {.prony = t.prony,
                                     .shift_factors = t.shift_factors,
                                     .material_draws = t.material_draws,
                                     .series_draws = t.series_draws};
        status = wt_rubber_from_tables(&of, job->poisson_ratio, rubber, err);
    }
    if (status == WT_OK && rubber != NULL) {
        rubber->sweep = sweep;
        rubber->fit = job->fit;
        rubber->fit.terms_per_decade = master.terms_per_decade; /* avoids a second search */
        sweep = (wt_sweep){0};
    }
    if (status == WT_OK) {
        warn_unconverged(&master, work);
        report_fit_cost(&master, work);
    }
    if (status == WT_OK && tables != NULL) {
        t.fit = wt_alloc(1, sizeof *t.fit);
        *t.fit = master;
        master = (wt_master){0};
        *tables = t;
        t = (wt_master_tables){0};
    }
    wt_sweep_clear(&sweep);
    wt_master_clear(&master);
    wt_master_tables_clear(&t);
    return status;
}
