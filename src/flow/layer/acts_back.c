/* The table of the balances of a layer that acts back on the energy that makes it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/layer/acts_back.h"
#include "flow/work/cost.h"

#include "base/clocale.h"
#include "data/tables/rows.h"

#include <math.h>

/* Thicknesses at which balances are looked for: a step is 9 % of the thickness over six decades. */
enum { GRID = 160 };
/* From a layer that the shortest wave hardly feels to one that holds the longest. */
static const double thinnest = 1e-2; /* 1/q1 */
static const double thickest = 4;    /* 1/q0 */

TABLE_ROW(layer_balances, LAYER_BALANCES, const char *kind, *stable;
          double thickness, map_slope, eigenvalue, wear_rate, hysteresis, area_ratio, friction;)
TABLE_KEYS(layer_balances, LAYER_BALANCES, wt_estimate one_way, ratio;
           double modulus_ratio, low, high; const char *words;)

wt_status layer_job_known(const wt_sliding *sliding, const wt_layer_job *job,
                          const wt_layer_known *known, const wt_job *work, wt_layer_job *out,
                          wt_error *err)
{
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = wt_layer_job_check(job, err);
    if (status == WT_OK && known != NULL && !(known->modulus_ratio.value > 0)) {
        status = wt_fail(err, WT_E_MISSING, "the modulus of the layer is not known");
        wt_error_expected(err, "modulus-ratio above 0");
    }
    if (status == WT_OK)
        status = layer_job_calibrated(sliding, job, work, out, err);
    if (status == WT_OK && known != NULL && known->bulk_shear)
        out->shear.exponent = 0;
    return status;
}

wt_status acts_back_energy(double thickness, void *user, wt_energy_source *source,
                           wt_layer_parameters *parameters, wt_error *err)
{
    const acts_back *back = user;
    layer_energy energy = {.source = {.n = 0}};
    layer_spot spot = layer_here();
    spot.layer = (wt_layer_state){thickness, thickness > 0 ? back->modulus_ratio : 1};
    const wt_status status =
        layer_at(back->sliding, back->job, back->work, spot, &energy, parameters, err);
    *source = energy.source;
    return status;
}

wt_status acts_back_find(acts_back *back, wt_layer_loop *loop, wt_error *err)
{
    wt_energy_source source = {0};
    wt_layer_parameters p;
    double low = 0, high = 0;
    wt_status status = acts_back_energy(0, back, &source, &p, err);
    for (size_t i = 0; status == WT_OK && i < source.n; i++) {
        low = i == 0 ? source.wavenumber[0] : fmin(low, source.wavenumber[i]);
        high = fmax(high, source.wavenumber[i]);
    }
    if (status == WT_OK)
        status = wt_layer_loop_find(acts_back_energy, back, thinnest / high, thickest / low, GRID,
                                    loop, err);
    wt_energy_source_clear(&source);
    return status;
}

/* ---- the table ------------------------------------------------------------------------------- */

static wt_status add_row(const acts_back *back, layer_balances_row row, table_writer *t,
                         wt_error *err)
{
    layer_friction f;
    layer_spot spot = layer_here();
    spot.layer = (wt_layer_state){row.thickness, row.thickness > 0 ? back->modulus_ratio : 1};
    const wt_status status = layer_friction_at(back->sliding, back->job, back->work, spot, &f, err);
    row.hysteresis = f.hysteresis;
    row.area_ratio = f.area_ratio;
    row.friction = f.total;
    if (status == WT_OK)
        layer_balances_add_row(t, &row);
    return status;
}

static wt_status add_rows(const acts_back *back, const wt_layer_loop *loop, table_writer *t,
                          wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < loop->n_roots; i++) {
        const wt_layer_root *r = &loop->root[i];
        const layer_balances_row row = {.kind = "balance",
                                        .stable = r->stable ? "stable" : "unstable",
                                        .thickness = r->thickness,
                                        .map_slope = r->map_slope,
                                        .eigenvalue = r->eigenvalue,
                                        .wear_rate = back->job->specific_wear_rate.value};
        status = add_row(back, row, t, err);
    }
    for (size_t i = 0; status == WT_OK && i < loop->n_folds; i++) {
        const wt_layer_fold *f = &loop->fold[i];
        const layer_balances_row row = {.kind = "fold",
                                        .stable = f->maximum ? "above" : "below",
                                        .thickness = f->thickness,
                                        .map_slope = (double)NAN,
                                        .eigenvalue = (double)NAN,
                                        .wear_rate = f->specific_wear_rate};
        status = add_row(back, row, t, err);
    }
    return status;
}

static const char *say_loop(const wt_layer_loop *loop)
{
    size_t stable = 0;
    for (size_t i = 0; i < loop->n_roots; i++)
        stable += loop->root[i].stable;
    if (loop->n_roots == 0)
        return "no balance between the thicknesses looked at (reconstructed)";
    if (stable > 1)
        return loop->ratio > 1 ? "several stable balances: which one a layer comes to depends on "
                                 "what was before; from a bare surface it is the thinnest "
                                 "(reconstructed)"
                               : "a bare surface stays bare, and a layer that is thick enough "
                                 "stays, too (reconstructed)";
    return loop->ratio > 1 ? "one stable balance (reconstructed)"
                           : "a bare surface stays bare (reconstructed)";
}

static wt_status make_table(acts_back *back, wt_table **table, wt_error *err)
{
    wt_layer_loop loop;
    wt_layer_balance balance = {.ratio = (double)NAN};
    wt_energy_source source = {0};
    wt_layer_parameters p;
    wt_status status = acts_back_find(back, &loop, err);
    if (status == WT_OK)
        status = acts_back_energy(0, back, &source, &p, err);
    if (status == WT_OK)
        status = wt_layer_balance_compute(&source, &p, &balance, err);
    wt_energy_source_clear(&source);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&layer_balances_schema, err);
    status = add_rows(back, &loop, &t, err);
    if (t.status == WT_OK)
        t.status = status;
    TABLE_SET(layer_balances, &t, layer_alone(balance.thickness.value), layer_alone(loop.ratio),
              back->modulus_ratio, loop.low, loop.high, say_loop(&loop));
    return table_end(&t, table);
}

wt_status wt_layer_balances_make(const wt_sliding *sliding, const wt_layer_job *job,
                                 const wt_layer_known *known, const wt_job *work, wt_table **table,
                                 wt_error *err)
{
    if (job == NULL || known == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no balances of a layer to make");
    wt_layer_job own;
    wt_status status = layer_job_known(sliding, job, known, work, &own, err);
    if (status != WT_OK)
        return status;
    acts_back back = {sliding, &own, work, known->modulus_ratio.value};
    status = make_table(&back, table, err);
    cost_say(work, (cost_summary){.items = GRID, .tolerance_asked = work->tolerance});
    return status;
}
