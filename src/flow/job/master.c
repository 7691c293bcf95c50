/* The DMA job: sweeps to shift factors, WLF, master curve and Prony series.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/inputs.h"
#include "flow/job/single_isotherm.h"

#include "data/tables/tables.h"
#include "model/material.h"

#include <math.h>
#include <stdlib.h>

wt_master_job wt_master_job_defaults(void)
{
    return (wt_master_job){
        .shift = wt_shift_defaults(), .prony = wt_prony_defaults(), .poisson_ratio = 0.5};
}

static const wt_param rows[] = {POISSON_RATIO(wt_master_job)};
PARAM_TABLE(wt_master_job_params, wt_master_job, rows, wt_master_job_defaults,
            PARAM_PART(wt_shift_params, wt_master_job, shift),
            PARAM_PART(wt_prony_params, wt_master_job, prony))

void wt_master_tables_clear(wt_master_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->shift_factors);
    wt_table_free(tables->master_curve);
    wt_table_free(tables->prony);
    *tables = (wt_master_tables){0};
}

static const char *vertical_name(wt_vertical_shift vertical)
{
    static const char *const names[] = {"none", "physical", "free"};
    return names[vertical];
}

static const char *deformation_name(wt_deformation deformation)
{
    return deformation == WT_SHEAR ? "shear" : "tension";
}

/* ---- reading --------------------------------------------------------------------------------- */

static wt_status read_sweeps(const wt_master_job *job, const wt_job *work, wt_sweep *sweep,
                             wt_error *err)
{
    flow_files files = {NULL, 0};
    wt_status status = flow_files_list(job->sets, job->n_sets, work, &files, err);
    for (size_t i = 0; status == WT_OK && i < files.n; i++) {
        wt_input *input = NULL;
        wt_error failure = WT_ERROR_INIT;
        status = flow_open(work, &files.file[i], "dma", WT_KIND_SWEEP, &input, &failure);
        if (status == WT_OK)
            status = wt_sweep_read(work->formats, input, &files.file[i].read, work->log, sweep,
                                   &failure);
        wt_input_close(input);
        if (status != WT_OK)
            status = flow_failed(work, files.file[i].name, status, &failure, err);
    }
    if (status == WT_OK && sweep->n_isotherms == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no DMA isotherm could be read");
        wt_error_found(err, "files: %zu", files.n);
        wt_error_advice(err, "`weartrack info FILE` shows what a file holds");
    }
    if (status == WT_OK)
        wt_sweep_sort(sweep);
    flow_files_clear(&files);
    return status;
}

/* ---- tables ---------------------------------------------------------------------------------- */

static void put_shift(table_writer *t, const wt_shift *s, const wt_wlf_fit *wlf)
{
    table_row(t);
    shift_factors_put(t, SHIFT_FACTORS_TEMPERATURE, s->temperature);
    shift_factors_put(t, SHIFT_FACTORS_LOG_A, s->log_a.value);
    shift_factors_put(t, SHIFT_FACTORS_LOG_A_STANDARD_ERROR, s->log_a.standard_error);
    shift_factors_put(t, SHIFT_FACTORS_LOG_B, s->log_b.value);
    shift_factors_put(t, SHIFT_FACTORS_LOG_B_STANDARD_ERROR, s->log_b.standard_error);
    shift_factors_put(t, SHIFT_FACTORS_LOG_B_PHYSICAL, s->log_b_physical);
    shift_factors_put(t, SHIFT_FACTORS_CORRELATION, s->correlation);
    shift_factors_put(t, SHIFT_FACTORS_OVERLAP, fmin(s->overlap_storage, s->overlap_loss));
    shift_factors_put(t, SHIFT_FACTORS_DETERMINED, s->determined);
    shift_factors_put_text(t, SHIFT_FACTORS_NOTE, s->note);
    if (wlf != NULL)
        shift_factors_put(t, SHIFT_FACTORS_WLF_LOG_A, wt_wlf_log_shift(&wlf->wlf, s->temperature));
}

