/* The DMA job: sweeps to shift factors, WLF, master curve and Prony series.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/inputs.h"
#include "flow/job/single_isotherm.h"
#include "flow/job/tables.h"
#include "model/material.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

/* ---- reading ----------------------------------------------------------------------------------
 */

static wt_status read_sweeps(const wt_master_job *job, const wt_job *common, wt_sweep *sweep,
                             wt_error *err)
{
    flow_files files = {NULL, 0};
    wt_status status = flow_files_list(job->sets, job->n_sets, common, &files, err);
    for (size_t i = 0; status == WT_OK && i < files.n; i++) {
        wt_input *input = NULL;
        wt_error failure = WT_ERROR_INIT;
        status = flow_open(common, &files.file[i], "dma", WT_KIND_SWEEP, &input, &failure);
        if (status == WT_OK)
            status = wt_sweep_read(common->formats, input, &files.file[i].read, common->log, sweep,
                                   &failure);
        wt_input_close(input);
        if (status == WT_OK)
            continue;
        wt_error_file(&failure, files.file[i].name);
        if (flow_goes_on(common, status))
            status = flow_failed(common, files.file[i].name, &failure, err);
        else if (err != NULL)
            *err = failure;
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

/* ---- tables -----------------------------------------------------------------------------------
 */

static wt_status shift_table(const wt_master_curve *master, const wt_wlf_fit *wlf, double floor,
                             wt_table **out, wt_error *err)
{
    static const flow_column columns[] = {
        {"temperature", "K", "temperature of the isotherm"},
        {"log_a", "1", "log10 of the horizontal shift factor"},
        {"log_a_standard_error", "1", "its standard error [decade]"},
        {"log_b", "1", "log10 of the vertical shift factor"},
        {"log_b_standard_error", "1", "its standard error [decade]"},
        {"log_b_physical", "1", "log10 b that density and temperature would give"},
        {"correlation", "1", "correlation of log a and log b"},
        {"overlap", "1", "smaller of the ordinate overlaps with the neighbour [decade]"},
        {"determined", "1", "1: the data decide the shift"},
        {"note", NULL, "what is odd"},
        {"wlf_log_a", "1", "log10 a of the fitted WLF law"},
    };
    enum {
        TEMPERATURE,
        LOG_A,
        LOG_A_ERROR,
        LOG_B,
        LOG_B_ERROR,
        PHYSICAL,
        CORRELATION,
        OVERLAP,
        DETERMINED,
        NOTE,
        WLF
    };
    wt_table *table = NULL;
    wt_status status =
        flow_table_new("shift_factors", "Shift factors", columns, FLOW_COUNT(columns), &table, err);
    for (size_t i = 0; status == WT_OK && i < master->n_shifts; i++) {
        const wt_shift *s = &master->shifts[i];
        status = wt_table_add_row(table, err);
        if (status == WT_OK)
            status = wt_table_put_text(table, NOTE, s->note, err);
        if (status != WT_OK)
            break;
        wt_table_put(table, TEMPERATURE, s->temperature);
        wt_table_put(table, LOG_A, s->log_a.value);
        wt_table_put(table, LOG_A_ERROR, s->log_a.standard_error);
        wt_table_put(table, LOG_B, s->log_b.value);
        wt_table_put(table, LOG_B_ERROR, s->log_b.standard_error);
        wt_table_put(table, PHYSICAL, s->log_b_physical);
        wt_table_put(table, CORRELATION, s->correlation);
        wt_table_put(table, OVERLAP, fmin(s->overlap_storage, s->overlap_loss));
        wt_table_put(table, DETERMINED, s->determined);
        if (wlf != NULL)
            wt_table_put(table, WLF, wt_wlf_log_shift(&wlf->wlf, s->temperature));
    }
    if (status == WT_OK && wlf != NULL) {
        status = flow_table_value(table, "wlf_c1", wlf->wlf.c1, wlf->c1_error, 0, "1", err);
        if (status == WT_OK)
            status = flow_table_value(table, "wlf_c2", wlf->wlf.c2, wlf->c2_error, 0, "K", err);
        if (status == WT_OK)
            status =
                flow_table_value(table, "wlf_slope", wlf->slope, wlf->slope_error, 0, "1/K", err);
        if (status == WT_OK)
            status = flow_table_key(table, err, "wlf_correlation", "%.6g", wlf->correlation);
        if (status == WT_OK)
            status = flow_table_value(table, "pole", wlf->pole, wlf->pole_error, 0, "K", err);
        /* what the errors of c1 and c2 take every shift to be wrong by, on top of its own */
        if (status == WT_OK)
            status = flow_table_value(table, "wlf_floor", floor, 0, 0, "1", err);
        if (status == WT_OK)
            status = flow_table_value(table, "wlf_rms", wlf->rms, 0, 0, "1", err);
        if (status == WT_OK)
            status = wt_table_set_key(
                table, "wlf_straight",
                wlf->straight ? "yes: only the slope c1/c2 is determined" : "no", err);
        if (status == WT_OK)
            status = flow_table_value(table, "activation_energy", wlf->activation_energy,
                                      wlf->activation_energy_error, 0, "J/mol", err);
    }
    if (status == WT_OK)
        status = flow_table_value(table, "reference_temperature", master->reference_temperature, 0,
                                  0, "K", err);
    if (status == WT_OK)
        status = wt_table_set_key(table, "vertical", vertical_name(master->vertical), err);
    if (status == WT_OK)
        status = wt_table_set_key(table, "deformation", deformation_name(master->deformation), err);
    if (status == WT_OK)
        status = flow_table_key(table, err, "superposition", "%s%s%s",
                                master->n_shifts < 2           ? "not tested"
                                : master->superposition_failed ? "failed"
                                                               : "holds",
                                master->note[0] != '\0' ? ": " : "", master->note);
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *out = table;
    return WT_OK;
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
                              wt_table **out, wt_error *err)
{
    static const flow_column columns[] = {
        {"angular_frequency", "rad/s", "reduced angular frequency"},
        {"storage_modulus", "Pa", "storage modulus, shifted"},
        {"loss_modulus", "Pa", "loss modulus, shifted"},
        {"temperature", "K", "temperature it was measured at"},
        {"fitted_storage", "Pa", "storage modulus of the Prony series"},
        {"fitted_loss", "Pa", "loss modulus of the Prony series"},
    };
    wt_table *table = NULL;
    wt_status status =
        flow_table_new("master_curve", "Master curve", columns, FLOW_COUNT(columns), &table, err);
    for (size_t k = 0; status == WT_OK && k < master->n_shifts; k++) {
        bool first = true;
        for (size_t i = 0; status == WT_OK && i < master->n; i++) {
            if (master->isotherm[i] != k)
                continue;
            if (first && wt_table_n_rows(table) > 0)
                status = wt_table_new_block(table, err);
            first = false;
            if (status == WT_OK)
                status = wt_table_add_row(table, err);
            if (status != WT_OK)
                break;
            double omega = pow(10, master->log_frequency[i]), storage, loss;
            prony_modulus(&fit->prony, omega, &storage, &loss);
            const double row[] = {omega,
                                  pow(10, master->log_storage[i]),
                                  pow(10, master->log_loss[i]),
                                  master->shifts[k].temperature,
                                  storage,
                                  loss};
            for (size_t c = 0; c < FLOW_COUNT(row); c++)
                wt_table_put(table, c, row[c]);
        }
    }
    if (status == WT_OK)
        status = flow_table_key(table, err, "rms_storage", "%.6g", fit->rms_storage);
    if (status == WT_OK)
        status = flow_table_key(table, err, "rms_loss", "%.6g", fit->rms_loss);
    if (status == WT_OK)
        status = flow_table_key(table, err, "overlap_rms_storage", "%.6g", master->rms_storage);
    if (status == WT_OK)
        status = flow_table_key(table, err, "overlap_rms_loss", "%.6g", master->rms_loss);
    if (status == WT_OK)
        status = flow_table_key(table, err, "kramers_kronig", "%.6g", master->kramers_kronig);
    if (status == WT_OK)
        status = flow_table_value(table, "reference_temperature", master->reference_temperature, 0,
                                  0, "K", err);
    if (status == WT_OK)
        status = wt_table_set_key(table, "deformation", deformation_name(master->deformation), err);
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *out = table;
    return WT_OK;
}

static wt_status prony_table(const wt_prony_fit *fit, wt_table **out, wt_error *err)
{
    static const flow_column columns[] = {
        {"relaxation_time", "s", "relaxation time"},
        {"modulus", "Pa", "modulus of the term"},
    };
    const wt_prony *prony = &fit->prony;
    wt_table *table = NULL;
    wt_status status =
        flow_table_new("prony", "Prony series", columns, FLOW_COUNT(columns), &table, err);
    for (size_t i = 0; status == WT_OK && i < prony->n; i++) {
        status = wt_table_add_row(table, err);
        if (status != WT_OK)
            break;
        wt_table_put(table, 0, prony->relaxation_time[i]);
        wt_table_put(table, 1, prony->modulus[i]);
    }
    if (status == WT_OK)
        status = flow_table_value(table, "equilibrium_modulus", prony->equilibrium_modulus, 0, 0,
                                  "Pa", err);
    if (status == WT_OK)
        status = flow_table_value(table, "reference_temperature", prony->reference_temperature, 0,
                                  0, "K", err);
    if (status == WT_OK)
        status = flow_table_value(table, "frequency_min", prony->frequency_min, 0, 0, "rad/s", err);
    if (status == WT_OK)
        status = flow_table_value(table, "frequency_max", prony->frequency_max, 0, 0, "rad/s", err);
    if (status == WT_OK)
        status = wt_table_set_key(table, "deformation", deformation_name(prony->deformation), err);
    if (status == WT_OK)
        status = flow_table_key(table, err, "rms_storage", "%.6g", fit->rms_storage);
    if (status == WT_OK)
        status = flow_table_key(table, err, "rms_loss", "%.6g", fit->rms_loss);
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *out = table;
    return WT_OK;
}

/* ---- the job ----------------------------------------------------------------------------------
 */

/* Fits the shift law; a law that cannot be fitted is a warning: the reference temperature remains.
 */
static wt_status fit_law(const wt_master_curve *master, const wt_shift_options *options,
                         const wt_job *common, wt_wlf_fit *wlf, bool *has_wlf, wt_error *err)
{
    wt_error failure = WT_ERROR_INIT;
    *has_wlf = false;
    if (master->n_shifts < 2)
        return WT_OK;
    wt_status status = wt_wlf_fit_shifts(master, options->floor, wlf, &failure);
    if (status == WT_OK) {
        *has_wlf = true;
        return WT_OK;
    }
    if (status == WT_E_MEMORY || status == WT_E_INTERNAL) {
        if (err != NULL)
            *err = failure;
        return status;
    }
    wt_parselog_add(common->log, WT_WARNING, NULL, NULL, "no WLF law fits the shift factors: %s",
                    failure.message);
    return WT_OK;
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

static wt_shift_options with_reference(const wt_master_job *job, const wt_sweep *sweep)
{
    wt_shift_options options = job->shift;
    if (isnan(options.reference_temperature))
        options.reference_temperature = sweep->isotherms[sweep->n_isotherms / 2].temperature;
    return options;
}

wt_status wt_master_make(const wt_master_job *job, const wt_job *common, wt_master_tables *tables,
                         wt_rubber *rubber, wt_error *err)
{
    if (job == NULL || common == NULL)
        return wt_fail(err, WT_E_ARG, "no DMA job");
    wt_status status = param_check(wt_master_job_params(), job, err);
    if (status != WT_OK)
        return status;
    wt_sweep sweep = {0};
    wt_master_curve master = {0};
    wt_prony_fit prony = {0};
    wt_wlf_fit wlf = {0};
    bool has_wlf = false;
    wt_master_tables t = {0};
    wt_rubber r = {.poisson_ratio = job->poisson_ratio,
                   .prony_options = job->prony,
                   .temperature_min = (double)NAN,
                   .temperature_max = (double)NAN};
    status = read_sweeps(job, common, &sweep, err);
    if (status != WT_OK)
        goto done;
    wt_shift_options shift = with_reference(job, &sweep);
    t.n_isotherms = sweep.n_isotherms;
    status = sweep.n_isotherms == 1
                 ? flow_single_isotherm(&sweep, &shift, common->log, &master, err)
                 : wt_shift_fit(&sweep, &shift, common->log, &master, err);
    if (status == WT_OK)
        status = fit_law(&master, &shift, common, &wlf, &has_wlf, err);
    if (status == WT_OK)
        status = wt_prony_fit_master(&master, &job->prony, &prony, err);
    if (status != WT_OK) {
        /* the fit sees isotherms, not files */
        const size_t n = sweep.n_isotherms;
        if (job->n_sets > 0 && job->sets[0].n_patterns > 0)
            wt_error_file(err, job->sets[0].patterns[0]);
        if (err != NULL && err->place[0] == '\0' && n > 0)
            wt_error_place(err, "%zu isotherm%s from %s", n, n == 1 ? "" : "s",
                           sweep.isotherms[0].source);
        goto done;
    }
    if (tables != NULL) {
        status = shift_table(&master, has_wlf ? &wlf : NULL, shift.floor, &t.shift_factors, err);
        if (status == WT_OK)
            status = master_table(&master, &prony, &t.master_curve, err);
        if (status == WT_OK)
            status = prony_table(&prony, &t.prony, err);
        if (status != WT_OK)
            goto done;
    }
    if (rubber != NULL) {
        status = keep_vertical(&master, &r, err);
        if (status != WT_OK)
            goto done;
        r.has_wlf = has_wlf;
        r.wlf = wlf.wlf;
        r.c1_error = wlf.c1_error;
        r.c2_error = wlf.c2_error;
        r.c_correlation = wlf.correlation;
        r.slope_error = wlf.straight ? wlf.slope_error : 0;
        r.temperature_min = sweep.isotherms[0].temperature;
        r.temperature_max = sweep.isotherms[sweep.n_isotherms - 1].temperature;
        r.prony = prony.prony;
        prony.prony = (wt_prony){0};
        r.master = master;
        r.has_master = true;
        master = (wt_master_curve){0};
        *rubber = r;
        r = (wt_rubber){0};
    }
    if (tables != NULL) {
        *tables = t;
        t = (wt_master_tables){0};
    }
done:
    wt_sweep_clear(&sweep);
    wt_master_curve_clear(&master);
    wt_prony_clear(&prony.prony);
    wt_rubber_clear(&r);
    wt_master_tables_clear(&t);
    return status;
}
