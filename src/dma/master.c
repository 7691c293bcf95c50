/* The DMA job: fits one spectrum to the sweeps and builds the tables of shift factors, master
 * curve and series.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/master.h"
#include "dma/ramp_windows.h"
#include "dma/sweep_input.h"
#include "job/cost.h"

#include "core/base/array.h"
#include "core/base/param.h"
#include "core/table/table_rows.h"
#include "dma/law/material.h"

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
             "arrhenius:activation-energy=80kJ/mol; its errors are in no interval",
     .check = check_shift_law},
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
    wt_table_free(tables->material_draws);
    wt_table_free(tables->series_draws);
    wt_master_clear(tables->fit);
    free(tables->fit);
    *tables = (wt_master_tables){0};
}

static const char *shift_quantity_name(const wt_master *m)
{
    const wt_shift_quantity by = wt_master_shift_quantity(m);
    if (m->loading != WT_OSCILLATION)
        return m->loading == WT_CREEP ? "creep compliance" : "relaxation modulus";
    static const char *const names[] = {"both moduli", "storage modulus alone",
                                        "loss modulus alone", "loss factor alone"};
    return names[by];
}

/* ---- tables ---------------------------------------------------------------------------------- */

TABLE_ROW(shift_factors, SHIFT_FACTORS, wt_master_shift shift; double closed_form;)

static void set_interval(table_writer *t, shift_factors_key key, wt_interval x)
{
    shift_factors_set_value(t, key, x.value, x.standard_error, 0);
}

static void set_law_keys(table_writer *t, const wt_master *m)
{
    const bool none = m->law.kind == WT_LAW_NONE;
    shift_factors_set_print(t, SHIFT_FACTORS_KEY_LAW, "%s%s%s", shift_law_kind_text(m->law.kind),
                            none ? ": " : "", none ? m->no_law_reason : "");
    if (none)
        return;
    if (m->law.kind != WT_LAW_ARRHENIUS) {
        set_interval(t, SHIFT_FACTORS_KEY_WLF_C1, m->c1);
        set_interval(t, SHIFT_FACTORS_KEY_WLF_C2, m->c2);
        shift_factors_set_print(t, SHIFT_FACTORS_KEY_WLF_CORRELATION, "%.6g", m->c_correlation);
        set_interval(t, SHIFT_FACTORS_KEY_POLE, m->pole);
    }
    if (m->law.kind != WT_LAW_WLF)
        set_interval(t, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY, m->activation_energy);
    if (m->law.kind == WT_LAW_WLF_ARRHENIUS)
        shift_factors_set_value(t, SHIFT_FACTORS_KEY_JOINT, m->law.joint, (double)NAN, 0);
    set_interval(t, SHIFT_FACTORS_KEY_LAW_SLOPE, m->slope);
    set_interval(t, SHIFT_FACTORS_KEY_OFFSET, m->offset);
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_LAW_RMS, m->law_rms, 0, 0);
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_TEMPERATURE_SPREAD, m->temperature_spread,
                            (double)NAN, 0);
}

static void set_superposition_keys(table_writer *t, const wt_master *m)
{
    shift_factors_set_print(t, SHIFT_FACTORS_KEY_SUPERPOSITION, "%s%s%s",
                            superposition_text(m->superposition), isnan(m->valid_from) ? ": " : " ",
                            m->superposition_reason);
    if (isnan(m->lack_of_fit_p))
        return;
    shift_factors_set_print(t, SHIFT_FACTORS_KEY_LACK_OF_FIT_P, "%.3g", m->lack_of_fit_p);
    shift_factors_set_print(t, SHIFT_FACTORS_KEY_MISFIT_LOW, "%.3g", m->misfit_low);
    shift_factors_set_print(t, SHIFT_FACTORS_KEY_MISFIT_HIGH, "%.3g", m->misfit_high);
    const double factor = exp(m->loss_factor);
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_LOSS_FACTOR, factor, factor * m->loss_factor_error,
                            0);
    shift_factors_set_print(t, SHIFT_FACTORS_KEY_KRAMERS_KRONIG_P, "%.3g", m->kramers_kronig_p);
}