static void set_law(table_writer *t, const wt_wlf_fit *f, double floor)
{
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_WLF_C1, f->wlf.c1, f->c1_error, 0);
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_WLF_C2, f->wlf.c2, f->c2_error, 0);
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_WLF_SLOPE, f->slope, f->slope_error, 0);
    shift_factors_set_print(t, SHIFT_FACTORS_KEY_WLF_CORRELATION, "%.6g", f->correlation);
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_POLE, f->pole, f->pole_error, 0);
    /* what the errors of c1 and c2 take every shift to be wrong by, on top of its own */
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_WLF_FLOOR, floor, 0, 0);
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_WLF_RMS, f->rms, 0, 0);
    shift_factors_set_text(t, SHIFT_FACTORS_KEY_WLF_STRAIGHT,
                           f->straight ? "yes: only the slope c1/c2 is determined" : "no");
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY, f->activation_energy,
                            f->activation_energy_error, 0);
}

static wt_status shift_table(const wt_master_curve *master, const wt_wlf_fit *wlf, double floor,
                             wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&shift_factors_schema, err);
    for (size_t i = 0; i < master->n_shifts; i++)
        put_shift(&t, &master->shifts[i], wlf);
    if (wlf != NULL)
        set_law(&t, wlf, floor);
    shift_factors_set_value(&t, SHIFT_FACTORS_KEY_REFERENCE_TEMPERATURE,
                            master->reference_temperature, 0, 0);
    shift_factors_set_text(&t, SHIFT_FACTORS_KEY_VERTICAL, vertical_name(master->vertical));
    shift_factors_set_text(&t, SHIFT_FACTORS_KEY_DEFORMATION,
                           deformation_name(master->deformation));
    const char *superposition = master->superposition_failed ? "failed" : "holds";
    if (master->n_shifts < 2)
        superposition = "not tested";
    shift_factors_set_print(&t, SHIFT_FACTORS_KEY_SUPERPOSITION, "%s%s%s", superposition,
                            master->note[0] != '\0' ? ": " : "", master->note);
    return table_end(&t, table);
}

/* E' and E'' of a series as given, in tension or shear, at one frequency. */
static void prony_modulus(const wt_prony *prony, double omega, double *storage, double *loss)
{
    *storage = prony->equilibrium_modulus;
    *loss = 0;
    for (size_t i = 0; i < prony->n; i++) {
        double z = omega * prony->relaxation_time[i];
        double share = prony->modulus[i] / (z + 1 / z);
        *storage += share * z;
        *loss += share;
    }
}

static wt_status master_table(const wt_master_curve *master, const wt_prony_fit *fit,
                              wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&master_curve_schema, err);
    for (size_t k = 0; k < master->n_shifts; k++) {
        table_block(&t);
        for (size_t i = 0; i < master->n; i++) {
            if (master->isotherm[i] != k)
                continue;
            double omega = pow(10, master->log_frequency[i]), storage, loss;
            prony_modulus(&fit->prony, omega, &storage, &loss);
            table_row(&t);
            master_curve_put(&t, MASTER_CURVE_ANGULAR_FREQUENCY, omega);
            master_curve_put(&t, MASTER_CURVE_STORAGE_MODULUS, pow(10, master->log_storage[i]));
            master_curve_put(&t, MASTER_CURVE_LOSS_MODULUS, pow(10, master->log_loss[i]));
            master_curve_put(&t, MASTER_CURVE_TEMPERATURE, master->shifts[k].temperature);
            master_curve_put(&t, MASTER_CURVE_FITTED_STORAGE, storage);
            master_curve_put(&t, MASTER_CURVE_FITTED_LOSS, loss);
        }
    }
    master_curve_set_print(&t, MASTER_CURVE_KEY_RMS_STORAGE, "%.6g", fit->rms_storage);
    master_curve_set_print(&t, MASTER_CURVE_KEY_RMS_LOSS, "%.6g", fit->rms_loss);
    master_curve_set_print(&t, MASTER_CURVE_KEY_OVERLAP_RMS_STORAGE, "%.6g", master->rms_storage);
    master_curve_set_print(&t, MASTER_CURVE_KEY_OVERLAP_RMS_LOSS, "%.6g", master->rms_loss);
    master_curve_set_print(&t, MASTER_CURVE_KEY_KRAMERS_KRONIG, "%.6g", master->kramers_kronig);
    master_curve_set_value(&t, MASTER_CURVE_KEY_REFERENCE_TEMPERATURE,
                           master->reference_temperature, 0, 0);
    master_curve_set_text(&t, MASTER_CURVE_KEY_DEFORMATION, deformation_name(master->deformation));
    return table_end(&t, table);
}

