/* Tables of the DMA job: shift factors, master curve, series, draws, relaxation spectrum and
 * reduced series.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/master.h"

#include "core/base/array.h"
#include "core/base/number.h"
#include "core/table/table_rows.h"
#include "dma/sweep_input.h"

#include <math.h>
#include <stdlib.h>

/* Converts an interval of log10 of a number to an interval of the number. The standard error is
 * NaN. */
static wt_interval power_of_ten(wt_interval log)
{
    return (wt_interval){pow(10, log.value), (double)NAN, pow(10, log.low), pow(10, log.high)};
}

/* ---- shift factors --------------------------------------------------------------------------- */

static const char *shift_quantity_name(const wt_master *m)
{
    const wt_shift_quantity by = wt_master_shift_quantity(m);
    if (m->loading != WT_OSCILLATION)
        return m->loading == WT_CREEP ? "creep compliance" : "relaxation modulus";
    static const char *const names[] = {"both moduli", "storage modulus alone",
                                        "loss modulus alone", "loss factor alone"};
    return names[by];
}

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
    if (!isnan(m->misfit_high)) {
        shift_factors_set_print(t, SHIFT_FACTORS_KEY_MISFIT_LOW, "%.3g", m->misfit_low);
        shift_factors_set_print(t, SHIFT_FACTORS_KEY_MISFIT_HIGH, "%.3g", m->misfit_high);
    }
    const double factor = exp(m->loss_factor);
    shift_factors_set_value(t, SHIFT_FACTORS_KEY_LOSS_FACTOR, factor, factor * m->loss_factor_error,
                            0);
    shift_factors_set_print(t, SHIFT_FACTORS_KEY_KRAMERS_KRONIG_P, "%.3g", m->kramers_kronig_p);
}

/* Fraction of a standard error that is visible in an interval: a twentieth of its half width. */
static const double visible_step = 0.1;

bool flow_fit_has_converged(const wt_master *m)
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
    if (!flow_fit_has_converged(m))
        shift_factors_set_print(t, SHIFT_FACTORS_KEY_STEP_LEFT, "%.3g", m->step_bound);
}

wt_status flow_shift_table(const wt_master *m, wt_table **table, wt_error *err)
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
    if (m->strain_high > 0) {
        shift_factors_set_value(&t, SHIFT_FACTORS_KEY_STRAIN_LOW, m->strain_low, 0, 0);
        shift_factors_set_value(&t, SHIFT_FACTORS_KEY_STRAIN_HIGH, m->strain_high, 0, 0);
    }
    shift_factors_set_text(&t, SHIFT_FACTORS_KEY_DEFORMATION,
                           flow_deformation_name(m->deformation));
    set_superposition_keys(&t, m);
    return table_end(&t, table);
}

/* ---- master curve and series ----------------------------------------------------------------- */

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
    return power_of_ten((wt_interval){-x.value, x.standard_error, -x.high, -x.low});
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
              .fitted_storage = power_of_ten(m->fitted_storage[i]),
              .fitted_loss = power_of_ten(m->fitted_loss[i]),
              .fitted_loss_factor = power_of_ten(m->fitted_loss_factor[i]),
              .own_frequency = own_frequency, .own_storage = pow(10, storage - shift->log_b.value),
              .own_loss = pow(10, loss - shift->log_b.value), .left_out = m->is_outlier[i],
              .time = relaxes || creeps ? pow(10, -frequency) : none,
              .relaxation_modulus = relaxes ? pow(10, step) : none,
              .creep_compliance = creeps ? pow(10, -step) : none,
              .fitted_relaxation = relaxes ? power_of_ten(m->fitted_step[i]) : unknown,
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

wt_status flow_master_curve_table(const wt_master *m, wt_table **table, wt_error *err)
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

wt_status flow_prony_table(const wt_master *m, wt_table **table, wt_error *err)
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

/* Digits of the draws, far finer than their scatter, which shortens the tables. */
enum { DRAW_DIGITS = 7 };

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
                              round_to_digits(prony->equilibrium_modulus, DRAW_DIGITS),
                              round_to_digits(law->wlf.c1, DRAW_DIGITS),
                              round_to_digits(law->wlf.c2, DRAW_DIGITS),
                              round_to_digits(law->activation_energy, DRAW_DIGITS)};
    table_block(t);
    for (size_t i = 0; vertical ? i < m->n_shifts : first; i++) {
        if (vertical && !m->shifts[i].determined)
            continue;
        if (vertical) {
            row.temperature = m->shifts[i].temperature;
            row.log_b = round_to_digits(log_b[i], DRAW_DIGITS);
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
                  round_to_digits(prony->relaxation_time[k], DRAW_DIGITS),
                  round_to_digits(prony->modulus[k], DRAW_DIGITS));
}