/* Fraction of a standard error that is visible in an interval: a twentieth of its half width. */
static const double visible_step = 0.1;

static bool fit_has_converged(const wt_master *m)
{
    return m->has_converged && !(m->step_bound > visible_step);
}

static void set_route_keys(table_writer *t, const wt_master *m)
{
    if (m->shift_route == WT_SHIFTS_FROM_OVERLAP)
        shift_factors_set_text(t, SHIFT_FACTORS_KEY_ROUTE,
                               "overlap of the storage modulus, neighbour by neighbour");
    if (!isnan(m->valid_from)) {
        shift_factors_set_value(t, SHIFT_FACTORS_KEY_HOLDS_FROM, m->valid_from, 0, 0);
        shift_factors_set_value(t, SHIFT_FACTORS_KEY_HOLDS_TO, m->valid_to, 0, 0);
    }
    if (!fit_has_converged(m))
        shift_factors_set_print(t, SHIFT_FACTORS_KEY_STEP_LEFT, "%.3g", m->step_bound);
}

static wt_status build_shift_table(const wt_master *m, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&shift_factors_schema, err);
    for (size_t i = 0; i < m->n_shifts; i++)
        TABLE_ADD(shift_factors, &t, m->shifts[i], wt_master_closed_form(m, i));
    set_law_keys(&t, m);
    shift_factors_set_value(&t, SHIFT_FACTORS_KEY_REFERENCE_TEMPERATURE, m->reference_temperature,
                            0, 0);
    shift_factors_set_text(&t, SHIFT_FACTORS_KEY_VERTICAL, vertical_shift_text(m->vertical));
    if (wt_master_shift_quantity(m) != WT_SHIFT_MODULI)
        shift_factors_set_text(&t, SHIFT_FACTORS_KEY_SHIFTED_BY, shift_quantity_name(m));
    set_route_keys(&t, m);
    shift_factors_set_text(&t, SHIFT_FACTORS_KEY_DEFORMATION,
                           flow_deformation_name(m->deformation));
    set_superposition_keys(&t, m);
    return table_end(&t, table);
}

TABLE_ROW(master_curve, MASTER_CURVE, double angular_frequency, storage_modulus, loss_modulus,
          loss_factor, temperature;
          wt_interval fitted_storage, fitted_loss, fitted_loss_factor;
          double own_frequency, own_storage, own_loss; bool left_out;
          double time, relaxation_modulus, creep_compliance;
          wt_interval fitted_relaxation, fitted_creep; double own_relaxation, own_creep, own_time;)

TABLE_KEYS_OF(master_curve, MASTER_CURVE, wt_master)

/* Converts the interval of log10 of a modulus to that of the compliance, its inverse. */
static wt_interval inverse_interval(wt_interval x)
{
    return flow_power_of_ten((wt_interval){-x.value, x.standard_error, -x.high, -x.low});
}