static wt_status prony_table(const wt_prony_fit *fit, wt_table **table, wt_error *err)
{
    const wt_prony *p = &fit->prony;
    table_writer t = table_begin(&prony_schema, err);
    for (size_t i = 0; i < p->n; i++) {
        table_row(&t);
        prony_put(&t, PRONY_RELAXATION_TIME, p->relaxation_time[i]);
        prony_put(&t, PRONY_MODULUS, p->modulus[i]);
    }
    prony_set_value(&t, PRONY_KEY_EQUILIBRIUM_MODULUS, p->equilibrium_modulus, 0, 0);
    prony_set_value(&t, PRONY_KEY_REFERENCE_TEMPERATURE, p->reference_temperature, 0, 0);
    prony_set_value(&t, PRONY_KEY_FREQUENCY_MIN, p->frequency_min, 0, 0);
    prony_set_value(&t, PRONY_KEY_FREQUENCY_MAX, p->frequency_max, 0, 0);
    prony_set_text(&t, PRONY_KEY_DEFORMATION, deformation_name(p->deformation));
    prony_set_print(&t, PRONY_KEY_RMS_STORAGE, "%.6g", fit->rms_storage);
    prony_set_print(&t, PRONY_KEY_RMS_LOSS, "%.6g", fit->rms_loss);
    return table_end(&t, table);
}

/* ---- the job --------------------------------------------------------------------------------- */

/* What is fitted to the sweeps. */
typedef struct fits {
    wt_sweep sweep;
    wt_shift_options shift;
    wt_master_curve master;
    wt_wlf_fit wlf;
    bool has_wlf;
    wt_prony_fit prony;
} fits;

static void fits_clear(fits *f)
{
    wt_sweep_clear(&f->sweep);
    wt_master_curve_clear(&f->master);
    wt_prony_clear(&f->prony.prony);
}

/* Fits the shift law; a law that cannot be fitted is a warning: the reference temperature remains.
 */
static wt_status fit_law(fits *f, const wt_job *work, wt_error *err)
{
    wt_error failure = WT_ERROR_INIT;
    if (f->master.n_shifts < 2)
        return WT_OK;
    wt_status status = wt_wlf_fit_shifts(&f->master, f->shift.floor, &f->wlf, &failure);
    f->has_wlf = status == WT_OK;
    if (status == WT_E_MEMORY || status == WT_E_INTERNAL) {
        if (err != NULL)
            *err = failure;
        return status;
    }
    if (status != WT_OK)
        wt_parselog_add(work->log, WT_WARNING, NULL, NULL, "no WLF law fits the shift factors: %s",
                        failure.message);
    return WT_OK;
}

static wt_status fit_all(const wt_master_job *job, const wt_job *work, fits *f, wt_error *err)
{
    const size_t n = f->sweep.n_isotherms;
    f->shift = job->shift;
    if (isnan(f->shift.reference_temperature))
        f->shift.reference_temperature = f->sweep.isotherms[n / 2].temperature;
    wt_status status = n == 1
                           ? flow_single_isotherm(&f->sweep, &f->shift, work->log, &f->master, err)
                           : wt_shift_fit(&f->sweep, &f->shift, work->log, &f->master, err);
    if (status == WT_OK)
        status = fit_law(f, work, err);
    if (status == WT_OK)
        status = wt_prony_fit_master(&f->master, &job->prony, &f->prony, err);
    if (status == WT_OK)
        return WT_OK;
    /* the fit sees isotherms, not files */
    if (job->n_sets > 0 && job->sets[0].n_patterns > 0)
        wt_error_file(err, job->sets[0].patterns[0]);
    if (err != NULL && err->place[0] == '\0')
        wt_error_place(err, "%zu isotherm%s from %s", n, n == 1 ? "" : "s",
                       f->sweep.isotherms[0].source);
    return status;
}