wt_status flow_draw_tables(const wt_master *m, size_t n, wt_master_tables *tables, wt_error *err)
{
    double *log_b = wt_alloc(m->n_shifts, sizeof *log_b);
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

/* ---- spectrum -------------------------------------------------------------------------------- */
TABLE_ROW(relaxation_spectrum, RELAXATION_SPECTRUM, double relaxation_time; wt_interval density;)

wt_status flow_spectrum_table(const wt_master *m, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&relaxation_spectrum_schema, err);
    for (size_t i = 0; i < m->prony.n; i++) {
        wt_interval density;
        wt_master_spectrum(m, i, &density);
        if (!isnan(density.value))
            TABLE_ADD(relaxation_spectrum, &t, m->prony.relaxation_time[i], power_of_ten(density));
    }
    relaxation_spectrum_set_value(&t, RELAXATION_SPECTRUM_KEY_REFERENCE_TEMPERATURE,
                                  m->reference_temperature, 0, 0);
    relaxation_spectrum_set_text(&t, RELAXATION_SPECTRUM_KEY_DEFORMATION,
                                 flow_deformation_name(m->deformation));
    return table_end(&t, table);
}

/* Returns the largest relative half width of the 95 % intervals of a modulus. */
static double widest_interval(const wt_interval *fitted, size_t n)
{
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = fmax(most, pow(10, 0.5 * (fitted[i].high - fitted[i].low)) - 1);
    return most;
}

TABLE_ROW(prony_reduced, PRONY_REDUCED, double relaxation_time, modulus, share;)

static wt_status build_reduced_table(const wt_master *m, const wt_prony *p, wt_table **table,
                                     wt_error *err)
{
    double sum = p->equilibrium_modulus, deviation[2];
    table_writer t = table_begin(&prony_reduced_schema, err);
    wt_prony_deviation(&m->prony, p, deviation);
    for (size_t i = 0; i < p->n; i++)
        sum += p->modulus[i];
    for (size_t i = 0; i < p->n; i++)
        TABLE_ADD(prony_reduced, &t, p->relaxation_time[i], p->modulus[i], p->modulus[i] / sum);
    const struct {
        prony_reduced_key key;
        double value;
    } values[] = {{PRONY_REDUCED_KEY_EQUILIBRIUM_MODULUS, p->equilibrium_modulus},
                  {PRONY_REDUCED_KEY_INSTANTANEOUS_MODULUS, sum},
                  {PRONY_REDUCED_KEY_REFERENCE_TEMPERATURE, p->reference_temperature},
                  {PRONY_REDUCED_KEY_FREQUENCY_MIN, p->frequency_min},
                  {PRONY_REDUCED_KEY_FREQUENCY_MAX, p->frequency_max}},
      plain[] = {{PRONY_REDUCED_KEY_DEVIATION_STORAGE, deviation[0]},
                 {PRONY_REDUCED_KEY_DEVIATION_LOSS, deviation[1]},
                 {PRONY_REDUCED_KEY_INTERVAL_STORAGE, widest_interval(m->fitted_storage, m->n)},
                 {PRONY_REDUCED_KEY_INTERVAL_LOSS, widest_interval(m->fitted_loss, m->n)}};
    for (size_t i = 0; i < COUNT_OF(values); i++)
        prony_reduced_set_value(&t, values[i].key, values[i].value, (double)NAN, 0);
    for (size_t i = 0; i < COUNT_OF(plain); i++)
        prony_reduced_set_print(&t, plain[i].key, "%.3g", plain[i].value);
    prony_reduced_set_text(&t, PRONY_REDUCED_KEY_DEFORMATION,
                           flow_deformation_name(p->deformation));
    return table_end(&t, table);
}

/* Builds the table of the reduced series. It warns if the deviation exceeds the requested limit. */
wt_status flow_reduced_table(const wt_master *m, const wt_master_job *job, const wt_job *work,
                             wt_table **table, wt_error *err)
{
    const wt_reduction *options = &job->reduction;
    wt_prony p = {0};
    double deviation[2];
    wt_status status = wt_prony_reduce(&m->prony, options, &p, err);
    if (status == WT_OK)
        status = build_reduced_table(m, &p, table, err);
    if (status == WT_OK) {
        wt_prony_deviation(&m->prony, &p, deviation);
        const double most = fmax(deviation[0], deviation[1]);
        if (most > options->error)
            wt_log_add(work->log, WT_WARNING, NULL, NULL,
                       "the reduced Prony series of %zu term%s deviates from the spectrum by "
                       "up to %.3g %%, more than the %.3g %% of --prony-error: %s",
                       p.n, p.n == 1 ? "" : "s", 100 * most, 100 * options->error,
                       options->terms > 0 ? "more terms are closer"
                                          : "its long-term modulus may not be that of the rubber");
    }
    wt_prony_clear(&p);
    return status;
}