static void add_master_curve_row(table_writer *t, const wt_master *m, size_t i)
{
    const wt_master_shift *shift = &m->shifts[m->isotherm[i]];
    const double frequency = m->log_frequency[i], storage = m->log_storage[i],
                 loss = m->log_loss[i], step = m->log_step[i], none = (double)NAN;
    const double own_step = step - shift->log_b.value;
    const wt_interval unknown = {none, none, none, none};
    const double own_frequency = pow(10, frequency - shift->log_a.value + m->offset.value);
    const bool relaxes = m->loading == WT_RELAXATION, creeps = m->loading == WT_CREEP;
    TABLE_ADD(master_curve, t, .angular_frequency = pow(10, frequency),
              .storage_modulus = pow(10, storage), .loss_modulus = pow(10, loss),
              .loss_factor = wt_master_loss_factor(m, i), .temperature = shift->temperature,
              .fitted_storage = flow_power_of_ten(m->fitted_storage[i]),
              .fitted_loss = flow_power_of_ten(m->fitted_loss[i]),
              .fitted_loss_factor = flow_power_of_ten(m->fitted_loss_factor[i]),
              .own_frequency = own_frequency, .own_storage = pow(10, storage - shift->log_b.value),
              .own_loss = pow(10, loss - shift->log_b.value), .left_out = m->is_outlier[i],
              .time = relaxes || creeps ? pow(10, -frequency) : none,
              .relaxation_modulus = relaxes ? pow(10, step) : none,
              .creep_compliance = creeps ? pow(10, -step) : none,
              .fitted_relaxation = relaxes ? flow_power_of_ten(m->fitted_step[i]) : unknown,
              .fitted_creep = creeps ? inverse_interval(m->fitted_step[i]) : unknown,
              .own_relaxation = relaxes ? pow(10, own_step) : none,
              .own_creep = creeps ? pow(10, -own_step) : none,
              .own_time = relaxes || creeps ? 1 / own_frequency : none);
}

/* Returns a bit mask of the columns without measured data. */
static uint64_t unmeasured_columns(const wt_master *m)
{
    static const master_curve_column relaxation[] = {
        MASTER_CURVE_RELAXATION_MODULUS, MASTER_CURVE_FITTED_RELAXATION,
        MASTER_CURVE_FITTED_RELAXATION_LOW, MASTER_CURVE_FITTED_RELAXATION_HIGH,
        MASTER_CURVE_OWN_RELAXATION};
    static const master_curve_column creep[] = {
        MASTER_CURVE_CREEP_COMPLIANCE, MASTER_CURVE_FITTED_CREEP, MASTER_CURVE_FITTED_CREEP_LOW,
        MASTER_CURVE_FITTED_CREEP_HIGH, MASTER_CURVE_OWN_CREEP};
    uint64_t left = m->loading == WT_OSCILLATION
                        ? SCHEMA_BIT(MASTER_CURVE_TIME) | SCHEMA_BIT(MASTER_CURVE_OWN_TIME)
                        : 0;
    for (size_t i = 0; m->loading != WT_RELAXATION && i < COUNT_OF(relaxation); i++)
        left |= SCHEMA_BIT(relaxation[i]);
    for (size_t i = 0; m->loading != WT_CREEP && i < COUNT_OF(creep); i++)
        left |= SCHEMA_BIT(creep[i]);
    return left;
}

static wt_status build_master_table(const wt_master *m, wt_table **table, wt_error *err)
{
    table_writer t = table_begin_variant(&master_curve_schema,
                                         (table_variant){.left_out = unmeasured_columns(m)}, err);
    for (size_t k = 0; k < m->n_shifts; k++) {
        table_block(&t);
        for (size_t i = 0; i < m->n; i++)
            if (m->isotherm[i] == k)
                add_master_curve_row(&t, m, i);
    }
    master_curve_set_keys(&t, m);
    master_curve_set_text(&t, MASTER_CURVE_KEY_DEFORMATION, flow_deformation_name(m->deformation));
    return table_end(&t, table);
}

TABLE_KEYS(prony, PRONY, wt_prony series; wt_estimate equilibrium_modulus;
           double limit, noise_storage, noise_loss; const char *deformation;)

TABLE_ROW(prony, PRONY, double relaxation_time, modulus;)

static wt_status build_prony_table(const wt_master *m, wt_table **table, wt_error *err)
{
    const wt_prony *p = &m->prony;
    table_writer t = table_begin(&prony_schema, err);
    for (size_t i = 0; i < p->n; i++)
        TABLE_ADD(prony, &t, p->relaxation_time[i], p->modulus[i]);
    TABLE_SET(prony, &t, *p, {p->equilibrium_modulus, m->equilibrium.standard_error, 0, NULL},
              m->equilibrium_limit ? m->equilibrium.high : (double)NAN, m->noise_storage,
              m->noise_loss, flow_deformation_name(p->deformation));
    return table_end(&t, table);
}