static wt_status make_tables(const fits *f, wt_master_tables *t, wt_error *err)
{
    t->n_isotherms = f->sweep.n_isotherms;
    wt_status status = shift_table(&f->master, f->has_wlf ? &f->wlf : NULL, f->shift.floor,
                                   &t->shift_factors, err);
    if (status == WT_OK)
        status = master_table(&f->master, &f->prony, &t->master_curve, err);
    return status == WT_OK ? prony_table(&f->prony, &t->prony, err) : status;
}

static wt_status keep_vertical(const wt_master_curve *master, wt_rubber *rubber, wt_error *err)
{
    if (master->vertical == WT_VERTICAL_NONE || master->n_shifts == 0)
        return WT_OK;
    rubber->vertical_temperature = malloc(master->n_shifts * sizeof(double));
    rubber->vertical_log_b = malloc(master->n_shifts * sizeof(double));
    if (rubber->vertical_temperature == NULL || rubber->vertical_log_b == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; i < master->n_shifts; i++) {
        if (!master->shifts[i].determined)
            continue;
        rubber->vertical_temperature[rubber->n_vertical] = master->shifts[i].temperature;
        rubber->vertical_log_b[rubber->n_vertical++] = master->shifts[i].log_b.value;
    }
    return WT_OK;
}

/* Takes the master curve and the series out of the fits. */
static wt_status make_rubber(const wt_master_job *job, fits *f, wt_rubber *rubber, wt_error *err)
{
    wt_rubber r = {.poisson_ratio = job->poisson_ratio,
                   .prony_options = job->prony,
                   .has_wlf = f->has_wlf,
                   .wlf = f->wlf.wlf,
                   .c1_error = f->wlf.c1_error,
                   .c2_error = f->wlf.c2_error,
                   .c_correlation = f->wlf.correlation,
                   .slope_error = f->wlf.straight ? f->wlf.slope_error : 0,
                   .temperature_min = f->sweep.isotherms[0].temperature,
                   .temperature_max = f->sweep.isotherms[f->sweep.n_isotherms - 1].temperature};
    wt_status status = keep_vertical(&f->master, &r, err);
    if (status != WT_OK) {
        wt_rubber_clear(&r);
        return status;
    }
    r.prony = f->prony.prony;
    f->prony.prony = (wt_prony){0};
    r.master = f->master;
    r.has_master = true;
    f->master = (wt_master_curve){0};
    *rubber = r;
    return WT_OK;
}

wt_status wt_master_make(const wt_master_job *job, const wt_job *work, wt_master_tables *tables,
                         wt_rubber *rubber, wt_error *err)
{
    if (job == NULL || work == NULL)
        return wt_fail(err, WT_E_ARG, "no DMA job");
    fits f = {0};
    wt_master_tables t = {0};
    wt_status status = param_check(wt_master_job_params(), job, err);
    if (status == WT_OK)
        status = param_check(wt_job_params(), work, err);
    if (status == WT_OK)
        status = read_sweeps(job, work, &f.sweep, err);
    if (status == WT_OK)
        status = fit_all(job, work, &f, err);
    if (status == WT_OK && tables != NULL)
        status = make_tables(&f, &t, err);
    if (status == WT_OK && rubber != NULL)
        status = make_rubber(job, &f, rubber, err);
    if (status == WT_OK && tables != NULL) {
        *tables = t;
        t = (wt_master_tables){0};
    }
    fits_clear(&f);
    wt_master_tables_clear(&t);
    return status;
}
