/* The job of strain sweeps: strain softening of a filled rubber at each frequency and
 * temperature.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/sweep_input.h"
#include "job/cost.h"

#include "core/base/array.h"
#include "core/table/table_rows.h"

#include <math.h>

wt_payne_job wt_payne_job_defaults(void)
{
    return (wt_payne_job){.n_sets = 0};
}

void wt_payne_tables_clear(wt_payne_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->payne);
    wt_table_free(tables->payne_sweep);
    *tables = (wt_payne_tables){0};
}

/* Points with positive moduli, to which a law is fitted. */
typedef struct usable_points {
    size_t n;
    double *strain, *storage, *loss;
    bool loss_measured;
} usable_points;

static usable_points select_usable_points(const wt_strain_sweep *sweep, arena *memory, wt_log *log)
{
    usable_points u = {.strain = arena_numbers(memory, sweep->n),
                       .storage = arena_numbers(memory, sweep->n),
                       .loss = arena_numbers(memory, sweep->n)};
    bool storage_only = true;
    for (size_t i = 0; i < sweep->n && storage_only; i++)
        storage_only = isnan(sweep->loss_modulus[i]);
    u.loss_measured = !storage_only;
    for (size_t i = 0; i < sweep->n; i++) {
        const double storage = sweep->storage_modulus[i], loss = sweep->loss_modulus[i];
        if (!(storage > 0 && isfinite(storage) && (storage_only || (loss > 0 && isfinite(loss)))))
            continue;
        u.strain[u.n] = sweep->strain[i];
        u.storage[u.n] = storage;
        u.loss[u.n++] = loss;
    }
    if (u.n < sweep->n)
        wt_log_action(log, WT_WARNING, WT_LEFT_OUT, 0, NULL, sweep->source, NULL,
                      "strain sweep at %.4g rad/s: %zu of %zu points left out, no positive "
                      "modulus",
                      sweep->angular_frequency, sweep->n - u.n, sweep->n);
    return u;
}

TABLE_ROW(payne_sweep, PAYNE_SWEEP, double strain, angular_frequency, temperature, storage, loss,
          loss_factor;
          double storage_ratio, loss_ratio, storage_kraus, loss_kraus; const char *source, *sample;)

static void add_sweep_point_rows(table_writer *t, const wt_strain_sweep *s, const wt_payne *p)
{
    const double unknown = (double)NAN;
    table_block(t);
    for (size_t i = 0; i < s->n; i++) {
        const double strain = s->strain[i], storage = s->storage_modulus[i],
                     loss = s->loss_modulus[i];
        TABLE_ADD(payne_sweep, t, strain, s->angular_frequency, s->temperature, storage, loss,
                  storage > 0 ? loss / storage : unknown, storage / p->storage_start,
                  loss / p->loss_start, p->fitted ? wt_kraus_storage(&p->law, strain) : unknown,
                  p->fitted ? wt_kraus_loss(&p->law, strain) : unknown, s->source, s->sample);
    }
}

TABLE_ROW(payne, PAYNE, wt_strain_sweep sweep; wt_payne payne; size_t points;
          double strain_min, strain_max;)

static wt_status build_payne_tables(const wt_job *work, const wt_sweep *sweep, wt_payne_tables *t,
                                    wt_error *err)
{
    const char *deformation = flow_deformation_name(sweep->deformation);
    table_writer points = table_begin(&payne_sweep_schema, err),
                 numbers = table_begin(&payne_schema, err);
    wt_status status = WT_OK;
    size_t n_fitted = 0;
    payne_sweep_set_text(&points, PAYNE_SWEEP_KEY_DEFORMATION, deformation);
    payne_set_text(&numbers, PAYNE_KEY_DEFORMATION, deformation);
    for (size_t i = 0; i < sweep->n_strain_sweeps && status == WT_OK; i++) {
        const wt_strain_sweep *s = &sweep->strain_sweeps[i];
        arena memory = {0};
        const usable_points u = select_usable_points(s, &memory, work->log);
        wt_payne payne;
        if (u.n > 0) {
            status = wt_payne_fit(u.strain, u.storage, u.loss_measured ? u.loss : NULL, u.n, &payne,
                                  err);
            if (status == WT_OK) {
                add_sweep_point_rows(&points, s, &payne);
                TABLE_ADD(payne, &numbers, *s, payne, u.n, u.strain[0], u.strain[u.n - 1]);
                n_fitted++;
            }
        }
        arena_free(&memory);
    }
    if (status == WT_OK && n_fitted == 0) {
        status = wt_fail(err, WT_E_RANGE, "no strain sweep has a positive modulus");
        wt_error_place(err, "%s", sweep->strain_sweeps[0].source);
    }
    const wt_status first = table_end(&points, &t->payne_sweep),
                    second = table_end(&numbers, &t->payne);
    return status != WT_OK ? status : first != WT_OK ? first : second;
}

wt_status wt_payne_compute(const wt_payne_job *job, const wt_job *work, wt_payne_tables *tables,
                           wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no job of strain sweeps");
    wt_sweep sweep = {0};
    wt_payne_tables t = {0};
    wt_status status = flow_sweeps_read(job->sets, job->n_sets, work, &sweep, err);
    if (status == WT_OK && sweep.n_strain_sweeps == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no strain sweep could be read");
        wt_error_expected(err, "moduli at one frequency and temperature at rising strain "
                               "amplitudes, and a column of the amplitude");
        wt_error_found(err, "isotherms: %zu, temperature sweeps: %zu", sweep.n_isotherms,
                       sweep.n_ramps);
    }
    if (status == WT_OK)
        status = build_payne_tables(work, &sweep, &t, err);
    if (status == WT_OK) {
        cost_report(work, (cost_summary){.items = (double)sweep.n_strain_sweeps});
        *tables = t;
        t = (wt_payne_tables){0};
    }
    wt_payne_tables_clear(&t);
    wt_sweep_clear(&sweep);
    return status;
}