/* ---- draws ----------------------------------------------------------------------------------- */

/* The draws have a fixed seed, so that the stored tables equal those of a job that starts from
 * the isotherms. */
enum { DRAWS_SEED = 1 };

/* Rounds to seven digits, far below the scatter of the draws, which shortens the tables. */
static double round_to_seven_digits(double x)
{
    if (!(fabs(x) > 0) || !isfinite(x))
        return x;
    const double scale = pow(10, 6 - floor(log10(fabs(x))));
    return scale > 1 ? round(x * scale) / scale : round(x * scale) * (1 / scale);
}

TABLE_ROW(material_draws, MATERIAL_DRAWS, double draw, temperature, log_b, equilibrium_modulus,
          wlf_c1, wlf_c2, activation_energy;)

/* Adds a row for each isotherm with a vertical shift, or one row. The first row also has the
 * constants of the draw. */
static void add_material_draw_rows(table_writer *t, const wt_master *m, size_t draw,
                                   const wt_prony *prony, const wt_shift_law *law,
                                   const double *log_b)
{
    const bool vertical = m->vertical != WT_VERTICAL_NONE && m->n_shifts > 1;
    const double none = (double)NAN;
    bool first = true;
    material_draws_row row = {(double)draw + 1,
                              none,
                              none,
                              round_to_seven_digits(prony->equilibrium_modulus),
                              round_to_seven_digits(law->wlf.c1),
                              round_to_seven_digits(law->wlf.c2),
                              round_to_seven_digits(law->activation_energy)};
    table_block(t);
    for (size_t i = 0; vertical ? i < m->n_shifts : first; i++) {
        if (vertical && !m->shifts[i].determined)
            continue;
        if (vertical) {
            row.temperature = m->shifts[i].temperature;
            row.log_b = round_to_seven_digits(log_b[i]);
        }
        material_draws_add_row(t, &row);
        row.equilibrium_modulus = row.wlf_c1 = row.wlf_c2 = row.activation_energy = none;
        first = false;
    }
}

TABLE_ROW(series_draws, SERIES_DRAWS, double draw, relaxation_time, modulus;)

static void add_series_draw_rows(table_writer *t, size_t draw, const wt_prony *prony)
{
    table_block(t);
    for (size_t k = 0; k < prony->n; k++)
        TABLE_ADD(series_draws, t, (double)draw + 1,
                  round_to_seven_digits(prony->relaxation_time[k]),
                  round_to_seven_digits(prony->modulus[k]));
}

static wt_status build_draw_tables(const wt_master *m, size_t n, wt_master_tables *tables,
                                   wt_error *err)
{
    double *log_b = malloc((m->n_shifts + 1) * sizeof *log_b);
    if (log_b == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    table_writer material = table_begin(&material_draws_schema, err),
                 series = table_begin(&series_draws_schema, err);
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        wt_prony prony = {0};
        wt_shift_law law;
        status = wt_master_draw(m, DRAWS_SEED, i, &prony, &law, log_b, err);
        if (status == WT_OK) {
            add_material_draw_rows(&material, m, i, &prony, &law, log_b);
            add_series_draw_rows(&series, i, &prony);
        }
        wt_prony_clear(&prony);
    }
    material_draws_set_value(&material, MATERIAL_DRAWS_KEY_REFERENCE_TEMPERATURE,
                             m->reference_temperature, 0, 0);
    const wt_status first = table_end(&material, &tables->material_draws),
                    second = table_end(&series, &tables->series_draws);
    free(log_b);
    return status != WT_OK ? status : first != WT_OK ? first : second;
}

/* ---- the job --------------------------------------------------------------------------------- */

/* Strain sweeps contain no information about the spectrum. The function warns if they are
 * skipped and fails if there is no other data. */
static wt_status check_strain_sweeps(const wt_sweep *sweep, const wt_job *work, wt_error *err)
{
    const size_t n = sweep->n_strain_sweeps;
    if (n > 0 && sweep->n_isotherms + sweep->n_ramps > 0)
        wt_log_add(work->log, WT_WARNING, sweep->strain_sweeps[0].source, NULL,
                   "%zu strain sweep%s left out of the master curve: see `weartrack payne`", n,
                   n > 1 ? "s are" : " is");
    if (n == 0 || sweep->n_isotherms + sweep->n_ramps > 0)
        return WT_OK;
    wt_fail(err, WT_E_EMPTY, "a master curve needs isotherms");
    wt_error_found(err, "strain sweeps: %zu", n);
    wt_error_advice(err, "`weartrack payne FILE` tells how the rubber softens with strain");
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
    if (status == WT_OK)
        status = flow_set_stated_shifts(law, job->shifts, job->fit.vertical, sweep, work->log, err);
    if (status == WT_OK && law->kind != WT_LAW_NONE)
        wt_log_add(work->log, WT_NOTE, NULL, NULL,
                   "the shifts are those of the law that is given: its errors are in no "
                   "interval");
    return status;
}

/* Fits the sweeps. Temperature sweeps are converted to isotherms of `sweep`. */
static wt_status fit_master_curve(const wt_master_job *job, const wt_job *work, wt_sweep *sweep,
                                  wt_master *master, wt_error *err)
{
    wt_shift_law law;
    wt_status status = prepare_sweep(job, work, &law, sweep, err);
    if (status != WT_OK)
        return status;
    status = sweep->n_ramps > 0 ? flow_ramps_fit(sweep, &job->fit, &law, work->log, master, err)
                                : wt_master_fit(sweep, &job->fit, work->log, master, err);
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
    wt_fail(err, WT_E_MISSING, "the %s alone tells no level of the moduli, and friction needs both",
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
    wt_status status = build_shift_table(m, &t->shift_factors, err);
    if (status != WT_OK || !has_modulus_level(m))
        return status;
    if (status == WT_OK)
        status = build_prony_table(m, &t->prony, err);
    return status == WT_OK && (work->left_out & WT_EXTRA_DRAWS) == 0
               ? build_draw_tables(m, n_draws, t, err)
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

static void warn_unconverged(const wt_master *m, const wt_job *work)
{
    if (!fit_has_converged(m))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "the fit ended before it was settled: a further step would move a number "
                   "by up to %.2g of its standard error",
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

/* Reports the cost. The reported number is the mean relative standard error of E'. */
static void report_fit_cost(const wt_master *m, const wt_job *work)
{
    double error = 0;
    for (size_t i = 0; i < m->n; i++)
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
    if (status == WT_OK)
        status = build_master_table(&master, &t.master_curve, err);
    if (status == WT_OK && has_modulus_level(&master) && (work->left_out & WT_EXTRA_SPECTRUM) == 0)
        status = flow_spectrum_table(&master, &t.relaxation_spectrum, err);
    if (status == WT_OK && has_modulus_level(&master) &&
        (work->left_out & WT_EXTRA_REDUCED_SERIES) == 0)
        status = flow_reduced_table(&master, job, work, &t.prony_reduced, err);
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
    if (status == WT_OK && tables != NULL && (t.fit = malloc(sizeof *t.fit)) == NULL)
        status = wt_fail(err, WT_E_MEMORY, "out of memory");
    if (status == WT_OK) {
        warn_unconverged(&master, work);
        report_fit_cost(&master, work);
    }
    if (status == WT_OK && tables != NULL) {
        *t.fit = master;
        master = (wt_master){0};
        *tables = t;
        t = (wt_master_tables){0};
    }
    if (status != WT_OK) { /* the fit is not set on failure */
        free(t.fit);
        t.fit = NULL;
    }
    wt_sweep_clear(&sweep);
    wt_master_clear(&master);
    wt_master_tables_clear(&t);
    return status;
}
